"""Shortest ways through a floor plan on a grid, for rewards, routes and measures of paths."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from itertools import count
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from semnav_env.world.maps.cell_budget import check_cells, spacing_within_budget
from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_env.world.maps.nearness import clear_near
from semnav_env.world.maps.recent_fields import RecentFields
from semnav_features.frames import FloatArray, Point
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.grid_search import descent, least_costs

GRID_SPACING = 0.1
"""Distance between the points of the grid, metres; larger in a plan of more than 60,000 m2."""

COARSEST_SPACING = 0.2
"""Largest distance between the points of the grid, metres: ways still lead through doors."""

CLEARANCE = 0.2
"""Distance that the way of the robot's centre keeps from everything solid, metres: a door of 0.8 m
stays passable."""

DISCOMFORT_FACTOR = 3.0
"""Extra cost of a comfortable way right beside something solid, in multiples of its length."""

RECENT_FIELDS = RecentFields(max_bytes=250_000_000)
"""Distances to the goals used last, in all plans together: doors come up again and again, but in a
large plan the distances to one take megabytes."""

_NUMBERS = count()
"""Of `Geodesic`s, each of which has fields of its own."""


class Geodesic:
    """Shortest ways of a robot's centre in one floor plan, each computed when it is asked for.

    Args:
        floor_plan: the plan.
        comfort: distance from everything solid that ways prefer to keep, metres. Nearer to it they
            cost more, so that they run in the middle of corridors; 0 for the shortest ways.
        clearance: distance from everything solid that every way keeps, metres.

    Attributes:
        origin: first point of the grid, (x, y) in metres.
        spacing: distance between its points, metres.

    Raises:
        FloorPlanError: the plan is too large for a grid.
    """

    def __init__(
        self, floor_plan: FloorPlan, comfort: float = 0.0, clearance: float = CLEARANCE
    ) -> None:
        west, south, east, north = floor_plan.boundary.bounds
        self.origin = (west, south)
        self.spacing = spacing_within_budget(
            floor_plan, GRID_SPACING, COARSEST_SPACING, "for ways to be found in it"
        )
        self._floor_plan, self._number = floor_plan, next(_NUMBERS)
        self._comfort, self._clearance = comfort, clearance
        self._shape = (
            math.ceil((north - south) / self.spacing) + 1,
            math.ceil((east - west) / self.spacing) + 1,
        )

    def __getstate__(self) -> dict[str, Any]:
        made_again = ("free", "_weight")
        return {name: value for name, value in self.__dict__.items() if name not in made_again}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state, _number=next(_NUMBERS))

    def to(self, goal: Point) -> WaysTo:
        """The shortest ways to a point."""
        return WaysTo(goal, self)

    def distances_to(self, goal: Point) -> FloatArray:
        """Cost of the way from every cell of the grid to a goal, metres, shape (rows, columns).

        They are kept in `RECENT_FIELDS`. Cells without a way are infinite.
        """
        cell = self._cell(goal)
        return RECENT_FIELDS.get((self._number, cell), lambda: self._distances_to_cell(cell))

    def _distances_to_cell(self, cell: tuple[int, int]) -> FloatArray:
        source, diagonal = np.array([cell]), self.spacing * math.hypot(1, 1)
        return least_costs(source, np.zeros(1), self._weight, self.spacing, diagonal, True)

    def _cell(self, point: Point) -> tuple[int, int]:
        """The nearest free cell (row, column)."""
        found = _nearest_free(self.free, *self.origin, self.spacing, *point)
        if found[0] < 0:
            raise ValueError(f"{self._floor_plan.name} has no free place")
        return found

    @cached_property
    def free(self) -> NDArray[np.bool_]:
        """Whether the robot's centre may be in each cell, shape (rows, columns)."""
        floor_plan = self._floor_plan
        rows, columns = map(np.arange, self._shape)
        x = self.origin[0] + self.spacing * columns
        y = self.origin[1] + self.spacing * rows
        free = np.asarray(shapely.contains_xy(floor_plan.boundary, x, y[:, None]), dtype=bool)
        reach = self._clearance - 1e-9  # what is exactly so far away is free
        clear_near(free, floor_plan.segments, *self.origin, self.spacing, reach)
        self._block_inside(free, np.asarray(floor_plan.furniture.geometries))
        return free

    def _block_inside(self, free: NDArray[np.bool_], pieces: NDArray[Any]) -> None:
        """Clear the cells inside pieces of furniture, polygons: no way begins or ends there.

        The cells in the bounding boxes of all pieces are tested in one call; `inner` counts those
        of one piece, row by row.
        """
        low, high = np.split(shapely.bounds(pieces).reshape(-1, 4) - np.tile(self.origin, 2), 2, 1)
        first = np.ceil(low / self.spacing).astype(int)
        sizes = np.maximum(np.floor(high / self.spacing).astype(int) + 1 - first, 0)
        cells = sizes.prod(axis=1)
        check_cells(cells.sum(), f"{self._floor_plan.name}: the {len(pieces)} pieces of furniture")
        piece = np.repeat(np.arange(len(pieces)), cells)
        inner = np.arange(len(piece)) - np.repeat(np.cumsum(cells) - cells, cells)
        width = sizes[piece, 0]
        column, row = first[piece, 0] + inner % width, first[piece, 1] + inner // width
        x, y = self.origin[0] + self.spacing * column, self.origin[1] + self.spacing * row
        shapely.prepare(pieces)
        inside = shapely.contains_xy(pieces[piece], x, y)
        free[row[inside], column[inside]] = False

    @cached_property
    def _weight(self) -> FloatArray:
        """Cost of a metre of way in each cell; infinite where no way leads."""
        weight = np.where(self.free, 1.0, np.inf)
        if self._comfort:
            from scipy.ndimage import distance_transform_edt  # seldom needed, and slow to import

            room = self._clearance + self.spacing * distance_transform_edt(self.free)
            weight += DISCOMFORT_FACTOR * np.clip(1.0 - room / self._comfort, 0.0, 1.0)
        return weight


@dataclass(frozen=True, eq=False)
class WaysTo:
    """The shortest ways to one goal.

    Attributes:
        goal: (x, y) in metres.
        geodesic: shortest ways of the floor plan.
    """

    goal: Point
    geodesic: Geodesic

    @cached_property
    def distances(self) -> FloatArray:
        """Cost of the way from every cell of the grid to the goal, metres."""
        return self.geodesic.distances_to(self.goal)

    @property
    def field(self) -> tuple[FloatArray, float, float, float]:
        """The distances; x of the first column, y of the first row, and spacing of the cells."""
        return self.distances, *self.geodesic.origin, self.geodesic.spacing

    def length(self, start: Point) -> float:
        """Length of the shortest way from `start`, metres; infinite if there is none."""
        return distance_at(*self.field, *start)

    def way(self, start: Point) -> FloatArray:
        """The shortest way from `start` as points, shape (k, 2)."""
        (west, south), spacing = self.geodesic.origin, self.geodesic.spacing
        row, column = round((start[1] - south) / spacing), round((start[0] - west) / spacing)
        first = _nearest_reached(self.distances, row, column)
        cells = descent(self.distances, *first, self.distances.size)
        inner = np.array((west, south)) + spacing * cells[:, ::-1]
        return np.vstack((start, inner[1:-1], self.goal))


@kernel
def distance_at(
    field: FloatArray, west: float, south: float, spacing: float, x: float, y: float
) -> float:
    """The distance at a point by way of the best of the nearest nine cells, metres."""
    row, column = round((y - south) / spacing), round((x - west) / spacing)
    best = np.inf
    for r in range(max(row - 1, 0), min(row + 2, field.shape[0])):
        for c in range(max(column - 1, 0), min(column + 2, field.shape[1])):
            dx, dy = west + spacing * c - x, south + spacing * r - y
            best = min(best, field[r, c] + math.sqrt(dx * dx + dy * dy))
    return best


@kernel
def _nearest_free(
    free: NDArray[np.bool_], west: float, south: float, spacing: float, x: float, y: float
) -> tuple[int, int]:
    """The nearest free cell (row, column), the first of those equally near; (-1, -1) without any.

    It is sought in a square of cells, which grows until nothing outside it can be nearer.
    """
    rows, columns = free.shape
    row, column = round((y - south) / spacing), round((x - west) / spacing)
    half = 2
    while True:
        best, found = np.inf, (-1, -1)
        for r in range(max(row - half, 0), min(row + half + 1, rows)):
            for c in range(max(column - half, 0), min(column + half + 1, columns)):
                dx, dy = west + spacing * c - x, south + spacing * r - y
                if free[r, c] and dx * dx + dy * dy < best:
                    best, found = dx * dx + dy * dy, (r, c)
        everything = max(row, rows - row, column, columns - column) <= half
        if everything or math.sqrt(best) < (half - 1) * spacing:
            return found
        half *= 2


@kernel(counts_references=True)
def _nearest_reached(field: FloatArray, row: int, column: int) -> tuple[int, int]:
    """The nearest cell with a finite distance."""
    best, found = np.inf, (0, 0)
    for r in range(field.shape[0]):
        for c in range(field.shape[1]):
            gap = (r - row) ** 2 + (c - column) ** 2
            if gap < best and field[r, c] < np.inf:
                best, found = gap, (r, c)
    return found
