"""The observation of a small policy: one short vector, the same in training and afterwards."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from semnav_env.agents.base import Observation
from semnav_env.agents.learning.clearance_memory import SECTORS, ClearanceMemory
from semnav_env.features.lidar_spec import LidarSpec
from semnav_env.observations.layout import GOAL, ODOMETRY
from semnav_env.robots import RobotSpec

Array = NDArray[np.float32]

_GOAL_PARTS = [GOAL.columns.index(name) for name in ("x", "cosine", "door_start_x", "has_door")]
"""Where in the goal its place, its heading, its door and the flag of the door begin."""

_VELOCITY = ODOMETRY.columns.index("forward")
"""Where in the odometry the velocity begins."""

COMPACT_SIZE = 1 + GOAL.size + ODOMETRY.size - _VELOCITY + SECTORS
"""Length of a compact observation: the body, the goal, the velocity, the room around."""

PLACE_SCALE, CLEARANCE_SCALE = 1.0, 0.3
"""Lengths that are squashed to a half, metres: contact is decided by few centimetres."""


class CompactObserver:
    """Makes the observations of some robots compact; remembers what is around each.

    Args:
        robots: the body of each.
        lidar: of all.
    """

    def __init__(self, robots: Sequence[RobotSpec], lidar: LidarSpec) -> None:
        self._memory = ClearanceMemory(robots, lidar)
        self._sideways = np.array([[robot.holonomic] for robot in robots], np.float32)

    def forget(self, robots: NDArray[np.bool_]) -> None:
        """New episodes begin.

        Args:
            robots: whose, shape (n,).
        """
        self._memory.forget(robots)

    def observe(self, observation: Observation, robots: Sequence[int] | None = None) -> Array:
        """The body, the goal, the velocity and the room around, each value in [-1, 1].

        Places and speeds p enter as p / (1 + |p|). This keeps the direction, tells near places
        apart more finely than far ones, and is bounded. Clearances c enter as c / (0.3 + c). The
        text of the command is left out: the goal says already what it refers to.

        Args:
            observation: of an environment with `observation="all"`, a row for each robot.
            robots: whose it is; those of all if None.

        Returns:
            Shape (n, COMPACT_SIZE): whether the body moves sideways; the kind of goal (4), its
            place (2), cosine and sine of its heading, the start (2) and end (2) of its door,
            whether it has one; the velocity forward, left and turning; and the clearance in each
            direction.
        """
        index = np.arange(len(self._sideways)) if robots is None else np.asarray(robots)
        goal, odometry = observation["goal"], observation["odometry"]
        kind, place, heading, jambs, has_door = np.split(goal, _GOAL_PARTS, axis=-1)
        turned = np.arctan2(odometry[:, 3], odometry[:, 2])
        poses = np.column_stack((odometry[:, :2], turned)).astype(np.float64)
        clearances = self._memory.clearances(index, poses, observation["scan"])
        return np.concatenate(
            (
                self._sideways[index],
                kind,
                _squash_place(place),
                heading,
                _squash_place(jambs[:, :2]),
                _squash_place(jambs[:, 2:]),
                has_door,
                _squash(odometry[:, _VELOCITY:]),
                clearances / (CLEARANCE_SCALE + clearances),
            ),
            axis=-1,
            dtype=np.float32,
        )


def _squash_place(place: Array) -> Array:
    """Places (x, y), each with its distance squashed and its direction kept."""
    distance = np.hypot(place[:, :1], place[:, 1:])
    return np.asarray(place / (PLACE_SCALE + distance), np.float32)


def _squash(values: Array) -> Array:
    """Each value on its own."""
    return np.asarray(values / (1.0 + np.abs(values)), np.float32)
