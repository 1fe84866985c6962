"""Shortest ways through a floor plan on a grid, for rewards, routes and measures of paths."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from semnav_env.world.grid.cells import Grid
from semnav_env.world.grid.costs import ANYWHERE, cost_at, costs_from, descent, nearest_reached
from semnav_env.world.grid.distance import distance_to_marked
from semnav_env.world.grid.occupancy import clear_near, mark_inside
from semnav_env.world.maps.box_room import DOUBT, SolidEdges
from semnav_env.world.maps.cell_budget import check_cells, spacing_within_budget
from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_env.world.maps.recent_fields import RecentFields
from semnav_features.frames import FloatArray, Point

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


class Geodesic:
    """Shortest ways of a robot's centre in one floor plan, each computed on demand.

    Args:
        floor_plan: the plan.
        comfort: distance from everything solid that ways prefer to keep, metres. Nearer to it they
            cost more, so that they run in the middle of corridors; 0 for the shortest ways.
        clearance: distance from everything solid that every way keeps, metres.

    Attributes:
        grid: corner, spacing and size of the grid.

    Raises:
        FloorPlanError: the plan is too large for a grid.
    """

    def __init__(
        self, floor_plan: FloorPlan, comfort: float = 0.0, clearance: float = CLEARANCE
    ) -> None:
        west, south, east, north = floor_plan.boundary.bounds
        spacing = spacing_within_budget(
            floor_plan, GRID_SPACING, COARSEST_SPACING, "for ways to be found in it"
        )
        self.grid = Grid.over((west, south), (east, north), spacing)
        self._floor_plan, self._number = floor_plan, RECENT_FIELDS.number(self)
        self._comfort, self._clearance = comfort, clearance

    def __getstate__(self) -> dict[str, Any]:
        made_again = ("free", "_weight")
        return {name: value for name, value in self.__dict__.items() if name not in made_again}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state, _number=RECENT_FIELDS.number(self))

    def to(self, goal: Point) -> WaysTo:
        """The shortest ways to a point."""
        return WaysTo(goal, self)

    def distances_to(self, goal: Point) -> FloatArray:
        """Cost of the way from every cell of the grid to a goal, metres, shape (rows, columns).

        They are kept in `RECENT_FIELDS`. Cells without a way are infinite.
        """
        cell = self._cell(goal)
        return RECENT_FIELDS.get(
            self._number, cell, lambda: costs_from(cell, self._weight, self.grid.spacing)
        )

    def _cell(self, point: Point) -> tuple[int, int]:
        """The nearest free cell (row, column)."""
        found = nearest_reached(self._weight, *self.grid.frame, *point, ANYWHERE)
        if found[0] < 0:
            raise ValueError(f"{self._floor_plan.name} has no free place")
        return found

    @cached_property
    def free(self) -> NDArray[np.bool_]:
        """Whether the robot's centre may be in each cell, shape (rows, columns)."""
        free, furniture = self._inside(), np.zeros(self.grid.shape, dtype=bool)
        reach = self._clearance - 1e-9  # what is exactly so far away is free
        solid = self._floor_plan.segments.copy()  # not read-only: kernels know one type
        clear_near(free, solid, *self.grid.frame, reach)
        self._check_furniture()
        edges = self._floor_plan.derived(SolidEdges.of)
        mark_inside(furniture, edges.furniture, edges.pieces, *self.grid.frame)
        return free & ~furniture

    def _inside(self) -> NDArray[np.bool_]:
        """Whether each cell lies in the boundary; exact geometry decides on its outline."""
        outline = self._floor_plan.derived(SolidEdges.of).outline
        inside = np.zeros(self.grid.shape, dtype=bool)
        certain = np.ones(self.grid.shape, dtype=bool)
        mark_inside(inside, outline, np.array([0, len(outline)]), *self.grid.frame)
        clear_near(certain, outline, *self.grid.frame, DOUBT)
        row, column = np.nonzero(~certain)
        x, y = self.grid.x[column], self.grid.y[row]
        inside[row, column] = shapely.contains_xy(self._floor_plan.boundary, x, y)
        return inside

    def _check_furniture(self) -> None:
        """Refuse furniture that covers too many cells, each piece counted alone."""
        pieces = np.asarray(self._floor_plan.furniture.geometries)
        low, high = np.split(shapely.bounds(pieces).reshape(-1, 4) / self.grid.spacing, 2, axis=1)
        cells = (high - low + 1.0).prod(axis=1).sum()
        check_cells(cells, f"{self._floor_plan.name}: the {len(pieces)} pieces of furniture")

    @cached_property
    def _weight(self) -> FloatArray:
        """Cost of a metre of way in each cell; infinite where no way leads."""
        weight = np.where(self.free, 1.0, np.inf)
        if self._comfort:
            room = np.empty(weight.shape)
            distance_to_marked(~self.free, self.grid.spacing, room)
            room += self._clearance
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
        return self.distances, *self.geodesic.grid.frame

    def length(self, start: Point) -> float:
        """Length of the shortest way from `start`, metres; infinite if there is none."""
        return cost_at(*self.field, *start)

    def way(self, start: Point) -> FloatArray:
        """The shortest way from `start` as points, shape (k, 2)."""
        west, south, spacing = self.geodesic.grid.frame
        row, column = round((start[1] - south) / spacing), round((start[0] - west) / spacing)
        cell = float(column), float(row)
        first = nearest_reached(self.distances, 0.0, 0.0, 1.0, *cell, ANYWHERE)
        cells = descent(self.distances, *first, self.distances.size)
        inner = self.geodesic.grid.points(cells)
        return np.vstack((start, inner[1:-1], self.goal))
