"""What lidars show many robots: what stands around each, and the hits on what moves."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from semnav_agents.planning.moving import mark_moving
from semnav_agents.planning.obstacle_kernels import MemoryLimits, remember
from semnav_agents.planning.obstacle_selection import SelectionLimits
from semnav_agents.planning.obstacles import MemorySettings, ObstacleMemory, memory_arrays
from semnav_features.frames import FloatArray, Pose, compose, points_to_parent
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.memory import MEMORY_STATE
from semnav_features.kernels.past_views import PAST_VIEWS
from semnav_features.lidar_spec import LidarSpec

PERCEIVER = np.dtype(
    [
        ("mount", "f8", 3),
        ("start", "f8"),
        ("step", "f8"),
        ("range_max", "f8"),
        ("used", MEMORY_STATE),
        ("views", PAST_VIEWS),
    ]
)
"""A robot's lidar: its mount on the robot, direction of the first beam and angle between two,
radians, range, metres; and its past views, see `kernels.past_views`."""


class Perception:
    """Obstacles and moving things around robots, from odometry and scans alone.

    Args:
        robots: how many there are.
    """

    def __init__(self, robots: int) -> None:
        self._settings = MemorySettings()
        self._perceivers = np.zeros(robots, PERCEIVER)
        self._memory = memory_arrays(robots, self._settings)
        self._directions = np.empty((robots, 0, 2))
        self._moving = np.zeros((robots, 0), np.bool_)

    def reset(self, index: int, mount: Pose, lidar: LidarSpec) -> None:
        """Forget everything about a robot, and take its lidar."""
        robots, beams = len(self._perceivers), lidar.directions
        if self._directions.shape[1] != len(beams):
            self._directions = np.zeros((robots, *beams.shape))
            self._moving = np.zeros((robots, len(beams)), np.bool_)
        self._directions[index] = beams
        x, y = beams[:2].T
        start = float(np.arctan2(y[0], x[0]))
        step = float(np.arctan2(x[0] * y[1] - y[0] * x[1], x[0] * x[1] + y[0] * y[1]))
        perceiver = self._perceivers[index : index + 1]
        perceiver[:] = 0
        perceiver["mount"], perceiver["start"], perceiver["step"] = mount, start, step
        perceiver["range_max"] = lidar.range_max
        self.obstacles(index).reset()

    def obstacles(self, index: int) -> ObstacleMemory:
        """What stands around a robot, odometry frame.

        It is made anew for each call: in a copy of all this it would keep arrays of its own.
        """
        state, centres, table = self._memory
        here = slice(index, index + 1)
        return ObstacleMemory(self._settings, (state[here], centres[here], table))

    def update(
        self,
        odometry: NDArray[np.float32],
        scans: NDArray[np.float32],
        driven: NDArray[np.int64],
    ) -> None:
        """Take in the observations of one step.

        Args:
            odometry: entries of the observations, shape (n, 7).
            scans: the same, shape (n, beams).
            driven: numbers of the robots that take part.
        """
        told = self._perceivers, self._directions, *self._memory, self._settings.limits
        perceive(odometry, scans, driven, *told, self._moving)

    @property
    def memory(self) -> tuple[Any, Any, Any, SelectionLimits]:
        """States, centres, table and what counts of them, for `obstacle_selection.select`."""
        return *self._memory, self._settings.selection

    @property
    def any_moving(self) -> NDArray[np.bool_]:
        """Whether something moves around each robot, shape (n,)."""
        return np.asarray(self._moving.any(axis=1), np.bool_)

    def moving(self, index: int, pose: Pose, scan: NDArray[np.float32]) -> FloatArray:
        """Where something moves around a robot at a pose, in the frame of it, shape (m, 2)."""
        moves = self._moving[index]
        if not moves.any():
            return np.empty((0, 2))
        x, y, heading = self._perceivers["mount"][index].tolist()
        lidar = compose(pose, (x, y, heading))
        return points_to_parent(lidar, scan[moves, None] * self._directions[index, moves])


@kernel
def perceive(
    odometry: NDArray[np.float32],
    scans: NDArray[np.float32],
    driven: NDArray[np.int64],
    perceivers: NDArray[Any],
    directions: FloatArray,
    states: NDArray[Any],
    centres: NDArray[Any],
    table: NDArray[np.int32],
    limits: MemoryLimits,
    moving: NDArray[np.bool_],
) -> None:
    """Add a scan of each driven robot to its memory, and write which beams met what moves.

    Args:
        odometry: x, y, cosine, sine and more, shape (n, 7).
        scans: metres, shape (n, beams).
        driven: numbers of the robots.
        perceivers: dtype `PERCEIVER`, shape (n,), changed in place.
        directions: of the beams, lidar frame, shape (n, beams, 2).
        states: of the memories, see `remember`, like the next three.
        centres: the same.
        table: the same.
        limits: the same.
        moving: written, shape (n, beams).
    """
    ranges, returned = np.empty(scans.shape[1]), np.empty(scans.shape[1])
    for k in driven:
        perceiver = perceivers[k]
        mount = perceiver.mount
        x, y = np.float64(odometry[k, 0]), np.float64(odometry[k, 1])
        heading = math.atan2(np.float64(odometry[k, 3]), np.float64(odometry[k, 2]))
        lidar = compose((x, y, heading), (mount[0], mount[1], mount[2]))
        farthest = np.float32(perceiver.range_max)
        for i in range(len(ranges)):
            ranges[i] = scans[k, i]
            returned[i] = scans[k, i] if scans[k, i] < farthest else np.inf
        moving[k, :] = False
        mark_moving(
            returned,
            perceiver.start,
            perceiver.step,
            lidar,
            perceiver.used,
            perceiver.views,
            moving[k],
        )
        for i in range(len(ranges)):
            if moving[k, i]:
                ranges[i] = 0.0  # no return
        remember(
            states[k],
            centres[k],
            table,
            lidar,
            ranges,
            directions[k],
            perceiver.range_max,
            limits,
        )
