"""The scripted agent: it uses only the observation, which a real robot would have as well."""

from __future__ import annotations

from collections.abc import Collection
from typing import Any

import numpy as np
from numpy.typing import NDArray

from semnav_agents.base import Observation
from semnav_agents.pilot import Pilot
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

    def reset(self, index: int, info: dict[str, Any], floor_plan: FloorPlan | None = None) -> None:
        """Begin an episode of a robot with the body and the lidar of `info`."""
        body = RobotSpec(**info["robot"])
        self._pilots[index] = Pilot(body)
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
        seen = {name: observations[name] for name in ENTRIES if name in observations}
        self._perception.update(seen["odometry"], seen["scan"], numbers)
        chosen = [
            self._decide(k, {name: values[k] for name, values in seen.items()})
            for k in numbers.tolist()
        ]
        actions = np.zeros((len(self._pilots), len(chosen[0])), np.float32)
        actions[numbers] = chosen
        return actions

    def own_goal(self, index: int) -> Pose | None:
        """None: robots drive to the goals of their beliefs."""

    def _decide(self, index: int, observation: Observation) -> NDArray[np.float32]:
        """The action of one robot, whose scan has been taken in."""
        pilot = self._pilots[index]
        assert pilot is not None
        pose, velocity = read_odometry(observation)
        return pilot.act(
            with_felt_walls(self._perception.obstacles[index], observation, pose),
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
