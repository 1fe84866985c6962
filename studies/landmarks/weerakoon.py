"""Corner landmarks by the equations of Weerakoon et al. themselves, as the baseline.

Segments with similar parameters (10) whose ends are near are merged, and the line is fitted anew to
all their points by orthogonal least squares (II-C, II-E). Two walls that meet at 30 degrees or more
make a landmark, their intersection (II-D); corners that are close are one. The paper's covariance
is none. Ends of single walls, of which table II has some, are averaged.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from semnav_features import Scene, Wall
from semnav_features.frames import FloatArray, Pose, wrap_angle

_ANGLE, _OFFSET = math.radians(10.0), 0.1
"""Walls are one line up to this angle and distance, radians and metres."""

_END_GAP = 0.5
"""And if their ends are no farther apart than this (the paper's end-point threshold), metres."""

_LEAST_TURN = math.radians(30.0)
"""Least angle of a landmark, the paper's, radians."""

_MEETING = 0.3
"""Walls meet if their ends are no farther from their intersection than this, metres."""

_SAME = 0.15
"""Landmarks nearer than this are one, metres."""


@dataclass(eq=False)
class PointLine:
    """The sums of a wall's points, from which the line of least orthogonal squares follows.

    Attributes:
        count: number of points.
        mean: of the points, metres.
        scatter: sum of (p - mean)(p - mean)^T, shape (2, 2).
        ends: start and end of all its segments, shape (n, 2).
        heading: direction of the line, radians.
    """

    count: int
    mean: FloatArray
    scatter: FloatArray
    ends: FloatArray
    heading: float

    @classmethod
    def of(cls, wall: Wall) -> PointLine:
        """The sums of one wall, from its fitted line and how its points scatter."""
        assert wall.centroid is not None
        along = np.array((math.cos(wall.heading), math.sin(wall.heading)))
        across = np.array((-along[1], along[0]))
        variance = wall.offset_deviation**2 * wall.beams
        spread = variance / max(wall.angle_deviation, 1e-9) ** 2
        scatter = spread * np.outer(along, along)
        scatter += wall.residual**2 * wall.beams * np.outer(across, across)
        ends = np.array((wall.start, wall.end))
        return cls(wall.beams, np.array(wall.centroid), scatter, ends, wall.heading)

    def merge(self, other: PointLine) -> None:
        """Fit the line to the points of both."""
        off = other.mean - self.mean
        total = self.count + other.count
        shared = self.count * other.count / total
        self.scatter = self.scatter + other.scatter + shared * np.outer(off, off)
        self.mean = self.mean + other.count / total * off
        self.count = total
        self.ends = np.concatenate((self.ends, other.ends))
        axis = np.linalg.eigh(self.scatter)[1][:, 1]
        angle = math.atan2(axis[1], axis[0])
        flipped = abs(wrap_angle(angle - self.heading)) > 0.5 * math.pi
        self.heading = wrap_angle(angle + math.pi) if flipped else angle

    def is_like(self, other: PointLine) -> bool:
        """Whether two are segments of one line."""
        across = np.array((-math.sin(self.heading), math.cos(self.heading)))
        along = np.array((across[1], -across[0]))
        places, others = (self.ends - self.mean) @ along, (other.ends - self.mean) @ along
        gap = max(places.min(), others.min()) - min(places.max(), others.max())
        return bool(
            abs(wrap_angle(self.heading - other.heading)) < _ANGLE
            and np.abs((other.ends - self.mean) @ across).max() < _OFFSET
            and gap < _END_GAP
        )


def landmarks(seen: list[tuple[Scene, Pose]]) -> list[FloatArray]:
    """Places of the landmarks of some scans, in the frame of their poses."""
    lines: list[PointLine] = []
    for scene, pose in seen:
        for wall in scene.placed(pose).walls:
            new = PointLine.of(wall)
            known = next((line for line in lines if line.is_like(new)), None)
            if known is None:
                lines.append(new)
            else:
                known.merge(new)
    found = [p for a in lines for b in lines if (p := _meeting(a, b)) is not None]
    ends = [np.array(c.point) for scene, pose in seen for c in scene.placed(pose).corners]
    return _one_each(found) + _one_each([p for p in ends if not _is_near(p, found)])


def _meeting(a: PointLine, b: PointLine) -> FloatArray | None:
    """Where the end of one line meets the start of another; None if they do not."""
    turn = abs(wrap_angle(b.heading - a.heading))
    if not _LEAST_TURN <= turn <= math.pi - 1e-3:
        return None
    normals = np.array([(-math.sin(line.heading), math.cos(line.heading)) for line in (a, b)])
    place = np.linalg.solve(normals, np.sum(normals * (a.mean, b.mean), axis=1))
    last, first = a.ends[1::2], b.ends[::2]
    meets = all(np.hypot(*(ends - place).T).min() < _MEETING for ends in (last, first))
    return place if meets else None


def _is_near(place: FloatArray, others: list[FloatArray]) -> bool:
    return any(np.hypot(*(place - other)) < _SAME for other in others)


def _one_each(places: list[FloatArray]) -> list[FloatArray]:
    """The means of the places that are near each other."""
    groups: list[list[FloatArray]] = []
    for place in places:
        group = next((g for g in groups if _is_near(place, [np.mean(g, axis=0)])), None)
        if group is None:
            groups.append([place])
        else:
            group.append(place)
    return [np.mean(group, axis=0) for group in groups]
