"""The door that a driver means, told from where the wanted velocity leads."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from semnav_agents.planning.motion import Move, moved
from semnav_env.robots import RobotSpec
from semnav_env.robots.actions import Actions
from semnav_features.frames import FloatArray, points_to_local

INTENT_DISTANCE, INTENT_SECONDS = 1.6, 4.0
"""How far ahead a driver may mean a door: distance in metres, and time at the speed that is
wanted."""

JAMB_MISS = 0.35
"""How far beside a jamb a driver may aim who means the door, metres."""

MAX_INTENT_ANGLE = math.radians(60.0)
"""Largest angle to the direction square through a door at which a driver means it."""

SMOOTHING_SECONDS = 0.4
"""Time over which the driver's actions are averaged, for a trembling hand."""

WAY_STEPS = 20
"""Steps in which the way ahead is tested."""


class DoorIntent:
    """Averages the actions of a driver, and says where they lead.

    Args:
        robot: the body.
        control_hz: actions a second.

    Attributes:
        forward: share of the largest speed that the driver wants.
    """

    def __init__(self, robot: RobotSpec, control_hz: float) -> None:
        self._axle, self._actions = robot.axle, Actions(robot)
        self._share = min(1.0, 1.0 / (SMOOTHING_SECONDS * control_hz))
        self._meant = np.zeros(robot.action_size)

    def note(self, action: NDArray[np.float32]) -> None:
        """Take the next action of the driver."""
        self._meant += self._share * (action - self._meant)

    @property
    def forward(self) -> float:
        """See the class."""
        return float(self._meant[0])

    @property
    def way(self) -> FloatArray:
        """Poses of the centre on the way ahead, robot frame, shape (n, 3); one if it stands."""
        forward, left, turn = self._actions.twist(np.clip(self._meant, -1.0, 1.0))
        speed = math.hypot(forward, left)
        seconds = min(INTENT_SECONDS, INTENT_DISTANCE / max(speed, 1e-6))
        move = Move(forward * seconds, left * seconds, turn * seconds)
        shares = np.linspace(0.0, 1.0, WAY_STEPS + 1)
        way = np.array([moved(self._axle, 0.0, 0.0, move, share) for share in shares])
        way[:, :2] -= self._axle * np.column_stack((np.cos(way[:, 2]), np.sin(way[:, 2])))
        return way


def first_door(way: FloatArray, doors: FloatArray) -> FloatArray | None:
    """The door whose line a way crosses first; None if it crosses none.

    Args:
        way: poses in the robot frame, shape (n, 3).
        doors: their jambs in the robot frame, shape (m, 2, 2).
    """
    rows = [_crossing(way, door) for door in doors]
    if not rows or min(rows) == len(way):
        return None
    chosen: FloatArray = doors[int(np.argmin(rows))]
    return chosen


def _crossing(way: FloatArray, door: FloatArray) -> int:
    """Row of a way at which it has crossed the line of a door; the number of rows if never.

    The line is longer than the door by `JAMB_MISS` on both sides.
    """
    along = door[1] - door[0]
    width, direction = float(np.hypot(*along)), math.atan2(along[1], along[0])
    local = points_to_local((float(door[0, 0]), float(door[0, 1]), direction), way[:, :2])
    side = math.copysign(1.0, local[0, 1])
    behind = np.flatnonzero(side * local[:, 1] < 0.0)
    if not len(behind):
        return len(way)
    row = int(behind[0])
    through = direction - side * math.pi / 2
    is_hit = -JAMB_MISS <= local[row, 0] <= width + JAMB_MISS
    off = abs(math.remainder(float(way[row, 2]) - through, math.tau))
    return row if is_hit and off <= MAX_INTENT_ANGLE else len(way)
