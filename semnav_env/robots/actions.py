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
        self.space = Box(-1.0, 1.0, (robot.action_size,), np.float32)

    def twist(self, action: ArrayLike) -> Twist:
        """An action as a velocity: shares of the robot's largest speeds; cut to [-1, 1] first.

        Raises:
            ValueError: it is not finite or has another shape.
        """
        array = np.asarray(action)
        if array.dtype.kind != "f":
            array = array.astype(np.float64)
        if array.shape != self.space.shape:
            raise ValueError(f"the action has shape {array.shape}; it must be {self.space.shape}")
        forward, *sideways, turn = values = array.tolist()
        if not all(map(math.isfinite, values)):
            raise ValueError(f"the action is {values}; it must be finite, in [-1, 1]")
        left = _cut(sideways[0]) if sideways else 0.0
        fastest, fastest_left, fastest_turn = self._speeds
        return _cut(forward) * fastest, left * fastest_left, _cut(turn) * fastest_turn


def _cut(share: float) -> float:
    return 1.0 if share > 1.0 else -1.0 if share < -1.0 else share
