"""The actions of an agent: shares of a robot's largest speeds, and their space."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from gymnasium.spaces import Box
from numpy.typing import ArrayLike, NDArray

from semnav_env.robots.spec import RobotSpec
from semnav_features.frames import Twist
from semnav_features.validation import require


class Actions:
    """The actions of one robot.

    Args:
        robot: the robot with these largest speeds.

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
            ValueError: it is not finite, has another shape, or is not made of real numbers.
        """
        values = action_array(action, self._shape).tolist()
        forward, turn = values[0], values[-1]
        left = values[1] if self._sideways else 0.0
        if not (-1.0 <= forward <= 1.0 and -1.0 <= left <= 1.0 and -1.0 <= turn <= 1.0):
            require(all(map(math.isfinite, values)), "the action", values, "finite, in [-1, 1]")
            forward, left, turn = cut_share(forward), cut_share(left), cut_share(turn)
        fastest, fastest_left, fastest_turn = self._speeds
        return forward * fastest, left * fastest_left, turn * fastest_turn


def shares_of(twist: Twist, robot: RobotSpec) -> NDArray[np.float32]:
    """The action for a velocity: shares of a robot's largest speeds, cut to [-1, 1]."""
    forward, left, yaw_rate = twist
    shares = [cut_share(forward / robot.max_speed), cut_share(yaw_rate / robot.max_turn_rate)]
    if robot.holonomic:
        shares.insert(1, cut_share(left / robot.max_sideways_speed))
    return np.array(shares, dtype=np.float32)


def action_array(action: ArrayLike, shape: tuple[int, ...]) -> NDArray[Any]:
    """Actions as an array of real numbers, which may still be infinite or NaN.

    Raises:
        ValueError: another shape, or dates, complex numbers, texts, objects or masked entries.
    """
    try:
        array = np.asarray(action)
    except (TypeError, ValueError):  # rows of different lengths
        array = np.empty(0, object)
    if array.dtype.kind not in "fiu" or np.ma.is_masked(action):
        require(False, "the action", action, f"an array of real numbers, shape {shape}")
    if array.shape != shape:
        raise ValueError(f"the action has shape {array.shape}; it must be {shape}")
    return array if array.dtype.kind == "f" else array.astype(np.float64)


def cut_share(share: float) -> float:
    """A share of the largest speed, cut to [-1, 1]; kernels call this function, too."""
    return 1.0 if share > 1.0 else -1.0 if share < -1.0 else share
