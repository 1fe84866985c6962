"""The oracle: an agent that knows the floor plan and its own true pose."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from semnav_agents.base import Observation
from semnav_agents.pilot import Pilot
from semnav_agents.planning.obstacles import points_of_segments
from semnav_env.mind.observations import SeenGoal, read_odometry
from semnav_env.robots import RobotSpec
from semnav_env.world.maps import FloorPlan, load_floor_plan
from semnav_features.frames import points_to_local
from semnav_features.scene import ends_of


class OracleAgent:
    """Drives to the true goal around everything that is solid in the plan, glass included.

    Its observation is the truth, so odometry is the true pose in the world.
    """

    observation = "truth"

    def __init__(self) -> None:
        self._told: FloorPlan | None = None

    def read_plan(self, floor_plan: FloorPlan) -> None:
        """Learn the floor plan of the next episode."""
        self._told = floor_plan

    def reset(self, info: dict[str, Any]) -> None:
        """Begin an episode in the floor plan of `read_plan`, or else in that named by `info`.

        Raises:
            FloorPlanError: no plan was told, and none has this name.
        """
        plan, self._told = self._told or load_floor_plan(info["floor_plan"]), None
        self._pilot = Pilot(RobotSpec(**info["robot"]))
        self._points = points_of_segments(plan.segments)
        self._doors = ends_of(plan.scene.doors).reshape(-1, 2)

    def act(self, observation: Observation) -> NDArray[np.float32]:
        """The next action."""
        pose, velocity = read_odometry(observation)
        doors = points_to_local(pose, self._doors).reshape(-1, 4)
        goal = SeenGoal.read(observation["goal"])
        return self._pilot.act(self._points, doors, goal, pose, velocity)
