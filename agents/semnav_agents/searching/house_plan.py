"""What a robot that knows the plan of a house puts into its map: walls and rooms, no furniture."""

from __future__ import annotations

import numpy as np
import shapely

from semnav_agents.planning.obstacles import points_of_segments
from semnav_agents.searching.search_map import Mask, SearchMap
from semnav_agents.searching.settings import SearchSettings
from semnav_env.world.maps import FloorPlan, Material
from semnav_features.frames import FloatArray, Pose, points_to_local, points_to_parent

MARGIN = 1.0
"""Distance that the map reaches beyond the house, metres: the believed pose drifts."""

KNOWN_MARGIN = 6
"""Cells around what was seen within which the plan's walls no longer count for driving: there the
lidar knows better."""


class HousePlan:
    """Walls and rooms of a plan in the odometry frame of a robot.

    Args:
        plan: of the house; what is not built, furniture and people, is not looked at.
        start: pose of the robot at the start, world frame: it is told where it stands.

    Attributes:
        wall_points: on the walls, 5 cm apart, odometry frame, shape (n, 2).
    """

    def __init__(self, plan: FloorPlan, start: Pose) -> None:
        built = (Material.WALL, Material.GLASS)
        kept = np.array([surface.material in built for surface in plan.surfaces], dtype=bool)
        walls = plan.segments[kept[plan.owners]].reshape(-1, 2)
        segments = points_to_local(start, walls).reshape(-1, 4)
        self.wall_points: FloatArray = points_of_segments(segments, 0.05)
        self._plan, self._start = plan, start

    def chart(self, settings: SearchSettings) -> SearchMap:
        """A map of the house with its walls and rooms, in which nothing has been looked at."""
        lower, upper = self.wall_points.min(axis=0) - MARGIN, self.wall_points.max(axis=0) + MARGIN
        chart = SearchMap(settings, tuple(lower.tolist()), tuple(upper.tolist()))
        chart.walls[chart.grid.cells(*self.wall_points.T)] = True
        cells = np.argwhere(np.ones(chart.rooms.shape, bool))
        x, y = points_to_parent(self._start, chart.grid.points(cells)).T
        plan = self._plan
        regions = (*plan.rooms, *plan.areas, *plan.corridors, *plan.intersections)
        for number, region in reversed(list(enumerate(regions))):
            inside = shapely.contains_xy(region.polygon, x, y)
            chart.rooms[tuple(cells[inside].T)] = number
        return chart

    def unseen_walls(self, chart: SearchMap, known: Mask) -> FloatArray:
        """Points of walls of which the lidar has seen nothing near, shape (n, 2)."""
        unseen: FloatArray = self.wall_points[~known[chart.grid.cells(*self.wall_points.T)]]
        return unseen
