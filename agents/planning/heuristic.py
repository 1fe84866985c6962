"""Seconds still to go, from every cell, for a disc as wide as the robot."""

from __future__ import annotations

import heapq
import math

import numpy as np
from numba import njit
from numpy.typing import NDArray

from semnav_env.agents.planning.collision import CELL, SLACK, Body, Field
from semnav_env.agents.planning.motion import Costs, crowding_at
from semnav_env.features.frames import FloatArray

COARSE = 2
"""Cells of the distance field along one side of a cell of the heuristic."""

STEP = CELL * COARSE
"""Metres; cells of the heuristic."""


@njit(cache=True)
def room_grid(field: Field, body: Body, margin: float) -> FloatArray:
    """Room beside an inscribed disc in each coarse cell, metres; negative where it cannot be.

    Shape (n, n), [y, x]. The most favourable fine cell decides, so that a gap as wide as the
    robot stays open.
    """
    n = field.distance.shape[0] // COARSE
    room = np.empty((n, n))
    for j in range(n):
        for i in range(n):
            best = field.distance[
                j * COARSE : (j + 1) * COARSE, i * COARSE : (i + 1) * COARSE
            ].max()
            free = best + SLACK >= body.half_width + margin
            room[j, i] = max(0.0, best - body.half_width) if free else -1.0
    return room


@njit(cache=True)
def seconds_to(
    sources: NDArray[np.int64], first: FloatArray, room: FloatArray, costs: Costs
) -> FloatArray:
    """Dijkstra's least time to a source over the free cells, 8-connected; infinite if cut off.

    Args:
        sources: cells as rows (j, i), shape (S, 2).
        first: time at each source, seconds, shape (S,).
        room: of `room_grid`.
        costs: gives the speed and the price of crowding.
    """
    n = room.shape[0]
    time = np.full((n, n), np.inf)
    heap = [(0.0, 0)]
    heap.pop()
    for k in range(len(sources)):
        j, i = sources[k]
        if first[k] < time[j, i]:
            time[j, i] = first[k]
            heapq.heappush(heap, (first[k], j * n + i))
    while heap:
        t, cell = heapq.heappop(heap)
        j, i = cell // n, cell % n
        if t > time[j, i]:
            continue
        for dj in range(-1, 2):
            for di in range(-1, 2):
                b, a = j + dj, i + di
                if 0 <= b < n and 0 <= a < n and room[b, a] >= 0.0 and (dj != 0 or di != 0):
                    length = STEP * math.sqrt(float(dj * dj + di * di))
                    later = t + length / costs.speed * (1.0 + crowding_at(room[b, a], costs))
                    if later < time[b, a]:
                        time[b, a] = later
                        heapq.heappush(heap, (later, b * n + a))
    return time


@njit(cache=True)
def coarse_cell(field: Field, x: float, y: float) -> tuple[int, int]:
    """The (j, i) of the heuristic's cell at a point; may lie outside the grid."""
    return math.floor((y - field.y) / STEP), math.floor((x - field.x) / STEP)


@njit(cache=True)
def seconds_at(field: Field, time: FloatArray, x: float, y: float) -> float:
    """Seconds to go from a point, from its cell or the best neighbour; infinite outside."""
    n = time.shape[0]
    j, i = coarse_cell(field, x, y)
    if not (0 <= j < n and 0 <= i < n):
        return math.inf
    if time[j, i] < math.inf:
        return float(time[j, i])
    near = time[max(0, j - 1) : j + 2, max(0, i - 1) : i + 2].min()
    return float(near) + STEP


@njit(cache=True)
def descent(time: FloatArray, j: int, i: int) -> NDArray[np.int64]:
    """The cells of steepest descent from a cell to a source, rows (j, i), shape (M, 2)."""
    n = time.shape[0]
    cells = [(j, i)]
    while len(cells) < 4 * n:
        best_j, best_i = j, i
        for b in range(max(0, j - 1), min(n, j + 2)):
            for a in range(max(0, i - 1), min(n, i + 2)):
                if time[b, a] < time[best_j, best_i]:
                    best_j, best_i = b, a
        if best_j == j and best_i == i:
            break
        j, i = best_j, best_i
        cells.append((j, i))
    out = np.empty((len(cells), 2), dtype=np.int64)
    for k in range(len(cells)):
        out[k] = cells[k]
    return out
