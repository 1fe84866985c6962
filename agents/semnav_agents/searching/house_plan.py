"""Walls and rooms of the floor plan in the map of a robot that knows the plan; no furniture."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import shapely

from semnav_agents.planning.obstacles import points_of_segments
from semnav_agents.searching.outlines import Mask
from semnav_agents.searching.search_map import SearchMap
from semnav_agents.searching.settings import SearchSettings
from semnav_env.language.rooms import plain_name
from semnav_env.world.maps import FloorPlan, Material
from semnav_env.world.maps.floor_plan import Region
from semnav_features.frames import FloatArray, Pose, Twist, points_to_local, points_to_parent

MARGIN = 1.0
"""Distance that the map reaches beyond the house, metres: the believed pose drifts."""

OUTLINE_STEP = 0.01
"""Distance between the points of walls that count as hits, metres: five to a cell."""

KNOWN_MARGIN = 6
"""Cells around what was seen within which the plan's walls no longer count for driving: there the
lidar knows better."""

MOVING = 0.05
"""Speed from which on a robot counts as driving in some direction, m/s."""


def numbered_regions(plan: FloorPlan) -> tuple[Region, ...]:
    """The regions of a plan in the order of their numbers in the map; the first one wins."""
    return (*plan.rooms, *plan.areas, *plan.corridors, *plan.intersections)


class HousePlan:
    """Walls and rooms of a plan in the odometry frame of a robot.

    Args:
        plan: of the house; furniture and people in it are ignored.
        start: pose of the robot at the start, world frame, which the robot is given.

    Attributes:
        walls: x and y of both ends of each wall, odometry frame, shape (n, 4).
        wall_points: on the walls, 5 cm apart, odometry frame, shape (n, 2).
    """

    def __init__(self, plan: FloorPlan, start: Pose) -> None:
        built = (Material.WALL, Material.GLASS)
        kept = np.array([surface.material in built for surface in plan.surfaces], dtype=bool)
        walls = plan.segments[kept[plan.owners]].reshape(-1, 2)
        self.walls: FloatArray = points_to_local(start, walls).reshape(-1, 4)
        self.wall_points: FloatArray = points_of_segments(self.walls, 0.05)
        self._plan, self._start = plan, start

    def chart(self, settings: SearchSettings) -> SearchMap:
        """A map with the walls and rooms of the house, in which no floor has been searched."""
        lower, upper = self.wall_points.min(axis=0) - MARGIN, self.wall_points.max(axis=0) + MARGIN
        chart = SearchMap(settings, tuple(lower.tolist()), tuple(upper.tolist()))
        chart.walls[chart.grid.cells(*self.wall_points.T)] = True
        chart.add_hits(points_of_segments(self.walls, OUTLINE_STEP))
        cells = np.argwhere(np.ones(chart.rooms.shape, bool))
        x, y = points_to_parent(self._start, chart.grid.points(cells)).T
        for number, region in reversed(list(enumerate(numbered_regions(self._plan)))):
            inside = shapely.contains_xy(region.polygon, x, y)
            chart.rooms[tuple(cells[inside].T)] = number
        return chart

    def unseen_walls(self, chart: SearchMap, known: Mask) -> FloatArray:
        """Points of walls near which no beam has ended, shape (n, 2)."""
        unseen: FloatArray = self.wall_points[~known[chart.grid.cells(*self.wall_points.T)]]
        return unseen


def numbers_of(plan: FloorPlan, name: str | None) -> list[int]:
    """The numbers of the regions with a plain name; of all regions for None."""
    names = [plain_name(region.name) for region in numbered_regions(plan)]
    return [number for number, each in enumerate(names) if name in (None, each)]


def room_entered(
    chart: SearchMap, numbers: Sequence[int], pose: Pose, velocity: Twist, width: float
) -> int:
    """Which of some rooms a robot is in, or the nearest of them.

    A robot in a doorway is in the room into which it drives, forward, sideways or backward: what
    counts is the point half its width ahead, which lies within the body, so behind no wall.

    Args:
        chart: the map.
        numbers: of the rooms.
        pose: of the robot, odometry frame.
        velocity: forward and to the left, m/s, and yaw rate.
        width: of the robot, metres.

    Returns:
        The number of the room.
    """
    x, y, heading = pose
    forward, left, _ = velocity
    moves = math.hypot(forward, left) > MOVING
    course = heading + (math.atan2(left, forward) if moves else 0.0)
    place = x + width / 2 * math.cos(course), y + width / 2 * math.sin(course)
    cells = np.argwhere(np.isin(chart.rooms, numbers))
    away = np.hypot(*(chart.grid.points(cells) - place).T)
    return int(chart.rooms[tuple(cells[np.argmin(away)])])
