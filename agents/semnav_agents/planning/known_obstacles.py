"""What a driver is given as obstacles: points, asked for all at once or near a pose only.

Most steps need the few points around the robot; all of them are needed when a path is planned.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np

from semnav_agents.planning.free import points_around
from semnav_features.frames import FloatArray, Pose

NO_POINTS: FloatArray = np.empty((0, 2))
"""No obstacle points, shape (0, 2)."""


class Obstacles(Protocol):
    """Obstacle points in one frame."""

    def points(self) -> FloatArray:
        """All of them, metres, shape (N, 2)."""
        ...

    def near(self, pose: Pose, reach: float) -> FloatArray:
        """Those around a pose, in its frame, see `points_around`; shape (M, 2)."""
        ...


@dataclass
class PointObstacles:
    """Obstacles that are points.

    Attributes:
        make: gives the points, shape (N, 2); called when they are first asked for.
    """

    make: Callable[[], FloatArray]

    @cached_property
    def _points(self) -> FloatArray:
        return self.make()

    def points(self) -> FloatArray:
        """See `Obstacles`."""
        return self._points

    def near(self, pose: Pose, reach: float) -> FloatArray:
        """See `Obstacles`."""
        return points_around(pose, self._points, reach)


@dataclass(frozen=True)
class JoinedObstacles:
    """The obstacles of several sources, in their order."""

    parts: Sequence[Obstacles]

    def points(self) -> FloatArray:
        """See `Obstacles`."""
        return np.vstack([part.points() for part in self.parts])

    def near(self, pose: Pose, reach: float) -> FloatArray:
        """See `Obstacles`."""
        return np.vstack([part.near(pose, reach) for part in self.parts])


def as_obstacles(given: FloatArray | Obstacles) -> Obstacles:
    """Obstacles as they are, or points, shape (N, 2), as obstacles."""
    return PointObstacles(lambda: given) if isinstance(given, np.ndarray) else given
