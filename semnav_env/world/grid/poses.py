"""The poses that a rectangular body reaches on a grid of solid cells, turning where it must.

A flood fill over poses: the centre of the rectangle lies on a cell and its heading is one of a few;
from a pose it moves to the next cell or the next heading. A body covers every cell that it touches,
so a place that is found reachable is so with a few centimetres to spare.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely.geometry.base import BaseGeometry

from semnav_env.world.grid.cells import Grid
from semnav_features.frames import FloatArray
from semnav_features.kernels.compiling import kernel

TRIED, REACHED = 1, 2
"""What becomes of a pose: the body does not fit, or it can be there."""

RIM = 2
"""Rows and columns at each side of a grid that count as solid."""


@dataclass(frozen=True, eq=False)
class Reach:
    """Cells that the centre of a body can reach.

    Attributes:
        cells: whether the centre can be there in some heading, shape (rows, columns).
        states: `REACHED` for the poses in which it can be there, shape (rows, columns, headings).
        angles: the headings, radians, evenly spread over `turn` from 0, shape (headings,).
        turn: half a turn, or a whole one, radians.
        grid: where the cells lie.
    """

    cells: NDArray[np.bool_]
    states: NDArray[np.uint8]
    angles: FloatArray
    turn: float
    grid: Grid

    @property
    def area(self) -> float:
        """Area of the cells, square metres."""
        return float(self.cells.sum()) * self.grid.spacing**2

    def near(self, place: BaseGeometry, within: float = 0.0) -> bool:
        """Whether the centre gets within a distance of a place, metres, up to half a cell."""
        area = place.buffer(max(within, 0.75 * self.grid.spacing))
        if area.is_empty:  # as what is left of a room that is narrower than a robot
            return False
        west, south, east, north = area.bounds
        (first_row, first_column), (last_row, last_column) = map(
            self.grid.cell, ((west, south), (east, north))
        )
        block = self.cells[first_row : last_row + 1, first_column : last_column + 1]
        points = self.grid.points(np.argwhere(block) + np.array((first_row, first_column)))
        return bool(shapely.contains_xy(area, *points.T).any())

    def has(self, x: FloatArray, y: FloatArray, heading: FloatArray) -> NDArray[np.bool_]:
        """Whether the poses nearest to some are reached, arrays of one shape."""
        row, column = self.grid.cells(x, y)
        count = len(self.angles)
        k = np.rint(heading % self.turn / self.turn * count).astype(int) % count
        return np.asarray(self.states[row, column, k] == REACHED)


def reach_in_grid(
    blocked: NDArray[np.bool_],
    grid: Grid,
    size: tuple[float, float],
    headings: int,
    cell: tuple[int, int],
    turn: float = math.pi,
    heading: float | None = None,
) -> Reach:
    """The cells that a rectangular body reaches in a grid of solid cells.

    Args:
        blocked: the solid cells, shape (rows, columns); those at the rim count as solid, too.
        grid: where they lie.
        size: length and width of the body, metres.
        headings: number of headings of the body, evenly spread over `turn`.
        cell: row and column of the start.
        turn: half a turn, or a whole one where it matters which end is the front, radians.
        heading: of the body at the start, radians; None for any.
    """
    angles = turn * np.arange(headings) / headings
    starts, rows, firsts, lengths = _footprints(*size, grid.spacing, angles)
    far = math.ceil(math.hypot(*size) / 2 / grid.spacing) + 1
    blocked = blocked.copy()
    blocked[:RIM] = blocked[-RIM:] = blocked[:, :RIM] = blocked[:, -RIM:] = True
    k = -1 if heading is None else round(heading % turn / turn * headings) % headings
    cells, states = _flood(blocked, starts, rows, firsts, lengths, far, *cell, k)
    return Reach(cells, states, angles, turn, grid)


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


@kernel
def _flood(
    blocked: NDArray[np.bool_],
    starts: NDArray[np.int64],
    run_rows: NDArray[np.int64],
    run_firsts: NDArray[np.int64],
    run_lengths: NDArray[np.int64],
    far: int,
    row: int,
    column: int,
    heading: int,
) -> tuple[NDArray[np.bool_], NDArray[np.uint8]]:
    """The cells and the poses that the centre reaches, by a flood fill over cells and headings.

    Where nothing solid is within `far` cells, all headings are free and the cell is visited once;
    elsewhere each heading is a state of its own.

    Args:
        blocked: the solid cells.
        starts: index of the first run of each heading, see `_footprints`.
        run_rows: rows of the runs, see `_footprints`.
        run_firsts: first columns of the runs.
        run_lengths: lengths of the runs, cells.
        far: distance of the next solid cell beyond which every heading is free, cells.
        row: row of the start.
        column: column of the start.
        heading: index of the heading at the start, -1 for all.
    """
    rows, columns = blocked.shape
    headings = len(starts) - 1
    ahead = _free_ahead(blocked)
    wide = _wide(blocked, far)
    states = np.zeros((rows, columns, headings), dtype=np.uint8)
    reached = np.zeros((rows, columns), dtype=np.bool_)
    stack = [(row, column, k) for k in range(headings) if heading < 0 or k == heading]
    while len(stack) > 0:
        r, c, k = stack.pop()
        if states[r, c, k]:
            continue
        if wide[r, c]:
            states[r, c] = REACHED
        else:
            states[r, c, k] = TRIED
            free = r >= far and c >= far and r < rows - far and c < columns - far
            for i in range(starts[k], starts[k + 1]):
                free = free and (ahead[r + run_rows[i], c + run_firsts[i]] >= run_lengths[i])
                if not free:
                    break
            if not free:
                continue
            states[r, c, k] = REACHED
            stack.append((r, c, (k + 1) % headings))
            stack.append((r, c, (k - 1) % headings))
        reached[r, c] = True
        for dr, dc in ((0, 1), (1, 0), (0, -1), (-1, 0)):
            if not wide[r, c] or wide[r + dr, c + dc]:
                if not states[r + dr, c + dc, k]:
                    stack.append((r + dr, c + dc, k))
            else:
                for other in range(headings):
                    stack.append((r + dr, c + dc, other))
    return reached, states


@kernel
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


@kernel
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
