"""The interface of agents that drive many robots at once, and the team of any agent's copies."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from semnav_agents.base import Agent, GoalHolder, Observation, PlanReader
from semnav_env.mind.observations import ObservationType
from semnav_env.world.maps import FloorPlan
from semnav_features.frames import Pose


class AgentTeam(Protocol):
    """Drives the robots of a vector environment, each through episodes of its own.

    Attributes:
        observation: the `observation=` of the environment that the agents need.
    """

    @property
    def observation(self) -> str | ObservationType:
        """As of an `Agent`."""
        ...

    def reset(self, index: int, info: dict[str, Any], floor_plan: FloorPlan) -> None:
        """Begin an episode of one robot.

        Args:
            index: number of the robot.
            info: as an `Agent` gets it.
            floor_plan: of the episode, for agents that know it.
        """

    def act(self, observations: Observation, driven: Collection[int]) -> NDArray[np.float32]:
        """The next actions.

        Args:
            observations: of all robots, each entry of shape (n, ...).
            driven: numbers of the robots that drive; the others stand still.

        Returns:
            shape (n, action size).
        """
        ...

    def own_goal(self, index: int) -> Pose | None:
        """The goal to which a robot drives, odom frame; None if that of its belief."""


class AgentsOneByOne:
    """A team of agents that decide one after the other.

    Args:
        agents: one for each robot, all of one kind.
    """

    def __init__(self, agents: Sequence[Agent]) -> None:
        self._agents = agents
        self.observation = agents[0].observation

    def reset(self, index: int, info: dict[str, Any], floor_plan: FloorPlan) -> None:
        """See `AgentTeam`."""
        agent = self._agents[index]
        if isinstance(agent, PlanReader):
            agent.read_plan(floor_plan)
        agent.reset(info)

    def act(self, observations: Any, driven: Collection[int]) -> NDArray[np.float32]:
        """See `AgentTeam`."""
        chosen = {k: self._agents[k].act(_row(observations, k)) for k in driven}
        size = len(next(iter(chosen.values())))
        actions = np.zeros((len(self._agents), size), np.float32)
        for k, action in chosen.items():
            actions[k] = action
        return actions

    def own_goal(self, index: int) -> Pose | None:
        """See `AgentTeam`."""
        agent = self._agents[index]
        return agent.own_goal() if isinstance(agent, GoalHolder) else None


def _row(observations: Any, index: int) -> Any:
    """The observation of one robot."""
    if isinstance(observations, dict):
        return {name: _row(values, index) for name, values in observations.items()}
    return observations[index]
