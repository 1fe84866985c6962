"""One body with one lidar that carries out commands: a belief, and an agent that acts on it."""

from __future__ import annotations

from typing import Any

import numpy as np

from semnav_agents.base import Agent, PlanReader
from semnav_agents.registry import AgentSource, make_agent
from semnav_env.language import Command, Follow, encode
from semnav_env.mind.belief import Belief, BeliefTracker
from semnav_env.mind.observations import Moment, as_observation
from semnav_env.robots import RobotSpec
from semnav_env.robots.actions import Actions
from semnav_features.frames import ORIGIN, FloatArray, Pose, Twist
from semnav_features.lidar_spec import LidarSpec
from semnav_ros.messages import Bumps

WARM_UP = Command((Follow(),))
"""A command for warming up."""


class CommandDrive:
    """Turns what a robot senses into velocities that carry out a command.

    Args:
        robot: the body, with the lidar on its mount.
        lidar: its lidar.
        agent: what drives, see `make_agent`; None if a navigator drives to the goals.

    Raises:
        ValueError: no such agent, or one that needs the floor plan or the truth.
    """

    def __init__(self, robot: RobotSpec, lidar: LidarSpec, agent: AgentSource | None) -> None:
        self._agent = None if agent is None else usable_agent(agent)
        if self._agent is not None:
            self._observation = as_observation(self._agent.observation)
            self._observation.space(robot, lidar)
        self._actions = Actions(robot)
        self._info: dict[str, Any] = {"robot": vars(robot).copy(), "lidar": vars(lidar).copy()}
        self.lidar = lidar
        self.tracker = BeliefTracker(lidar, robot.lidar_mount)

    def begin(self, command: Command, text: str) -> None:
        """Forget everything, and begin with a command.

        Raises:
            ValueError: the command names a room: nobody has told this robot a way.
        """
        self._told = encode(command), text
        self.tracker.begin(command)
        if self._agent is not None:
            self._agent.reset(self._info | {"instruction": text})

    def update(
        self, ranges: FloatArray, odometry: Pose, bumps: Bumps, seconds: float | None
    ) -> tuple[Belief, Twist]:
        """The belief after a scan, and the velocity of the robot's centre; see `BeliefTracker`.

        The velocity is zero where a navigator drives.
        """
        belief = self.tracker.update(ranges, odometry, bumps=bumps, seconds=seconds)
        if self._agent is None:
            return belief, ORIGIN
        action = self._agent.act(self._observation.observe(Moment(self.tracker, *self._told)))
        return belief, self._actions.twist(action)

    def warm(self) -> None:
        """Load and compile what an update needs, so that the first one is as fast as the others."""
        self.begin(WARM_UP, str(WARM_UP))
        for _ in range(3):
            self.update(np.full(self.lidar.beams, 2.0), ORIGIN, (), None)


def usable_agent(source: AgentSource) -> Agent:
    """An agent that a real robot can have.

    Raises:
        ValueError: no such agent, or one that needs the floor plan or the truth.
    """
    agent = make_agent(source)
    if isinstance(agent, PlanReader) or agent.observation == "truth":
        raise ValueError(f"agent {source!r} needs the floor plan, which a robot does not have")
    return agent
