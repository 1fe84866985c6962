"""Places that a rectangular body can reach in a floor plan, turning where it must.

A flood fill over poses: the centre of the rectangle lies on a grid and its heading is one of a few;
from a pose it moves to the next cell or the next heading. Everything solid is drawn onto the same
grid, and a body covers every cell that it touches, so a place that is found reachable is so with a
few centimetres to spare.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely.geometry.base import BaseGeometry

from semnav_env.world.maps.cell_budget import spacing_within_budget
from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_env.world.maps.pose_flood import REACHED, flood
from semnav_features.frames import FloatArray, Point
from semnav_features.kernels.compiling import kernel

REACH_SPACING = 0.05
"""Distance between the points of the grid, metres."""

HEADING_COUNT = 12
"""Number of headings over half a turn: a rectangle looks the same from behind."""

BORDER_CELLS = 4
"""Cells around the plan that nothing reaches."""

COARSEST_SPACING = 0.1
"""Largest spacing of the grid, metres: a coarser one shows no body the way through a door."""


@dataclass(frozen=True, eq=False)
class Reach:
    """Cells that the centre of a body can reach.

    Attributes:
        cells: whether the centre can be there in some heading, shape (rows, columns).
        states: `REACHED` for the poses in which it can be there, shape (rows, columns, headings).
        angles: the headings, radians, evenly spread over `turn` from 0, shape (headings,).
        turn: half a turn, or a whole one, radians.
        origin: middle of the first cell, (x, y) in metres.
        spacing: distance between the middles of cells, metres.
    """

    cells: NDArray[np.bool_]
    states: NDArray[np.uint8]
    angles: FloatArray
    turn: float
    origin: Point
    spacing: float

    @property
    def area(self) -> float:
        """Area of the cells, square metres."""
        return float(self.cells.sum()) * self.spacing**2

    def near(self, place: BaseGeometry, within: float = 0.0) -> bool:
        """Whether the centre gets within a distance of a place, metres, up to half a cell."""
        area = place.buffer(max(within, 0.75 * self.spacing))
        if area.is_empty:  # as what is left of a room that is narrower than a robot
            return False
        west, south, east, north = area.bounds
        first_column, first_row = self._cell(west, south)
        last_column, last_row = self._cell(east, north)
        block = self.cells[first_row : last_row + 1, first_column : last_column + 1]
        rows, columns = np.nonzero(block)
        x = self.origin[0] + self.spacing * (first_column + columns)
        y = self.origin[1] + self.spacing * (first_row + rows)
        return bool(shapely.contains_xy(area, x, y).any())

    def has(self, x: FloatArray, y: FloatArray, heading: FloatArray) -> NDArray[np.bool_]:
        """Whether the poses nearest to some are reached, arrays of one shape."""
        rows, columns, count = self.states.shape
        column = np.rint((x - self.origin[0]) / self.spacing).astype(int).clip(0, columns - 1)
        row = np.rint((y - self.origin[1]) / self.spacing).astype(int).clip(0, rows - 1)
        k = np.rint(heading % self.turn / self.turn * count).astype(int) % count
        return np.asarray(self.states[row, column, k] == REACHED)

    def _cell(self, x: float, y: float) -> tuple[int, int]:
        column = round((x - self.origin[0]) / self.spacing)
        row = round((y - self.origin[1]) / self.spacing)
        return max(column, 0), max(row, 0)


def reach(
    plan: FloorPlan,
    length: float,
    width: float,
    spacing: float = REACH_SPACING,
    headings: int = HEADING_COUNT,
    start: Point | None = None,
    turn: float = math.pi,
    border: int = BORDER_CELLS,
) -> Reach:
    """The cells that a rectangular body reaches from the middle of the largest corridor.

    In a plan without corridors it starts in the middle of the boundary.

    Args:
        plan: the floor plan.
        length: length of the body, metres.
        width: width of the body, metres.
        spacing: spacing of the grid, metres; a large plan gets a coarser one.
        headings: number of headings of the body, evenly spread over `turn`.
        start: where the body is instead, (x, y) in metres.
        turn: half a turn, or a whole one where it matters which end is the front, radians. At the
            start the body may have any heading that is free.
        border: cells of the grid around the plan. No place counts that is nearer to the rim of the
            grid than the body's corners reach, so a body right inside an outer wall needs more.

    Raises:
        FloorPlanError: the plan is too large for a grid.
    """
    west, south, east, north = plan.boundary.bounds
    spacing = spacing_within_budget(
        plan, spacing, max(spacing, COARSEST_SPACING), "to tell which parts a robot reaches"
    )
    origin = west - border * spacing, south - border * spacing
    shape = (
        math.ceil((north - south) / spacing) + 2 * border,
        math.ceil((east - west) / spacing) + 2 * border,
    )
    blocked = _drawn(plan.segments, *origin, spacing, *shape)
    start = start or _start(plan)
    column, row = (round((start[i] - origin[i]) / spacing) for i in (0, 1))
    return reach_in_grid(blocked, origin, spacing, (length, width), headings, (row, column), turn)


def reach_in_grid(
    blocked: NDArray[np.bool_],
    origin: Point,
    spacing: float,
    size: tuple[float, float],
    headings: int,
    cell: tuple[int, int],
    turn: float = math.pi,
    heading: float | None = None,
) -> Reach:
    """The cells that a rectangular body reaches in a grid of solid cells.

    Args:
        blocked: the solid cells, shape (rows, columns).
        origin: middle of the first cell, (x, y) in metres.
        spacing: of the cells, metres.
        size: length and width of the body, metres.
        headings: as in `reach`.
        cell: row and column of the start.
        turn: as in `reach`.
        heading: of the body at the start, radians; None for any.
    """
    angles = turn * np.arange(headings) / headings
    starts, rows, firsts, lengths = _footprints(*size, spacing, angles)
    far = math.ceil(math.hypot(*size) / 2 / spacing) + 1
    k = -1 if heading is None else round(heading % turn / turn * headings) % headings
    cells, states = flood(blocked, starts, rows, firsts, lengths, far, *cell, k)
    return Reach(cells, states, angles, turn, origin, spacing)


def _start(plan: FloorPlan) -> Point:
    corridors = [region.polygon for region in plan.corridors]
    area = max(corridors, key=lambda polygon: polygon.area, default=plan.boundary)
    point = area.representative_point()
    return point.x, point.y


def _footprints(
    length: float, width: float, spacing: float, angles: FloatArray
) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]:
    """The cells that a body touches in each heading, as runs of cells along the rows.

    Returns:
        For each heading the index of its first run, shape (headings + 1,); then for each run its
        row and first column, relative to the cell of the centre, and its length in cells.
    """
    starts, runs = [0], []
    half = math.ceil(math.hypot(length, width) / 2 / spacing) + 1
    offsets = np.arange(-half, half + 1)
    for angle in angles.tolist():
        c, s = abs(math.cos(angle)), abs(math.sin(angle))
        x, y = np.meshgrid(offsets * spacing, offsets * spacing)
        ahead = x * math.cos(angle) + y * math.sin(angle)
        left = y * math.cos(angle) - x * math.sin(angle)
        reach_of_cell = (c + s) * spacing / 2
        touched = (np.abs(ahead) < length / 2 + reach_of_cell - 1e-9) & (
            np.abs(left) < width / 2 + reach_of_cell - 1e-9
        )
        touched &= np.abs(x) < (c * length + s * width) / 2 + spacing / 2 - 1e-9
        touched &= np.abs(y) < (s * length + c * width) / 2 + spacing / 2 - 1e-9
        for row in np.flatnonzero(touched.any(axis=1)):
            columns = np.flatnonzero(touched[row])
            runs.append((offsets[row], offsets[columns[0]], columns[-1] - columns[0] + 1))
        starts.append(len(runs))
    table = np.array(runs, dtype=np.int64)
    return np.array(starts), table[:, 0].copy(), table[:, 1].copy(), table[:, 2].copy()


@kernel(counts_references=True)
def _drawn(
    segments: FloatArray, west: float, south: float, spacing: float, rows: int, columns: int
) -> NDArray[np.bool_]:
    """The cells that something solid passes through; the cells at the rim are solid too."""
    blocked = np.zeros((rows, columns), dtype=np.bool_)
    blocked[:2] = blocked[-2:] = True
    blocked[:, :2] = blocked[:, -2:] = True
    for i in range(len(segments)):
        x1, y1 = (segments[i, 0] - west) / spacing, (segments[i, 1] - south) / spacing
        x2, y2 = (segments[i, 2] - west) / spacing, (segments[i, 3] - south) / spacing
        steps = max(1, math.ceil(8.0 * math.hypot(x2 - x1, y2 - y1)))
        for k in range(steps + 1):
            row = round(y1 + (y2 - y1) * k / steps)
            column = round(x1 + (x2 - x1) * k / steps)
            if 0 <= row < rows and 0 <= column < columns:
                blocked[row, column] = True
    return blocked
