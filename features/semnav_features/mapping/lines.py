"""Lines with their uncertainty: placed in a map, compared, and fused."""

from __future__ import annotations

import math
from dataclasses import dataclass

from semnav_features.elements import Wall
from semnav_features.frames import Point, Pose, middle_of, to_parent, wrap_angle

_MIN_DEVIATION = 1e-3
"""Least standard deviation of a line's offset and direction, metres and radians."""


@dataclass(frozen=True, slots=True)
class Line:
    """A directed line; the errors of its offset at (x, y) and of its heading are uncorrelated.

    Attributes:
        x: of a point on it, metres.
        y: of that point, metres.
        heading: its direction, radians; free space lies to the left.
        offset_variance: of the point across the line, m^2.
        angle_variance: of the heading, rad^2.
    """

    x: float
    y: float
    heading: float
    offset_variance: float
    angle_variance: float

    def along(self, point: Point) -> float:
        """Position of a point along the line, from (x, y), metres."""
        dx, dy = point[0] - self.x, point[1] - self.y
        return math.cos(self.heading) * dx + math.sin(self.heading) * dy

    def across(self, point: Point) -> float:
        """Distance of a point to the left of the line, metres."""
        dx, dy = point[0] - self.x, point[1] - self.y
        return math.cos(self.heading) * dy - math.sin(self.heading) * dx

    def point(self, along: float) -> Point:
        """The point at that place along the line."""
        c, s = math.cos(self.heading), math.sin(self.heading)
        return self.x + along * c, self.y + along * s

    def variance(self, along: float) -> float:
        """Variance of the line across itself at a position along it, m^2."""
        return self.offset_variance + along * along * self.angle_variance


def line_of(wall: Wall, frame: Pose, position: float = 0.0, angle: float = 0.0) -> Line:
    """The line of a wall, placed in the parent of the wall's frame.

    Args:
        wall: a wall in `frame`; if it has no standard deviations, like walls of a plan, they follow
            from its residual, beams and length.
        frame: pose of its frame.
        position: standard deviation of the frame's place, metres.
        angle: standard deviation of its heading, radians.
    """
    offset, tilt = wall.offset_deviation, wall.angle_deviation
    if wall.centroid is None or not offset:
        noise = max(wall.residual, _MIN_DEVIATION) / math.sqrt(max(wall.beams, 2))
        offset, tilt = noise, noise * math.sqrt(12.0) / max(wall.length, 1e-6)
    local = wall.centroid or middle_of(wall.start, wall.end)
    x, y = to_parent(frame, local)
    return Line(
        x,
        y,
        wrap_angle(frame[2] + wall.heading),
        max(offset, _MIN_DEVIATION) ** 2 + position**2 + (angle * math.hypot(*local)) ** 2,
        max(tilt, _MIN_DEVIATION) ** 2 + angle**2,
    )


def fuse(a: Line, b: Line) -> Line:
    """The line that two estimates of one line agree on best, weighted by their covariances.

    In the frame of `a` a line is c + t s at the place s along it. `a` says c = 0 and t = 0. `b`,
    whose point lies at s and o to the left, says c + t s = o and t = t_b, its heading in this
    frame. The sum of squared errors over their variances is least where these normal equations
    hold, with weights p, P of a's offset and angle and q, Q of b's:

        (p + q) c + q s t = q o,    q s c + (P + Q + q s^2) t = q s o + Q t_b.

    Offset and angle of the result are uncorrelated at q s / (p + q).
    """
    s, o = a.along((b.x, b.y)), a.across((b.x, b.y))
    heading_change = wrap_angle(b.heading - a.heading)
    p, q = 1.0 / a.offset_variance, 1.0 / b.offset_variance
    pp, qq = 1.0 / a.angle_variance, 1.0 / b.angle_variance
    place = q * s / (p + q)
    known = pp + qq + p * place * s
    tilt = (qq * heading_change + p * place * o) / known
    offset = (q * o - q * s * tilt) / (p + q)
    x, y = a.point(place)
    shift = offset + tilt * place
    return Line(
        x - shift * math.sin(a.heading),
        y + shift * math.cos(a.heading),
        wrap_angle(a.heading + math.atan(tilt)),
        1.0 / (p + q),
        1.0 / known,
    )


def gap(a: tuple[float, float], b: tuple[float, float]) -> float:
    """Gap between two segments (first, last) along one line; negative if they overlap."""
    return max(a[0], b[0]) - min(a[1], b[1])
