"""What an agent may do: shares of a robot's largest speeds, and their space."""

from __future__ import annotations

import math

import numpy as np
from gymnasium.spaces import Box
from numpy.typing import ArrayLike

from semnav_env.features.frames import Pose
from semnav_env.robots import RobotSpec


class Actions:
    """The actions of one robot.

    Args:
        robot: whose speeds they are shares of.

    Attributes:
        space: (forward, turn) in [-1, 1], or (forward, left, turn) for a holonomic robot.
    """

    def __init__(self, robot: RobotSpec) -> None:
        sideways = (robot.max_sideways_speed,) if robot.holonomic else ()
        self._largest = (robot.max_speed, *sideways, robot.max_turn_rate)
        self.space = Box(-1.0, 1.0, (robot.action_size,), np.float32)

    def velocity(self, action: ArrayLike) -> Pose:
        """An action as (forward, left, turn) in m/s and rad/s; cut to [-1, 1] first.

        Raises:
            ValueError: it is not finite or has another shape.
        """
        array = np.asarray(action)
        if array.dtype.kind != "f":
            array = array.astype(np.float64)
        if array.shape != (len(self._largest),):
            wanted = (len(self._largest),)
            raise ValueError(f"the action has shape {array.shape}; it must be {wanted}")
        values = array.tolist()
        if not all(map(math.isfinite, values)):
            raise ValueError(f"the action is {values}; it must be finite, in [-1, 1]")
        speeds = [max(-1.0, min(1.0, v)) * s for v, s in zip(values, self._largest, strict=True)]
        forward, *left, turn = speeds
        return forward, left[0] if left else 0.0, turn
