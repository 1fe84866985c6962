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

from semnav_env.features.frames import FloatArray, Point
from semnav_env.features.kernels.compiling import kernel
from semnav_env.maps.floor_plan import FloorPlan

REACH_SPACING = 0.05
"""Distance between the points of the grid, metres."""

HEADING_COUNT = 12
"""Number of headings over half a turn: a rectangle looks the same from behind."""

BORDER_CELLS = 4
"""Cells around the plan that nothing reaches."""

MAX_CELLS = 6_000_000
"""Largest number of cells of the grid; a larger plan gets a coarser one."""


@dataclass(frozen=True, eq=False)
class Reach:
    """Cells that the centre of a body can reach.

    Attributes:
        cells: whether the centre can be there in some heading, shape (rows, columns).
        origin: middle of the first cell, (x, y) in metres.
        spacing: distance between the middles of cells, metres.
    """

    cells: NDArray[np.bool_]
    origin: Point
    spacing: float

    def near(self, place: BaseGeometry, within: float = 0.0) -> bool:
        """Whether the centre gets within a distance of a place, metres, up to half a cell."""
        area = place.buffer(max(within, 0.75 * self.spacing))
        west, south, east, north = area.bounds
        first_column, first_row = self._cell(west, south)
        last_column, last_row = self._cell(east, north)
        block = self.cells[first_row : last_row + 1, first_column : last_column + 1]
        rows, columns = np.nonzero(block)
        x = self.origin[0] + self.spacing * (first_column + columns)
        y = self.origin[1] + self.spacing * (first_row + rows)
        return bool(shapely.contains_xy(area, x, y).any())

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
) -> Reach:
    """The cells that a rectangular body reaches from the middle of the largest corridor.

    In a plan without corridors it starts in the middle of the boundary.

    Args:
        plan: the floor plan.
        length: length of the body, metres.
        width: width of the body, metres.
        spacing: spacing of the grid, metres; a very large plan gets a coarser one.
        headings: number of headings of the body, evenly spread over half a turn.
        start: where the body is instead, (x, y) in metres.
    """
    west, south, east, north = plan.boundary.bounds
    spacing = max(spacing, math.sqrt((east - west) * (north - south) / MAX_CELLS))
    origin = west - BORDER_CELLS * spacing, south - BORDER_CELLS * spacing
    shape = (
        math.ceil((north - south) / spacing) + 2 * BORDER_CELLS,
        math.ceil((east - west) / spacing) + 2 * BORDER_CELLS,
    )
    blocked = _drawn(plan.segments, *origin, spacing, *shape)
    start = start or _start(plan)
    column, row = (round((start[i] - origin[i]) / spacing) for i in (0, 1))
    starts, rows, firsts, lengths = _footprints(length, width, spacing, headings)
    far = math.ceil(math.hypot(length, width) / 2 / spacing) + 1
    cells = _flood(blocked, starts, rows, firsts, lengths, far, row, column)
    return Reach(cells, origin, spacing)


def _start(plan: FloorPlan) -> Point:
    corridors = [region.polygon for region in plan.corridors]
    area = max(corridors, key=lambda polygon: polygon.area, default=plan.boundary)
    point = area.representative_point()
    return point.x, point.y


def _footprints(
    length: float, width: float, spacing: float, headings: int
) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]:
    """The cells that a body touches in each heading, as runs of cells along the rows.

    Returns:
        For each heading the index of its first run, shape (headings + 1,); then for each run its
        row and first column, relative to the cell of the centre, and its length in cells.
    """
    starts, runs = [0], []
    half = math.ceil(math.hypot(length, width) / 2 / spacing) + 1
    offsets = np.arange(-half, half + 1)
    for k in range(headings):
        angle = math.pi * k / headings
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


@kernel(counts_references=True)
def _flood(
    blocked: NDArray[np.bool_],
    starts: NDArray[np.int64],
    run_rows: NDArray[np.int64],
    run_firsts: NDArray[np.int64],
    run_lengths: NDArray[np.int64],
    far: int,
    row: int,
    column: int,
) -> NDArray[np.bool_]:
    """The cells that the centre reaches, by a flood fill over cells and headings.

    Where nothing solid is within `far` cells, all headings are free and only the cell is noted;
    elsewhere each heading is a state of its own.

    Args:
        blocked: the solid cells.
        starts: index of the first run of each heading, as `_footprints` gives it.
        run_rows: rows of the runs, as `_footprints` gives them.
        run_firsts: first columns of the runs.
        run_lengths: lengths of the runs, cells.
        far: distance of the next solid cell beyond which every heading is free, cells.
        row: row of the start.
        column: column of the start.
    """
    rows, columns = blocked.shape
    headings = len(starts) - 1
    ahead = _free_ahead(blocked)
    wide = _wide(blocked, far)
    known = np.zeros((rows, columns, headings), dtype=np.bool_)
    reached = np.zeros((rows, columns), dtype=np.bool_)
    stack = [(row, column, k) for k in range(headings)]
    while len(stack) > 0:
        r, c, k = stack.pop()
        if known[r, c, k]:
            continue
        if wide[r, c]:
            known[r, c] = True
        else:
            known[r, c, k] = True
            free = r >= far and c >= far and r < rows - far and c < columns - far
            for i in range(starts[k], starts[k + 1]):
                free = free and (ahead[r + run_rows[i], c + run_firsts[i]] >= run_lengths[i])
                if not free:
                    break
            if not free:
                continue
            stack.append((r, c, (k + 1) % headings))
            stack.append((r, c, (k - 1) % headings))
        reached[r, c] = True
        for dr, dc in ((0, 1), (1, 0), (0, -1), (-1, 0)):
            if not wide[r, c] or wide[r + dr, c + dc]:
                if not known[r + dr, c + dc, k]:
                    stack.append((r + dr, c + dc, k))
            else:
                for other in range(headings):
                    stack.append((r + dr, c + dc, other))
    return reached


@kernel(counts_references=True)
def _free_ahead(blocked: NDArray[np.bool_]) -> NDArray[np.int16]:
    """How many successive cells are free from each cell to the right, itself included."""
    rows, columns = blocked.shape
    ahead = np.zeros((rows, columns), dtype=np.int16)
    for r in range(rows):
        run = 0
        for c in range(columns - 1, -1, -1):
            run = 0 if blocked[r, c] else min(run + 1, 30_000)
            ahead[r, c] = run
    return ahead


@kernel(counts_references=True)
def _wide(blocked: NDArray[np.bool_], far: int) -> NDArray[np.bool_]:
    """Whether nothing solid is in the square of `far` cells to all sides of each cell.

    `total` is the summed-area table of the solid cells: the count in any rectangle is a sum of
    four of its entries.
    """
    rows, columns = blocked.shape
    total = np.zeros((rows + 1, columns + 1), dtype=np.int32)
    for r in range(rows):
        run = 0
        for c in range(columns):
            run += blocked[r, c]
            total[r + 1, c + 1] = total[r, c + 1] + run
    wide = np.zeros((rows, columns), dtype=np.bool_)
    for r in range(far, rows - far):
        for c in range(far, columns - far):
            a, b, left, right = r - far, r + far + 1, c - far, c + far + 1
            solid = total[b, right] - total[a, right] - total[b, left] + total[a, left]
            wide[r, c] = solid == 0
    return wide
