"""The one face of all agents."""

from __future__ import annotations

from pathlib import Path
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


def make_agent(name: str) -> Agent:
    """The agent of that name, or the trained one at that path.

    Raises:
        ValueError: neither; says what there is.
    """
    if name == "scripted":
        from semnav_env.agents.scripted import ScriptedAgent

        return ScriptedAgent()
    if name == "oracle":
        from semnav_env.agents.oracle import OracleAgent

        return OracleAgent()
    if Path(name).exists():
        from semnav_env.agents.learned import LearnedAgent

        return LearnedAgent.load(name)
    raise ValueError(f"no agent {name!r}; there are: scripted, oracle, or the path of a trained one")
