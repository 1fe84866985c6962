"""Lists, for every place in a floor plan, the few segments that a lidar or a body can reach."""

from __future__ import annotations

import math
from collections import OrderedDict
from dataclasses import dataclass
from queue import SimpleQueue
from threading import Lock
from typing import Any, TypeAlias
from weakref import WeakValueDictionary, finalize

import numpy as np
from numpy.typing import NDArray

from semnav_env.world.maps.cell_budget import MAX_CELLS
from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_features.frames import FloatArray
from semnav_features.kernels.compiling import kernel

GRID = np.dtype([("x", "f8"), ("y", "f8"), ("cell", "f8"), ("columns", "i8"), ("rows", "i8")])
"""The lower left corner, the side of a cell in metres, and how many cells: shape (1,)."""

CELL_SIZE = 2.0
"""Side of a cell, metres; larger where there would be too many cells, or too long lists in them."""

NEAR = 3.5
"""Segments within this distance of a cell's centre, metres, come first in its list: drawn first,
they hide many of the others."""

MAX_KEPT_BYTES = 256_000_000
"""How much memory lists take that nobody uses now: those of some 200 offices, more than the 120 of
a split; lists that are dropped are made again in a later episode."""

MAX_CULLING_CELLS = 10_000
"""Largest number of cells: it bounds the time that the lists of a plan take."""


@dataclass(frozen=True, eq=False)
class Culling:
    """Per cell of a grid, the segments within range of any point in the cell.

    The lists are stored one after the other, coordinates apart, so that the ray caster reads
    memory in order. One more list after the last cell's holds all segments: for a lidar
    outside the grid.

    Attributes:
        grid: shape (1,), dtype `GRID`.
        starts: where each list begins, shape (columns * rows + 2,), int64.
        ends: rows x1, y1, x2, y2 of the listed segments in metres, shape (4, m).
    """

    grid: np.ndarray
    starts: NDArray[np.int64]
    ends: FloatArray

    @property
    def size(self) -> int:
        """Bytes of the lists."""
        return self.starts.nbytes + self.ends.nbytes

    @property
    def arrays(self) -> tuple[np.ndarray, NDArray[np.int64], FloatArray]:
        """The attributes, as kernels take them."""
        return self.grid, self.starts, self.ends

    @classmethod
    def of(cls, segments: FloatArray, range_max: float) -> Culling:
        """Lists for these segments, shape (n, 4): x1, y1, x2, y2 in metres.

        Raises:
            ValueError: segments of another shape, or not finite.
        """
        rows = np.array(segments, np.float64, order="C")  # never read-only: kernels know one type
        if rows.ndim != 2 or rows.shape[1] != 4 or not np.isfinite(rows).all():
            raise ValueError(
                f"segments of shape {rows.shape} must be finite and of shape (n, 4): x1, y1, x2, y2"
            )
        grid = _grid(rows)
        starts, near = _list_starts(rows, grid, range_max)
        while starts[-1] > MAX_CELLS and len(starts) > 3:  # more than one cell
            grid = _grid(rows, 2.0 * float(grid["cell"][0]))
            starts, near = _list_starts(rows, grid, range_max)
        return cls(grid, starts, _listed_ends(rows, grid, range_max, starts, near))


Cullings: TypeAlias = WeakValueDictionary[tuple[bool, float], Culling]
"""Those of a floor plan by whether they hold glass, and by their range, while one uses them or they
are among the `Recent`."""


class Recent:
    """Keeps what was made last, for all threads of a process: at most `MAX_KEPT_BYTES` in all."""

    def __init__(self) -> None:
        self._kept: OrderedDict[int, Culling] = OrderedDict()
        self._gone: SimpleQueue[int] = SimpleQueue()
        self._lock = Lock()
        self.bytes = 0

    def drop_with(self, floor_plan: FloorPlan, culling: Culling) -> None:
        """Keep lists no longer than somebody has the floor plan of which they are."""
        # Only into a queue, because the garbage collector may call this at any moment.
        finalize(floor_plan, self._gone.put, id(culling)).atexit = False

    def keep(self, culling: Culling) -> None:
        """Note that lists were asked for."""
        with self._lock:
            while not self._gone.empty():
                self._drop(self._gone.get())
            self._drop(id(culling))
            self._kept[id(culling)] = culling
            self.bytes += culling.size
            while self.bytes > MAX_KEPT_BYTES and len(self._kept) > 1:
                self._drop(next(iter(self._kept)))

    def _drop(self, number: int) -> None:
        if (dropped := self._kept.pop(number, None)) is not None:
            self.bytes -= dropped.size


RECENT = Recent()
"""Those of this process."""


def shared_culling(floor_plan: FloorPlan, range_max: float, glass: bool) -> Culling:
    """The lists of a floor plan, one and the same for all who ask.

    Args:
        floor_plan: whose segments are listed.
        range_max: how far one reaches, metres.
        glass: whether glass is listed, too: it stops bodies, and no beams.
    """
    known = floor_plan.derived(_cullings)
    culling = known.get((glass, range_max))
    if culling is None:
        segments = floor_plan.segments if glass else floor_plan.opaque_segments
        known[glass, range_max] = culling = Culling.of(segments, range_max)
        RECENT.drop_with(floor_plan, culling)
    RECENT.keep(culling)
    return culling


def _cullings(floor_plan: FloorPlan) -> Cullings:
    """None yet."""
    return WeakValueDictionary()


def _grid(segments: FloatArray, least_cell: float = CELL_SIZE) -> np.ndarray:
    if len(segments) == 0:
        return np.array([(0.0, 0.0, CELL_SIZE, 1, 1)], GRID)
    points = segments.reshape(-1, 2)
    low, extent = points.min(axis=0), np.ptp(points, axis=0)
    cell = max(
        least_cell,
        math.sqrt(float(extent.prod()) / MAX_CULLING_CELLS),
        float(extent.max()) / MAX_CULLING_CELLS,
    )
    columns, rows = (extent // cell).astype(np.int64) + 1
    return np.array([(*low, cell, columns, rows)], GRID)


@kernel
def cell_of(grid: np.ndarray, x: float, y: float) -> Any:
    """Index (int) of the list for a lidar at (x, y): by its cell, or the last outside the grid."""
    g = grid[0]
    column, row = (x - g.x) // g.cell, (y - g.y) // g.cell
    if 0 <= column < g.columns and 0 <= row < g.rows:
        return int(row) * g.columns + int(column)
    return g.columns * g.rows


@kernel
def _centre(g: Any, cell: int) -> tuple[float, float]:
    return g.x + (cell % g.columns + 0.5) * g.cell, g.y + (cell // g.columns + 0.5) * g.cell


@kernel
def _reach(g: Any, range_max: float) -> Any:
    """Largest distance of a segment from a cell's centre, with a margin for rounding."""
    return range_max + g.cell * math.sqrt(0.5) + 1e-9


@kernel
def _squared_distance(segment: FloatArray, x: float, y: float) -> Any:
    """From the segment to a point, square metres."""
    dx, dy = segment[2] - segment[0], segment[3] - segment[1]
    to_x, to_y = x - segment[0], y - segment[1]
    squared = dx * dx + dy * dy
    along = (to_x * dx + to_y * dy) / squared if squared > 0.0 else 0.0
    along = min(max(along, 0.0), 1.0)
    off_x, off_y = to_x - along * dx, to_y - along * dy
    return off_x * off_x + off_y * off_y


@kernel
def _cells_near(segment: FloatArray, g: Any, reach: float) -> tuple[int, int, int, int]:
    """The columns and rows (first and one behind the last) whose centres may be within reach."""
    west, east = min(segment[0], segment[2]) - g.x, max(segment[0], segment[2]) - g.x
    south, north = min(segment[1], segment[3]) - g.y, max(segment[1], segment[3]) - g.y
    return (
        max(math.floor((west - reach) / g.cell), 0),
        min(math.ceil((east + reach) / g.cell), g.columns),
        max(math.floor((south - reach) / g.cell), 0),
        min(math.ceil((north + reach) / g.cell), g.rows),
    )


@kernel
def _list_starts(
    segments: FloatArray, grid: np.ndarray, range_max: float
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Where each list begins, see `Culling.starts`, and how many of a cell's segments are near."""
    g = grid[0]
    reach = _reach(g, range_max)
    starts = np.zeros(g.columns * g.rows + 2, np.int64)
    near = np.zeros(g.columns * g.rows, np.int64)
    for k in range(len(segments)):
        segment = segments[k]
        first, last, low, high = _cells_near(segment, g, reach)
        for row in range(low, high):
            for cell in range(row * g.columns + first, row * g.columns + last):
                x, y = _centre(g, cell)
                squared = _squared_distance(segment, x, y)
                starts[cell + 1] += squared <= reach * reach
                near[cell] += squared <= min(reach, NEAR) * min(reach, NEAR)
    for i in range(g.columns * g.rows):
        starts[i + 1] += starts[i]
    starts[-1] = starts[-2] + len(segments)
    return starts, near


@kernel
def _listed_ends(
    segments: FloatArray,
    grid: np.ndarray,
    range_max: float,
    starts: NDArray[np.int64],
    near: NDArray[np.int64],
) -> FloatArray:
    """The listed segments, see `Culling.ends`: in each list the near ones first."""
    g = grid[0]
    reach = _reach(g, range_max)
    ends, cells = np.empty((4, starts[-1])), g.columns * g.rows
    nearer, farther = starts[:cells].copy(), starts[:cells] + near  # the next free places
    for k in range(len(segments)):
        segment = segments[k]
        _put(ends, starts[cells] + k, segment)
        first, last, low, high = _cells_near(segment, g, reach)
        for row in range(low, high):
            for cell in range(row * g.columns + first, row * g.columns + last):
                x, y = _centre(g, cell)
                squared = _squared_distance(segment, x, y)
                if squared <= min(reach, NEAR) * min(reach, NEAR):
                    _put(ends, nearer[cell], segment)
                    nearer[cell] += 1
                elif squared <= reach * reach:
                    _put(ends, farther[cell], segment)
                    farther[cell] += 1
    return ends


@kernel
def _put(ends: FloatArray, place: int, segment: FloatArray) -> None:
    """Write a segment into a place of the lists."""
    for i in range(4):
        ends[i, place] = segment[i]
