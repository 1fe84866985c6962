"""Candidate poses before a door and their errors: Mes 2021, sections 5.3 and 5.4."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import shapely
from shapely import Polygon, affinity
from shapely.geometry.base import BaseGeometry

from semnav_env.approach.door_side import DoorSide
from semnav_env.approach.settings import ApproachSettings
from semnav_env.robots import RobotSpec
from semnav_features.frames import FloatArray, Pose, points_to_parent, wrap_angle

DIGITS = 5
"""Digits of the errors that count, as in Table 7.2; poses that differ by less are equal."""

NORTH = math.pi / 2
"""Heading 0 of the thesis in the convention of this package, radians: along y."""

ANGLE_NOISE = 1e-9
"""Angles that differ by less are the same, radians."""


@dataclass(frozen=True, slots=True)
class CandidatePose:
    """A candidate pose before a door, with its errors and the reason for a refusal.

    Attributes:
        pose: of the robot's centre, in the frame of the door.
        wall_distance: from its position to the nearest wall, door line or obstacle, metres.
        area_error: area of the ellipse that is cut off by walls, square metres (section 5.4).
        angle_error: between its heading and the direction to the middle of the door, radians.
        distance: from where the robot is, metres; 0 if that is not known.
        refusal: why it is refused; empty if it is safe.
        body_clear: whether the body's rectangle touches nothing solid. The ellipse leaves out its
            corners, so a safe pose need not be clear.
    """

    pose: Pose
    wall_distance: float
    area_error: float
    angle_error: float
    distance: float
    refusal: str
    body_clear: bool

    @property
    def is_safe(self) -> bool:
        """Whether it is clear of walls and nothing cuts its ellipse."""
        return not self.refusal

    @property
    def key(self) -> tuple[float, float, float]:
        """Sort key of poses: area error, then angle error, then distance (5.4)."""
        return self.area_error, self.angle_error, self.distance


def free_square(side: DoorSide, settings: ApproachSettings) -> Polygon:
    """The square before a door that must be free for a pose straight before it (section 5.2).

    Its corners are Pa, Pb, Pc, Pd: `alpha` extends the door to both sides, `gamma` scales the door
    vector, turned square to the wall.
    """
    d1, d2 = np.array(side.left), np.array(side.right)
    d = d2 - d1
    alpha = (settings.free_side - side.width) / (2.0 * side.width)
    beta, gamma = alpha + 1.0, settings.free_side / side.width
    into_room = np.array((d[1], -d[0]))  # R(-pi/2) d
    a, b = d1 - alpha * d, d1 + beta * d
    return Polygon((a, b, b + gamma * into_room, a + gamma * into_room))


def positions_before(side: DoorSide, settings: ApproachSettings) -> FloatArray:
    """The corners of the dodecagon that lie before the door, shape (n, 2), metres."""
    k = np.arange(settings.positions) - (settings.positions - 1) / 2
    angles = 2 * math.pi / settings.corners * k
    circle = settings.radius * np.stack((np.cos(angles), np.sin(angles)), axis=1)
    return _rounded(side.before(circle), settings.rounding)


def headings_at(side: DoorSide, settings: ApproachSettings) -> list[float]:
    """The headings that are tried at each position, around straight through the door, radians."""
    k = np.arange(settings.headings) - (settings.headings - 1) / 2
    return [wrap_angle(side.through + each * settings.heading_step) for each in k.tolist()]


def ellipse_at(pose: Pose, settings: ApproachSettings) -> Polygon:
    """The ellipse around a pose that must be free (section 5.4), as a polygon of 64 corners."""
    disc = shapely.Point(0.0, 0.0).buffer(1.0)
    shape = affinity.scale(disc, settings.ellipse_length / 2, settings.ellipse_width / 2)
    turned = affinity.rotate(shape, pose[2], origin=(0.0, 0.0), use_radians=True)
    placed: Polygon = affinity.translate(turned, pose[0], pose[1])
    return placed


def body_at(pose: Pose, robot: RobotSpec) -> Polygon:
    """The rectangle that a body covers at a pose of its centre."""
    x, y = robot.length / 2, robot.width / 2
    return Polygon(points_to_parent(pose, np.array([(x, y), (-x, y), (-x, -y), (x, -y)])))


def is_behind(side: DoorSide, pose: Pose, robot: RobotSpec) -> bool:
    """Whether the whole body lies behind the line of a door."""
    corners = body_at(pose, robot).exterior.coords
    return all(side.distance_before((float(x), float(y))) < 0.0 for x, y in corners)


def angle_error(pose: Pose, side: DoorSide, wraps_at: float) -> float:
    """Angle between a heading and the direction to the middle of the door, radians.

    The thesis subtracts one from the other, both from -pi up to pi (exclusive) and counted from
    the y axis; from a difference above pi it takes `wraps_at`.
    """
    x, y = side.middle
    direction = math.atan2(y - pose[1], x - pose[0])
    difference = abs(_from_north(pose[2]) - _from_north(direction))
    if difference > math.pi + ANGLE_NOISE:
        difference = abs(difference - wraps_at)
    return round(difference, DIGITS)


def candidates(
    side: DoorSide,
    room: BaseGeometry,
    solids: BaseGeometry,
    robot: RobotSpec,
    settings: ApproachSettings,
    start: Pose | None,
) -> Iterator[CandidatePose]:
    """Measure every position with every heading; the result has no order.

    Args:
        side: the door and the side before it.
        room: the free space before it, every door closed.
        solids: what the body must not touch.
        robot: the body.
        settings: the parameters.
        start: where the robot is, if that is known.
    """
    shapely.prepare(solids)
    for x, y in positions_before(side, settings).tolist():
        inside = room.covers(shapely.Point(x, y))
        gap = room.boundary.distance(shapely.Point(x, y)) if inside else 0.0
        for heading in headings_at(side, settings):
            pose = (x, y, heading)
            ellipse = ellipse_at(pose, settings)
            cut = max(0.0, round(ellipse.area - ellipse.intersection(room).area, DIGITS))
            error = angle_error(pose, side, settings.wraps_at)
            away = 0.0 if start is None else math.dist(start[:2], (x, y))
            why = _refusal(inside, gap, cut, settings)
            clear = not solids.intersects(body_at(pose, robot))
            yield CandidatePose(pose, gap, cut, error, away, why, clear)


def _refusal(inside: bool, gap: float, cut: float, settings: ApproachSettings) -> str:
    if not inside:
        return "it lies outside the room before the door"
    if gap < settings.wall_clearance - 1e-9:
        return f"{gap:.2f} m from the nearest wall; {settings.wall_clearance:.2f} m are needed"
    if cut > 0.0:
        return f"walls cut {cut:.5f} square metres off the ellipse around it"
    return ""


def _from_north(heading: float) -> float:
    """A heading counted from the y axis, in [-pi, pi)."""
    return (heading - NORTH + math.pi + ANGLE_NOISE) % math.tau - math.pi


def _rounded(values: FloatArray, step: float) -> FloatArray:
    """Values rounded to a step; those halfway between two steps stay, and a step of 0 keeps all."""
    if step == 0.0:
        return values
    scaled, noise = values / step, 1e-6
    halves: FloatArray = np.floor(scaled + 0.5 + noise) + np.ceil(scaled - 0.5 - noise)
    return halves / 2 * step
