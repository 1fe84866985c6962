"""The scripted agent: it uses only the observation, which a real robot would have as well."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from semnav_agents.base import Observation
from semnav_agents.pilot import Pilot
from semnav_agents.planning.known_obstacles import JoinedObstacles, Obstacles, as_obstacles
from semnav_agents.planning.moving import MovingHits
from semnav_agents.planning.obstacles import ObstacleMemory, points_of_segments
from semnav_env.mind.observations import (
    EntryObservation,
    PaceEntry,
    SeenGoal,
    read_odometry,
    read_pace,
    table,
)
from semnav_env.robots import RobotSpec
from semnav_features.frames import compose, points_to_parent
from semnav_features.lidar_spec import LidarSpec


class ScriptedAgent:
    """Drives to the observed goal around obstacles that the lidar or the body has hit.

    Goal, pace, odometry and scan come from the observation; body and lidar from `reset`.
    """

    observation = EntryObservation("all", extra=(PaceEntry(),))

    def __init__(self) -> None:
        self._obstacles, self._moving = ObstacleMemory(), MovingHits()

    def reset(self, info: dict[str, Any]) -> None:
        """Begin an episode with the body and the lidar of `info`."""
        self._pilot = Pilot(RobotSpec(**info["robot"]))
        self._lidar = LidarSpec(**info["lidar"])
        self._beams = self._lidar.directions
        self._obstacles.reset()
        self._moving.reset()

    def act(self, observation: Observation) -> NDArray[np.float32]:
        """The next action.

        Raises:
            ValueError: the observation lacks the scan or the goal.
        """
        if not {"scan", "goal"} <= observation.keys():
            raise ValueError('the scripted agent needs scan and goal: give observation="all"')
        pose, velocity = read_odometry(observation)
        lidar = compose(pose, self._pilot.robot.lidar_mount)
        ranges, limit = observation["scan"], self._lidar.range_max
        moves = self._moving.update(lidar, ranges, self._beams, limit)
        self._obstacles.update(lidar, np.where(moves, 0.0, ranges), self._beams, limit)
        moving = points_to_parent(lidar, ranges[moves, None] * self._beams[moves])
        goal = SeenGoal.read(observation["goal"])
        doors = table(observation, "remembered_doors").astype(np.float64)
        bumps = table(observation, "bumps").reshape(-1, 2).astype(np.float64)
        walls = points_to_parent(pose, bumps).reshape(-1, 4)
        points: Obstacles = self._obstacles
        if len(walls):
            points = JoinedObstacles((points, as_obstacles(points_of_segments(walls))))
        pace = read_pace(observation)
        return self._pilot.act(points, doors, goal, pose, velocity, moving, pace)
