"""The oracle: an agent that knows the floor plan and its own true pose."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from semnav_env.agents.base import Observation
from semnav_env.agents.pilot import Pilot
from semnav_env.agents.planning.obstacles import points_of_segments
from semnav_env.features.frames import points_to_local
from semnav_env.features.scene import ends_of
from semnav_env.observations import SeenGoal, read_odometry


class OracleAgent:
    """Drives to the true goal around everything that is solid in the plan, glass included.

    Its observation is the truth, so odometry is the true pose in the world.
    """

    observation = "truth"

    def reset(self, info: dict[str, Any]) -> None:
        """Begin an episode in the floor plan of `info`."""
        self._pilot = Pilot(info["robot_spec"])
        self._points = points_of_segments(info["floor_plan"].segments)
        self._doors = ends_of(info["floor_plan"].scene.doors).reshape(-1, 2)

    def act(self, observation: Observation) -> NDArray[np.float32]:
        """The next action."""
        pose, velocity = read_odometry(observation)
        doors = points_to_local(pose, self._doors).reshape(-1, 4)
        goal = SeenGoal.read(observation["goal"])
        return self._pilot.act(self._points, doors, goal, pose, velocity)
