"""Agents that search a house: one knows its plan, one does not."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import binary_dilation

from semnav_agents.base import Observation
from semnav_agents.pilot import Pilot
from semnav_agents.planning.obstacles import (
    MemorySettings,
    ObstacleMemory,
    points_of_segments,
)
from semnav_agents.planning.planner import PlannerSettings
from semnav_agents.searching.house_plan import KNOWN_MARGIN, HousePlan
from semnav_agents.searching.plan_pose import PlanPose
from semnav_agents.searching.search_map import FREE, SearchMap, without_lost
from semnav_agents.searching.searcher import Searcher
from semnav_agents.searching.settings import SearchSettings
from semnav_agents.searching.views import Looker
from semnav_env.mind.grounding.goal import GoalKind
from semnav_env.mind.observations import (
    EntryObservation,
    ObservationType,
    SeenGoal,
    read_odometry,
    table,
)
from semnav_env.rescue.people_entry import PeopleEntry, read_people
from semnav_env.rescue.settings import PersonDetectorSettings
from semnav_env.robots import RobotSpec
from semnav_env.world.maps import FloorPlan
from semnav_features.frames import (
    ORIGIN,
    FloatArray,
    Point,
    Pose,
    compose,
    points_to_parent,
    relative,
    to_parent,
)
from semnav_features.lidar_spec import LidarSpec

UPDATE_EVERY = 3
"""Control periods between two scans that are added to the map: the period of the detector."""

HOUSE_MEMORY = MemorySettings(travel=60.0, turned=120.0, scans=6000, capacity=16384)
"""Obstacle memory for a whole house: walls that are seen again correct the drift."""

CAREFUL_PLANNER = PlannerSettings(margins=(0.10, 0.06, 0.04))
"""Planner settings of a search: places that cannot be reached with a margin are left out."""

STUCK_PLANNER = PlannerSettings()
"""Planner settings of a stuck robot: it came in, so it may get out without the margin."""

NO_DOORS: FloatArray = np.empty((0, 4))


class Explorer:
    """Searches a house without its plan: free floor, frontiers and people from its own map.

    Scan, odometry and people come from the observation; body, lidar and detector from `reset`.

    Args:
        settings: of the search.
    """

    def __init__(self, settings: SearchSettings = SearchSettings()) -> None:
        self.settings = settings
        self._obstacles = ObstacleMemory(HOUSE_MEMORY)
        self._house: HousePlan | None = None

    @property
    def observation(self) -> str | ObservationType:
        """All entries, and the people."""
        return EntryObservation("all", [PeopleEntry()])

    def reset(self, info: dict[str, Any]) -> None:
        """Begin an episode with the body, the lidar and the detector of `info`.

        Raises:
            ValueError: the environment has no person detector.
        """
        if "person_detector" not in info:
            raise ValueError("a search needs a person detector: make semnav_env:SearchAndRescue-v0")
        self._pilot, self._lidar = (
            Pilot(RobotSpec(**info["robot"])),
            LidarSpec(**info["lidar"]),
        )
        self._pilot.tolerance = self.settings.stop_tolerance
        self._detector = PersonDetectorSettings(**info["person_detector"])
        self._beams = self._lidar.directions
        self._obstacles.reset()
        self._chart = self._new_chart(info)
        detector = self._detector
        self._looker = Looker(self._pilot.robot, detector.field_of_view, detector.range_max)
        self._searcher = Searcher(self._chart, self._looker)
        self._steps = 0
        self._unseen: FloatArray = np.empty((0, 2))

    def act(self, observation: Observation) -> NDArray[np.float32]:
        """The next action; the robot stands still when nothing is left to inspect."""
        observation = self._localised(observation)
        pose, _ = read_odometry(observation)
        self._see(pose, observation["scan"])
        people = people_of(observation, pose)
        target = self._searcher.update(pose, people)
        return self._drive(observation, target, careful=not self._searcher.stuck)

    def _drive(
        self, observation: Observation, target: Pose | None, *, careful: bool
    ) -> NDArray[np.float32]:
        """The action that leads to a pose; standing still if there is none."""
        pose, velocity = read_odometry(observation)
        self._pilot.driver.planner = CAREFUL_PLANNER if careful else STUCK_PLANNER
        known, goal = self._points(observation, pose), goal_at(target, pose)
        return self._pilot.act(known, NO_DOORS, goal, pose, velocity)

    def _localised(self, observation: Observation) -> Observation:
        """The observation with the pose that is believed instead of that of the odometry."""
        return observation

    def _new_chart(self, info: dict[str, Any]) -> SearchMap:
        half = self.settings.half_side
        return SearchMap(self.settings, (-half, -half), (half, half))

    def _see(self, pose: Pose, scan: NDArray[Any]) -> None:
        eye = compose(pose, self._pilot.robot.lidar_mount)
        if self._steps % 2 == 0:
            self._obstacles.update(eye, scan, self._beams, self._lidar.range_max)
        if self._steps % UPDATE_EVERY == 0:
            self._remembered = self._obstacles.points()
            detector = self._detector
            ranges = without_lost(scan.astype(np.float64), self._lidar.range_max)
            self._chart.update(eye, self._beams, ranges, detector.field_of_view, detector.range_max)
            if self._house is not None and self._steps % (10 * UPDATE_EVERY) == 0:
                seen = self._chart.has(FREE) | (self._chart.hits > 0)
                known = binary_dilation(seen, iterations=KNOWN_MARGIN)
                self._unseen = self._house.unseen_walls(self._chart, known)
        self._steps += 1

    def _points(self, observation: Observation, pose: Pose) -> FloatArray:
        """All obstacle points, in the frame of `pose`, shape (n, 2)."""
        bumps = table(observation, "bumps").reshape(-1, 2).astype(np.float64)
        points = [self._remembered, self._unseen]
        if len(bumps):
            points.append(points_of_segments(points_to_parent(pose, bumps).reshape(-1, 4)))
        return np.vstack(points)


class PlanSearcher(Explorer):
    """Searches a house whose plan it knows: walls, doors and rooms, but no furniture.

    It knows its start pose in the plan; from then on the walls of the plan that it sees correct the
    drift of its odometry.
    """

    def __init__(self, settings: SearchSettings = SearchSettings()) -> None:
        super().__init__(settings)
        self._plan: FloorPlan | None = None

    def read_plan(self, floor_plan: FloorPlan) -> None:
        """Learn the plan of the next episode's house."""
        self._plan = floor_plan

    def _new_chart(self, info: dict[str, Any]) -> SearchMap:
        if self._plan is None:
            raise ValueError("the searcher knows the plan: call read_plan before reset")
        self._known_plan = self._plan
        self._house = HousePlan(self._plan, info["pose"])
        own = self._pilot.robot.lidar_mount, self._beams
        self._place = PlanPose(self._house.walls, *own)
        return self._house.chart(self.settings)

    def _localised(self, observation: Observation) -> Observation:
        """The observation with the pose in the frame of the plan."""
        pose, _ = read_odometry(observation)
        ranges = observation["scan"].astype(np.float64)
        x, y, heading = self._place.update(pose, ranges)
        odometry = observation["odometry"].copy()
        odometry[:4] = x, y, math.cos(heading), math.sin(heading)
        return {**observation, "odometry": odometry}


def people_of(observation: Observation, pose: Pose) -> list[tuple[Point, float, bool]]:
    """Place (odometry frame), probability and whether it is reported, of each possible person."""
    return [
        (to_parent(pose, each.place), each.probability, each.reported)
        for each in read_people(observation)
    ]


def goal_at(target: Pose | None, pose: Pose) -> SeenGoal:
    """The goal to reach a target, in the frame of `pose`; to stand still if there is none."""
    if target is None:
        return SeenGoal(GoalKind.STOP, ORIGIN, None)
    return SeenGoal(GoalKind.REACH, relative(pose, target), None)
