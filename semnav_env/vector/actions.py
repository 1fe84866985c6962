"""The actions of many robots as velocities."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from semnav_env.env import SemNavEnv
from semnav_env.robots.actions import action_array
from semnav_env.vector.tick import write_twists
from semnav_features.frames import FloatArray
from semnav_features.validation import require


class TeamActions:
    """Actions of several robots with one action space, see `Actions`.

    Args:
        envs: of the robots.
    """

    def __init__(self, envs: Sequence[SemNavEnv]) -> None:
        self._shape = (len(envs), *(envs[0].action_space.shape or ()))
        self._speeds = np.zeros((len(envs), 3))
        for k, env in enumerate(envs):
            self.renew(k, env)

    def renew(self, index: int, env: SemNavEnv) -> None:
        """Update the body of a robot, which may change from episode to episode."""
        robot = env.robot
        self._speeds[index] = robot.max_speed, robot.max_sideways_speed, robot.max_turn_rate

    def twists(self, actions: NDArray[Any]) -> FloatArray:
        """Actions as velocities, shape (n, 3).

        Raises:
            ValueError: they are not finite, have another shape, or are not made of real numbers.
        """
        shares = action_array(actions, self._shape).astype(np.float64, order="C")
        twists = np.zeros((len(shares), 3))
        finite = write_twists(shares, self._speeds, twists)
        require(finite, "the action", shares, "finite, in [-1, 1]")
        return twists
