"""The agent that hears the command: a learned grounding, and another agent that drives to goals."""

from __future__ import annotations

import math
from copy import copy
from pathlib import Path
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from semnav_agents.base import Agent, Observation
from semnav_agents.hearing.clause_state import ClauseState
from semnav_agents.hearing.elements import Description, describe
from semnav_agents.hearing.network import GroundingNetwork, NetworkOutput, NetworkShape
from semnav_agents.hearing.tokens import without_paces
from semnav_agents.networks.bundled import bundled_names, network_folder, network_kind
from semnav_agents.scripted import ScriptedAgent
from semnav_env.language.declarations import TokenVerb
from semnav_env.mind.grounding import GoalKind
from semnav_env.mind.observations import SeenGoal, read_odometry
from semnav_env.robots import RobotSpec
from semnav_features.frames import Pose, compose, points_to_parent, relative, to_local
from semnav_features.lidar_spec import LidarSpec

DECISION_STEPS = 3
"""Steps of the environment between decisions, 0.2 s."""

STAYING = SeenGoal(GoalKind.STOP, (0.0, 0.0, 0.0), None)
"""The goal of a command that is over."""

REST_SECONDS, REST_DISTANCE, REST_ANGLE = 1.0, 0.3, 0.3
"""A robot that stands for so long so near to where it was to be has carried the clause out."""

Decision = tuple[ClauseState, Description]
"""What the agent took to be under way, and what it saw, when the network was asked."""


def hearing_names() -> tuple[str, ...]:
    """Names of the agents that hear the command and come with the package, sorted."""
    return bundled_names(NetworkShape)


def hears(source: str | Path) -> bool:
    """Whether a name or folder belongs to an agent that hears the command."""
    return network_kind(source) == NetworkShape.KIND


class HearingAgent:
    """Grounds the current clause with a network, and lets another agent drive to its goal.

    The agent sees neither `goal` nor `clause`. It keeps the index of the current clause itself, and
    goes on to the next clause when the network says that the clause is done.

    Args:
        network: the trained network.
        driver: an agent that is given goals; the scripted one, a planner, if None.

    Attributes:
        decisions: inputs of the network in the last call of `act`.
    """

    observation = "command"

    def __init__(self, network: GroundingNetwork, driver: Agent | None = None) -> None:
        self.network = network
        self._driver: Agent = driver or ScriptedAgent()
        self.decisions: list[Decision] = []

    @classmethod
    def load(cls, path: str | Path, driver: Agent | None = None) -> Self:
        """The agent in a folder that `semnav train` wrote, or one of `hearing_names`.

        Args:
            path: the folder or the name.
            driver: see the class.

        Raises:
            ValueError: there is none, it is damaged, or it does not fit this version.
            OSError: a file cannot be read.
        """
        return cls(GroundingNetwork.load(network_folder(path)), driver)

    def reset(self, info: dict[str, Any]) -> None:
        """Begin an episode with the body and the lidar of `info`."""
        self._driver.reset(info)
        self._lidar, robot = LidarSpec(**info["lidar"]), RobotSpec(**info["robot"])
        self._mount = robot.lidar_mount
        self._state: ClauseState | None = None
        self._steps = 0
        self._pose: Pose = (0.0, 0.0, 0.0)
        self._goal = STAYING

    def act(self, observation: Observation) -> NDArray[np.float32]:
        """The next action."""
        observation = without_paces(observation)
        pose, velocity = read_odometry(observation)
        if self._state is None:
            self._state = ClauseState(observation["command"], pose)
        speed = float(np.hypot(*velocity[:2]))
        self._state.note(pose, speed, 1.0 / self._lidar.rate_hz)
        self.decisions = []
        if self._steps % DECISION_STEPS == 0:
            self._goal, self._pose = self._decide(observation, self._state, pose), pose
        self._steps += 1
        goal = _seen_from(pose, self._pose, self._goal)
        return self._driver.act({**observation, "goal": goal.values})

    def own_goal(self) -> Pose:
        """The goal that the network gave last, odometry frame."""
        return compose(self._pose, self._goal.pose)

    def _decide(self, observation: Observation, state: ClauseState, pose: Pose) -> SeenGoal:
        """The goal to drive to, robot frame; goes on to the clause that is current by now."""
        while not state.done:
            description = describe(observation, state, self._lidar, self._mount)
            self.decisions.append((copy(state), description))
            found = self.network.ground(description)
            goal = _goal_of(found, description)
            step = int(np.argmax(found.advances))
            if not step and _rests_at(goal, state):
                step = state.step_when_done
            if not step:
                return goal
            begin = _next_begin(found, description, state)
            state.start_clause(state.clause + step, begin, pose)
        return STAYING


def _goal_of(found: NetworkOutput, description: Description) -> SeenGoal:
    """The goal of a network output, robot frame."""
    kind, robot = GoalKind(int(np.argmax(found.kinds))), description.robot
    jambs = None
    if found.door is not None:
        ax, ay, bx, by = description.jambs[found.door].tolist()
        jambs = to_local(robot, (ax, ay)), to_local(robot, (bx, by))
    elif kind is GoalKind.PASS:  # without a door there is nothing to pass
        kind = GoalKind.SEEK
    return SeenGoal(kind, relative(robot, found.pose), jambs)


def _rests_at(goal: SeenGoal, state: ClauseState) -> bool:
    """Whether the robot stands at the goal of the clause."""
    x, y, turned = goal.pose
    near = math.hypot(x, y) < REST_DISTANCE and abs(turned) < REST_ANGLE
    return goal.kind is GoalKind.REACH and near and state.still > REST_SECONDS


def _next_begin(found: NetworkOutput, description: Description, state: ClauseState) -> Pose:
    """The pose where the next clause begins, odometry frame; a condition does not change it."""
    if state.tokens[state.clause, 0] == TokenVerb.IF_THERE:
        return state.begin
    return compose(description.frame, compose(found.pose, (found.next_along, 0.0, 0.0)))


def _seen_from(pose: Pose, then: Pose, goal: SeenGoal) -> SeenGoal:
    """A goal relative to an earlier pose, moved to the present robot frame."""
    moved = relative(pose, then)
    door = goal.door
    if door is not None:
        start, end = points_to_parent(moved, np.array(door)).tolist()
        door = (start[0], start[1]), (end[0], end[1])
    return SeenGoal(goal.kind, compose(moved, goal.pose), door)
