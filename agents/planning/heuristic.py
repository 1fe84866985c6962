"""Seconds still to go, from every cell, for a disc as wide as the robot."""

from __future__ import annotations

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

DIAGONAL = STEP * math.sqrt(2.0)

STEPS = np.array([(j, i) for j in (-1, 0, 1) for i in (-1, 0, 1) if (j, i) != (0, 0)])
"""To the cells around one, rows (j, i)."""

ROUND = 0.25
"""Seconds of way that are looked at together."""


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
    """The least time to a source over the free cells, 8-connected; infinite if cut off.

    Cells wait in no order, those that are reached within the next `ROUND` apart from the others:
    the same times as with Dijkstra's queue, in less time.

    Args:
        sources: cells as rows (j, i), shape (S, 2).
        first: time at each source, seconds, shape (S,).
        room: of `room_grid`.
        costs: gives the speed and the price of crowding.
    """
    n = room.shape[0]
    wide = n + 2
    slowness = _slowness(room, costs)
    time = np.full(wide * wide, np.inf)
    soon, later = np.empty(wide * wide, dtype=np.int64), np.empty(wide * wide, dtype=np.int64)
    waits = np.zeros(wide * wide, np.bool_)  # in one of them
    laters = 0
    for k in range(len(sources)):
        cell = (sources[k, 0] + 1) * wide + sources[k, 1] + 1
        if first[k] < time[cell]:
            time[cell] = first[k]
            later[laters] = cell
            laters += not waits[cell]
            waits[cell] = True
    while laters > 0:
        limit = time[later[:laters]].min() + ROUND
        soons, laters = _next_round(later[:laters], soon, time, limit)
        while soons > 0:
            soons -= 1
            cell = soon[soons]
            waits[cell] = False
            for k in range(8):
                beside = cell + STEPS[k, 0] * wide + STEPS[k, 1]
                length = DIAGONAL if STEPS[k, 0] * STEPS[k, 1] else STEP
                then = time[cell] + length / costs.speed * slowness[beside]
                if then >= time[beside]:
                    continue
                time[beside] = then
                if waits[beside]:
                    continue
                waits[beside] = True
                if then < limit:
                    soon[soons] = beside
                    soons += 1
                else:
                    later[laters] = beside
                    laters += 1
    return time.reshape(wide, wide)[1:-1, 1:-1].copy()


@njit(cache=True)
def _next_round(
    waiting: NDArray[np.int64], soon: NDArray[np.int64], time: FloatArray, limit: float
) -> tuple[int, int]:
    """Move the cells that are reached before `limit` to `soon`; how many are in each then."""
    soons = laters = 0
    for cell in waiting:
        if time[cell] < limit:
            soon[soons] = cell
            soons += 1
        else:
            waiting[laters] = cell
            laters += 1
    return soons, laters


@njit(cache=True)
def _slowness(room: FloatArray, costs: Costs) -> FloatArray:
    """How many times as long a way takes in each cell, with a rim that nothing enters, (m,)."""
    n = room.shape[0]
    slowness = np.full((n + 2, n + 2), np.inf)
    for j in range(n):
        for i in range(n):
            if room[j, i] >= 0.0:
                slowness[j + 1, i + 1] = 1.0 + crowding_at(room[j, i], costs)
    return slowness.ravel()


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
