"""The scripted agent: it uses only the observation, which a real robot would have as well."""

from __future__ import annotations

from collections.abc import Collection
from typing import Any

import numpy as np
from numpy.typing import NDArray

from semnav_agents.base import Observation
from semnav_agents.cruise_kernels import cruise
from semnav_agents.pilot import Pilot
from semnav_agents.planning.cruise import CRUISE, GOAL_ROW, ODOMETRY_ROW
from semnav_agents.planning.known_obstacles import JoinedObstacles, Obstacles, as_obstacles
from semnav_agents.planning.obstacles import points_of_segments
from semnav_agents.planning.perception import Perception
from semnav_env.mind.observations import (
    EntryObservation,
    PaceEntry,
    SeenGoal,
    read_odometry,
    read_pace,
    table,
)
from semnav_env.robots import RobotSpec
from semnav_env.world.maps import FloorPlan
from semnav_features.frames import Pose, points_to_parent
from semnav_features.lidar_spec import LidarSpec

ENTRIES = (
    *("scan", "goal", "odometry", "pace"),
    *("remembered_doors", "remembered_doors_mask", "bumps", "bumps_mask"),
)
"""Entries of the observation that the scripted agent reads, "pace" if it is there."""


class ScriptedTeam:
    """Scripted agents for many robots, see `ScriptedAgent` and `AgentTeam`.

    All scans are taken in by one compiled call; then each robot decides by itself.

    Args:
        robots: how many there are.
    """

    observation = EntryObservation("all", extra=(PaceEntry(),))

    def __init__(self, robots: int) -> None:
        self._perception = Perception(robots)
        self._pilots: list[Pilot | None] = [None] * robots
        self._cruises = np.zeros(robots, CRUISE)
        self._cruised = np.zeros(robots, np.bool_)

    def reset(self, index: int, info: dict[str, Any], floor_plan: FloorPlan | None = None) -> None:
        """Begin an episode of a robot with the body and the lidar of `info`."""
        body = RobotSpec(**info["robot"])
        self._action_size = body.action_size
        self._pilots[index] = Pilot(body)
        self._cruised[index] = False
        self._cruises["counts"]["ready"][index] = False
        self._perception.reset(index, body.lidar_mount, LidarSpec(**info["lidar"]))

    def act(
        self, observations: Observation, driven: Collection[int] | None = None
    ) -> NDArray[np.float32]:
        """The next actions, shape (n, action size); zeros for robots that do not drive.

        Args:
            observations: each entry of shape (n, size).
            driven: numbers of the robots that drive; all if not given.

        Raises:
            ValueError: the observations lack the scan or the goal.
        """
        if not {"scan", "goal"} <= observations.keys():
            raise ValueError('the scripted agent needs scan and goal: give observation="all"')
        numbers = np.array(range(len(self._pilots)) if driven is None else list(driven), np.int64)
        given = {name: observations[name] for name in ENTRIES if name in observations}
        seen = {name: np.ascontiguousarray(entry) for name, entry in given.items()}
        self._perception.update(seen["odometry"], seen["scan"], numbers)
        return self._decide(seen, numbers)

    def own_goal(self, index: int) -> Pose | None:
        """None: robots drive to the goals of their beliefs."""

    def _decide(self, seen: Observation, driven: NDArray[np.int64]) -> NDArray[np.float32]:
        """The actions of robots whose scans have been taken in.

        Compiled code decides for those that cruise; the others decide one by one.
        """
        robots, size = len(self._pilots), self._action_size
        actions, decided = np.zeros((robots, size), np.float32), np.zeros(robots, np.bool_)
        bumped = seen["bumps_mask"].max(axis=1) > 0.5 if "bumps" in seen else decided
        paces = (
            seen["pace"][:, 0].astype(np.int64) if "pace" in seen else np.zeros(robots, np.int64)
        )
        states, centres, table, limits = self._perception.memory
        cruise(
            self._cruises,
            driven,
            seen["odometry"].view(ODOMETRY_ROW)[:, 0],
            seen["goal"].view(GOAL_ROW)[:, 0],
            paces,
            bumped | self._perception.any_moving,
            states,
            centres,
            table,
            limits,
            actions,
            decided,
        )
        self._cruised |= decided
        for k in driven[~decided[driven]].tolist():
            actions[k] = self._decide_alone(k, {name: values[k] for name, values in seen.items()})
        return actions

    def _decide_alone(self, index: int, observation: Observation) -> NDArray[np.float32]:
        """The action of one robot, to which anything may have happened."""
        pilot, record = self._pilots[index], self._cruises[index]
        assert pilot is not None
        if self._cruised[index]:
            pilot.take(record)
            self._cruised[index] = False
        action = self._act(index, pilot, observation)
        pilot.put(record)
        return action

    def _act(self, index: int, pilot: Pilot, observation: Observation) -> NDArray[np.float32]:
        """The action of a robot by its pilot."""
        pose, velocity = read_odometry(observation)
        return pilot.act(
            with_felt_walls(self._perception.obstacles(index), observation, pose),
            table(observation, "remembered_doors").astype(np.float64),
            SeenGoal.read(observation["goal"]),
            pose,
            velocity,
            self._perception.moving(index, pose, observation["scan"]),
            read_pace(observation),
        )


def with_felt_walls(obstacles: Obstacles, observation: Observation, pose: Pose) -> Obstacles:
    """The obstacles, and the walls that the robot at a pose has bumped into, in its frame."""
    if "bumps" not in observation or not len(bumps := table(observation, "bumps")):
        return obstacles
    walls = points_to_parent(pose, bumps.reshape(-1, 2).astype(np.float64)).reshape(-1, 4)
    return JoinedObstacles((obstacles, as_obstacles(points_of_segments(walls))))


class ScriptedAgent:
    """Drives to the observed goal around obstacles that the lidar or the body has hit.

    Goal, pace, odometry and scan come from the observation; body and lidar from `reset`. It is a
    `ScriptedTeam` of one.
    """

    observation: EntryObservation = ScriptedTeam.observation

    def __init__(self) -> None:
        self._team = ScriptedTeam(1)

    def reset(self, info: dict[str, Any]) -> None:
        """Begin an episode with the body and the lidar of `info`."""
        self._team.reset(0, info)

    def act(self, observation: Observation) -> NDArray[np.float32]:
        """The next action.

        Raises:
            ValueError: the observation lacks the scan or the goal.
        """
        seen = {name: observation[name][None] for name in ENTRIES if name in observation}
        action: NDArray[np.float32] = self._team.act(seen)[0]
        return action
