"""Destinations of people and the shortest ways there."""

from __future__ import annotations

import math

import numpy as np

from semnav_env.world.grid.costs import lowest_around, nearest_reached
from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_env.world.maps.geodesic import Geodesic, WaysTo
from semnav_features.frames import FloatArray, Point
from semnav_features.kernels.compiling import kernel

PEOPLE_CLEARANCE = 0.3
"""Least distance of the ways of people from everything solid, metres: a little more than the radius
of a body."""

LOOKAHEAD_CELLS = 8
"""Cells of the grid, mostly of 0.1 m, from a person down the way to the point they walk to."""

SEARCH_CELLS = 4
"""Cells to each side of a person among which the nearest one with a way is looked for; people are
pushed off the ways by others."""


class Destinations:
    """Shortest ways of people to the rooms, corridors and intersections of a plan.

    Each is worked out when somebody first wants to go there, and kept for all crowds of the plan.

    Args:
        floor_plan: the plan with its doors as they stand at first.
    """

    def __init__(self, floor_plan: FloorPlan) -> None:
        self._floor_plan = floor_plan
        self.places = _places(floor_plan)

    def to(self, index: int) -> WaysTo:
        """The ways to a place."""
        return self._floor_plan.derived(_geodesic).to(self.places[index])


def _geodesic(floor_plan: FloorPlan) -> Geodesic:
    """Ways of people, who are slimmer than a robot."""
    return Geodesic(floor_plan, clearance=PEOPLE_CLEARANCE)


def _places(floor_plan: FloorPlan) -> list[Point]:
    """A point in every region; in a plan with fewer than two, four points of its boundary."""
    points = [region.polygon.representative_point() for region in floor_plan.regions]
    if len(points) >= 2:
        return [(point.x, point.y) for point in points]
    west, south, east, north = floor_plan.boundary.bounds
    xs, ys = (west + 0.2 * (east - west), east - 0.2 * (east - west)), (0.25, 0.75)
    return [(x, south + share * (north - south)) for x in xs for share in ys]


@kernel
def look_ahead(
    field: FloatArray, west: float, south: float, spacing: float, x: float, y: float
) -> tuple[float, float, float]:
    """The direction in which somebody at (x, y) goes on, and how far it is.

    Args:
        field: distances of the cells of a grid, metres.
        west: x of its first column.
        south: y of its first row.
        spacing: between its cells, metres.
        x: metres.
        y: metres.

    Returns:
        A unit vector, or zeros at the goal and where no way is near; the way left, metres, which
        is then infinite.
    """
    near = (x - west) / spacing, (y - south) / spacing  # in cells
    row, column = nearest_reached(field, 0.0, 0.0, 1.0, near[0], near[1], SEARCH_CELLS)
    if row < 0:
        return 0.0, 0.0, np.inf
    left = field[row, column]
    for _ in range(LOOKAHEAD_CELLS):
        row, column = lowest_around(field, row, column)
    dx, dy = west + spacing * column - x, south + spacing * row - y
    length = math.hypot(dx, dy)
    return (dx / length, dy / length, left) if length > 1e-6 else (0.0, 0.0, left)
