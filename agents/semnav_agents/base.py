"""The interface of all agents, and the loop that drives an episode."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple, Protocol, runtime_checkable

import gymnasium as gym
import numpy as np
from numpy.typing import NDArray

from semnav_env.mind.observations import ObservationType
from semnav_env.world.maps import FloorPlan
from semnav_features.frames import Pose

Observation = dict[str, NDArray[Any]]


class Agent(Protocol):
    """Drives a robot; any object with these members is an agent.

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
            info: the second value that `env.reset` returned; `RobotSpec(**info["robot"])` is the
                body and `LidarSpec(**info["lidar"])` the lidar.
        """

    def act(self, observation: Observation) -> NDArray[np.float32]:
        """Choose the next action, in the environment's action space."""
        ...


@runtime_checkable
class PlanReader(Protocol):
    """An agent that knows the floor plan, such as the oracle."""

    def read_plan(self, floor_plan: FloorPlan) -> None:
        """Learn the floor plan of the next episode, before `reset`."""


@runtime_checkable
class GoalHolder(Protocol):
    """An agent that finds the goal itself and does not drive to the goal of the belief."""

    def own_goal(self) -> Pose:
        """The goal to which the agent drives, odom frame."""
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
    if isinstance(agent, PlanReader):
        agent.read_plan(env.get_wrapper_attr("floor_plan"))
    agent.reset(info)
    over = False
    while not over:
        action = agent.act(observation)
        observation, reward, terminated, truncated, info = env.step(action)
        over = terminated or truncated
        yield Step(action, observation, float(reward), terminated, truncated, info)
