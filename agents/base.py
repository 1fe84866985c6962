"""The one face of all agents."""

from __future__ import annotations

from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

Observation = dict[str, NDArray[Any]]


class Agent(Protocol):
    """Drives a robot through an episode.

    Attributes:
        observation: the `observation=` of the environment that it needs.
    """

    observation: str

    def reset(self, info: dict[str, Any]) -> None:
        """Begin an episode.

        Args:
            info: what `env.reset` returned.
        """

    def act(self, observation: Observation) -> NDArray[np.float32]:
        """The next action, in the environment's action space."""
