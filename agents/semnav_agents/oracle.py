"""The oracle: an agent that knows the floor plan and its own true pose."""

from __future__ import annotations

from typing import Any

import numpy as np
from gymnasium.spaces import Box
from numpy.typing import NDArray
from scipy.spatial import KDTree

from semnav_agents.base import Observation
from semnav_agents.pilot import Pilot
from semnav_agents.planning.known_obstacles import NO_POINTS
from semnav_agents.planning.obstacles import points_of_segments
from semnav_env.mind.observations import (
    EntryObservation,
    Moment,
    PaceEntry,
    SeenGoal,
    read_odometry,
    read_pace,
)
from semnav_env.mind.observations.layout import scan_space
from semnav_env.robots import RobotSpec
from semnav_env.world.maps import FloorPlan, load_floor_plan
from semnav_features.frames import FloatArray, Pose, compose, points_to_local, points_to_parent
from semnav_features.lidar_spec import LidarSpec
from semnav_features.scene import ends_of

SAME_PLACE = 0.1
"""Distance from all that is drawn in the plan beyond which a hit is on something else, metres."""


class ExactScan:
    """The scan as an entry beside the truth, which has no other.

    Attributes:
        name: its key in the observation.
    """

    name = "scan"

    def space(self, robot: RobotSpec, lidar: LidarSpec) -> Box[np.float32]:
        """The space of the entry."""
        self._range_max = lidar.range_max
        return scan_space(lidar)

    def observe(self, moment: Moment) -> NDArray[np.float32]:
        """The ranges, metres; a missing return reads as the lidar's range."""
        ranges: NDArray[np.float32] = moment.tracker.ranges.clip(0.0, self._range_max).astype("f4")
        return ranges


class OracleAgent:
    """Drives to the true goal around everything that is solid in the plan, glass included.

    Its observation is the truth, so odometry is the true pose in the world. What the plan does not
    draw, people above all, it sees with the lidar if the observation has a scan, and waits for it.
    """

    observation: EntryObservation = EntryObservation("truth", extra=(ExactScan(), PaceEntry()))

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
        self._lidar = LidarSpec(**info["lidar"])
        self._points = points_of_segments(plan.segments)
        self._drawn = KDTree(self._points)
        self._doors = ends_of(plan.scene.doors).reshape(-1, 2)

    def act(self, observation: Observation) -> NDArray[np.float32]:
        """The next action."""
        pose, velocity = read_odometry(observation)
        doors = points_to_local(pose, self._doors).reshape(-1, 4)
        goal = SeenGoal.read(observation["goal"])
        moving = self._not_drawn(observation["scan"], pose) if "scan" in observation else NO_POINTS
        pace = read_pace(observation)
        return self._pilot.act(self._points, doors, goal, pose, velocity, moving, pace)

    def _not_drawn(self, ranges: FloatArray, pose: Pose) -> FloatArray:
        """The hits on what the plan does not draw, world frame, shape (n, 2)."""
        hit = ranges < self._lidar.range_max
        local = ranges[hit, None] * self._lidar.directions[hit]
        hits = points_to_parent(compose(pose, self._pilot.robot.lidar_mount), local)
        distances, _ = self._drawn.query(hits, distance_upper_bound=SAME_PLACE)
        others: FloatArray = hits[distances > SAME_PLACE]
        return others
