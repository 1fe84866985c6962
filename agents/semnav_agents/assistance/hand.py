"""The agent that does what a person wants."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from semnav_agents.base import Observation
from semnav_env.robots import RobotSpec


class Hand:
    """Repeats the action that somebody has set last; zeros at first.

    hand = Hand()
    assisted = Assisted(hand)          # at every step: hand.hold((0.5, 0.1))
    """

    observation = "all"

    def reset(self, info: dict[str, Any]) -> None:
        """Begin an episode at rest."""
        self._action = np.zeros(RobotSpec(**info["robot"]).action_size, np.float32)

    def hold(self, action: ArrayLike) -> None:
        """Set the action, in the environment's action space, until another one is set."""
        self._action = np.array(action, np.float32)

    def act(self, observation: Observation) -> NDArray[np.float32]:
        """The action that was set last."""
        return self._action.copy()
