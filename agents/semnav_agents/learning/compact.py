"""The observation of a small policy: one short vector, the same in training and afterwards."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from semnav_agents.base import Observation
from semnav_agents.learning.room_memory import PROBED_MOVES, SECTORS, RoomMemory
from semnav_agents.planning.obstacles import points_of_segments
from semnav_env.mind.observations.layout import BUMP_ROWS, GOAL, ODOMETRY
from semnav_env.robots import RobotSpec
from semnav_features.frames import FloatArray
from semnav_features.lidar_spec import LidarSpec

Array = NDArray[np.float32]

_GOAL_PARTS = [GOAL.columns.index(name) for name in ("x", "cosine", "door_start_x", "has_door")]
"""Indices in the goal at which its position, its heading, its door and the flag of the door
begin."""

_VELOCITY = ODOMETRY.columns.index("forward")
"""Index in the odometry at which the velocity begins."""

COMPACT_SIZE = 1 + GOAL.size + ODOMETRY.size - _VELOCITY + SECTORS + len(PROBED_MOVES)
"""Length of a compact observation: the body, the goal, the velocity, the surroundings."""

VELOCITY = slice(1 + GOAL.size, 1 + GOAL.size + ODOMETRY.size - _VELOCITY)
"""Slice of the velocity in a compact observation."""

COMPACT_ENTRIES = ("goal", "odometry", "scan", "bumps", "bumps_mask")
"""Entries of the observation from which a compact observation is made."""

PLACE_SCALE, CLEARANCE_SCALE = 1.0, 0.3
"""Lengths that are squashed to one half, metres; few centimetres of clearance decide on contact."""


class CompactObserver:
    """Makes the observations of some robots compact, and remembers the obstacles around each.

    Args:
        robots: the body of each.
        lidar: of all.

    Attributes:
        memories: the remembered obstacles of each.
    """

    def __init__(self, robots: Sequence[RobotSpec], lidar: LidarSpec) -> None:
        self.memories = [RoomMemory(robot, lidar) for robot in robots]
        self._sideways = np.array([[robot.holonomic] for robot in robots], np.float32)

    def forget(self, robots: NDArray[np.bool_]) -> None:
        """New episodes begin.

        Args:
            robots: whose, shape (n,).
        """
        for k in np.flatnonzero(robots):
            self.memories[k].forget()

    def observe(self, observation: Observation, robots: Sequence[int] | None = None) -> Array:
        """Make vectors of the body, the goal, the velocity and the surroundings, values in [-1, 1].

        Positions and speeds p enter as p / (1 + |p|). This keeps the direction, resolves near
        places more finely than far ones, and is bounded. Clearances c enter as c / (0.3 + c). The
        text of the command is left out, because the goal is already its referent.

        Args:
            observation: of an environment with `observation="all"`, a row for each robot.
            robots: whose it is; those of all if None.

        Returns:
            Shape (n, COMPACT_SIZE): whether the body moves sideways; the kind of goal (4), its
            place (2), cosine and sine of its heading, the start (2) and end (2) of its door,
            whether it has one; the velocity forward, left and turning; the clearance in each
            direction; and which share of each of `PROBED_MOVES` is free, from -1 to 1.
        """
        index = np.arange(len(self._sideways)) if robots is None else np.asarray(robots)
        goal, odometry = observation["goal"], observation["odometry"]
        kind, place, heading, jambs, has_door = np.split(goal, _GOAL_PARTS, axis=-1)
        headings = np.arctan2(odometry[:, 3], odometry[:, 2])
        poses = np.column_stack((odometry[:, :2], headings)).astype(np.float64).tolist()
        rooms = []
        for row, k in enumerate(index.tolist()):
            memory, (x, y, turned) = self.memories[k], poses[row]
            memory.take_in((x, y, turned), observation["scan"][row])
            rooms.append(memory.room((x, y, turned), unseen(observation, row)))
        clearances = np.stack([room.clearances for room in rooms])
        free = np.stack([room.free for room in rooms])
        return np.concatenate(
            (
                self._sideways[index],
                kind,
                _squash_place(place),
                heading,
                _squash_place(jambs[:, :2]),
                _squash_place(jambs[:, 2:]),
                has_door,
                squashed(odometry[:, _VELOCITY:]),
                clearances / (CLEARANCE_SCALE + clearances),
                2.0 * free - 1.0,
            ),
            axis=-1,
            dtype=np.float32,
        )


def unseen(observation: Observation, row: int) -> FloatArray:
    """Obstacles without lidar hits: the bumps, and the jambs of the goal's door.

    Args:
        observation: a row for each robot.
        row: of one.

    Returns:
        Points in the robot frame, metres, shape (n, 2).
    """
    counted = observation["bumps_mask"][row] > 0
    bumps = observation["bumps"][row].reshape(BUMP_ROWS, 4)[counted].astype(np.float64)
    goal = observation["goal"][row]
    jambs = goal[_GOAL_PARTS[2] : _GOAL_PARTS[3]].reshape(-1, 2)[: 2 * int(goal[-1])]
    touched = points_of_segments(bumps) if len(bumps) else bumps.reshape(-1, 2)
    points: FloatArray = np.vstack((touched, jambs))
    return points


def _squash_place(place: Array) -> Array:
    """Places (x, y), each with its distance squashed and its direction kept."""
    distance = np.hypot(place[:, :1], place[:, 1:])
    return np.asarray(place / (PLACE_SCALE + distance), np.float32)


def squashed(values: Array) -> Array:
    """Squash each value on its own."""
    return np.asarray(values / (1.0 + np.abs(values)), np.float32)
