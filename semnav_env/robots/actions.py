"""What an agent may do: shares of a robot's largest speeds, and their space."""

from __future__ import annotations

import math

import numpy as np
from gymnasium.spaces import Box
from numpy.typing import ArrayLike

from semnav_env.features.frames import Twist
from semnav_env.robots.spec import RobotSpec


class Actions:
    """The actions of one robot.

    Args:
        robot: whose speeds they are shares of.

    Attributes:
        space: (forward, turn) in [-1, 1], or (forward, left, turn) for a holonomic robot.
    """

    def __init__(self, robot: RobotSpec) -> None:
        self._speeds = robot.max_speed, robot.max_sideways_speed, robot.max_turn_rate
        self._sideways, self._shape = robot.holonomic, (robot.action_size,)
        self.space = Box(-1.0, 1.0, self._shape, np.float32)

    def twist(self, action: ArrayLike) -> Twist:
        """An action as a velocity: shares of the robot's largest speeds; cut to [-1, 1] first.

        Raises:
            ValueError: it is not finite or has another shape.
        """
        array = np.asarray(action)
        if array.dtype.kind != "f":
            array = array.astype(np.float64)
        if array.shape != self._shape:
            raise ValueError(f"the action has shape {array.shape}; it must be {self._shape}")
        values = array.tolist()
        forward, turn = values[0], values[-1]
        left = values[1] if self._sideways else 0.0
        if not (-1.0 <= forward <= 1.0 and -1.0 <= left <= 1.0 and -1.0 <= turn <= 1.0):
            if not all(map(math.isfinite, values)):
                raise ValueError(f"the action is {values}; it must be finite, in [-1, 1]")
            forward, left, turn = _cut(forward), _cut(left), _cut(turn)
        fastest, fastest_left, fastest_turn = self._speeds
        return forward * fastest, left * fastest_left, turn * fastest_turn


def _cut(share: float) -> float:
    return 1.0 if share > 1.0 else -1.0 if share < -1.0 else share
