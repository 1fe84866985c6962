"""The interface of all agents, and the loop that lets one drive an episode."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple, Protocol

import gymnasium as gym
import numpy as np
from numpy.typing import NDArray

from semnav_env.observations import ObservationType

Observation = dict[str, NDArray[Any]]


class Agent(Protocol):
    """What drives a robot; any object with these members is an agent.

    Attributes:
        observation: the `observation=` of the environment that the agent needs.
    """

    @property
    def observation(self) -> str | ObservationType:
        """A mode, such as "all", or an observation type of the user's own."""
        ...

    def reset(self, info: dict[str, Any]) -> None:
        """Begin an episode.

        Args:
            info: the second value that `env.reset` returned.
        """

    def act(self, observation: Observation) -> NDArray[np.float32]:
        """The next action, in the environment's action space."""
        ...


class Step(NamedTuple):
    """An action and what `env.step` returned for it."""

    action: NDArray[np.float32]
    observation: Observation
    reward: float
    terminated: bool
    truncated: bool
    info: dict[str, Any]


def steps(
    env: gym.Env[Any, Any], agent: Agent, observation: Observation, info: dict[str, Any]
) -> Iterator[Step]:
    """Let an agent drive an episode to its end, step by step.

    Args:
        env: an environment with the `observation=` of the agent.
        agent: the driver; it is reset first.
        observation: the first value that `env.reset` returned.
        info: the second one.
    """
    agent.reset(info)
    over = False
    while not over:
        action = agent.act(observation)
        observation, reward, terminated, truncated, info = env.step(action)
        over = terminated or truncated
        yield Step(action, observation, float(reward), terminated, truncated, info)
