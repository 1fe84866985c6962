"""A route of a robot's centre through a floor plan."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from semnav_features.frames import FloatArray, Pose, wrap_angle

POSE_SPACING = 0.1
"""Distance between the poses of a route, metres."""

HEADING_STEP = 0.1
"""Heading change between the poses of a turn on the spot, radians."""

LOOK_DISTANCE = 0.4
"""Distance behind and ahead of a pose between which a robot faces along the route, metres; it
smooths the corners."""


class RouteError(ValueError):
    """There is no such route; the message says why."""


@dataclass(frozen=True, eq=False)
class Route:
    """A route from a start pose along points.

    Attributes:
        start: pose of the robot at the start, world frame.
        points: points of the route, shape (k, 2), world frame, metres; the first is the start.
        facing: heading to turn to at the end, radians; None to keep the heading.

    Raises:
        RouteError: a number is not finite, there are no two points, or they begin elsewhere.
    """

    start: Pose
    points: FloatArray
    facing: float | None = None

    def __post_init__(self) -> None:
        points = np.array(self.points, dtype=np.float64)
        if points.ndim != 2 or points.shape[1] != 2 or len(points) < 2:
            raise RouteError(f"a route is at least two points (x, y), not shape {points.shape}")
        if not np.isfinite((*points.ravel(), *self.start, self.facing or 0.0)).all():
            raise RouteError("a route needs finite numbers, metres and radians")
        if math.dist(points[0], self.start[:2]) > POSE_SPACING:
            here, there = (f"({p[0]:.2f}, {p[1]:.2f})" for p in (self.start, points[0]))
            raise RouteError(f"the route starts at {here}, but its first point is {there}")
        points.setflags(write=False)
        object.__setattr__(self, "points", points)

    @property
    def length(self) -> float:
        """Metres."""
        return float(self._travelled[-1])

    @cached_property
    def poses(self) -> FloatArray:
        """Poses of a robot that follows the route, shape (n, 3), `POSE_SPACING` apart.

        The robot faces along the route. Where this direction changes by more than `HEADING_STEP`
        from pose to pose, the robot turns on the spot.
        """
        marks = np.linspace(0.0, self.length, math.ceil(self.length / POSE_SPACING) + 1)
        ahead = self._at(marks + LOOK_DISTANCE) - self._at(marks - LOOK_DISTANCE)
        headings = np.arctan2(ahead[:, 1], ahead[:, 0]).tolist()
        moves = np.hypot(ahead[:, 0], ahead[:, 1]) > 0.1 * LOOK_DISTANCE
        poses, heading = [self.start], self.start[2]
        for (x, y), wanted, moving in zip(self._at(marks).tolist(), headings, moves, strict=True):
            if moving:
                poses += _turned((x, y, heading), wanted)
                heading = wanted
            else:
                poses.append((x, y, heading))
        if self.facing is not None:
            poses += _turned(poses[-1], self.facing)
        return np.array(poses)

    @cached_property
    def _travelled(self) -> FloatArray:
        """Length of the route from the start to each point, metres."""
        steps = np.hypot(*np.diff(self.points, axis=0).T)
        return np.concatenate(((0.0,), np.cumsum(steps)))

    def _at(self, marks: FloatArray) -> FloatArray:
        """The points at some distances along the route, shape (n, 2)."""
        columns = [np.interp(marks, self._travelled, column) for column in self.points.T]
        return np.stack(columns, axis=1)


def _turned(pose: Pose, wanted: float) -> list[Pose]:
    """The poses of a turn on the spot to a heading, the last with it."""
    x, y, heading = pose
    heading_change = wrap_angle(wanted - heading)
    steps = max(1, math.ceil(abs(heading_change) / HEADING_STEP))
    return [(x, y, wrap_angle(heading + heading_change * k / steps)) for k in range(1, steps + 1)]
