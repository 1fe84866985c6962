"""Time still to go from every cell, for a disc that is as wide as the robot."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from semnav_agents.planning.collision import CELL_DIAGONAL, FIELD_CELL, Footprint, ObstacleField
from semnav_agents.planning.motion import MotionCosts, crowding_at
from semnav_env.world.grid.costs import least_costs
from semnav_features.frames import FloatArray, Point
from semnav_features.kernels.compiling import kernel

COARSE_CELLS = 2
"""Cells of the distance field along one side of a cell of the heuristic."""

COARSE_CELL = FIELD_CELL * COARSE_CELLS
"""Side of a cell of the heuristic, metres."""

COARSE_DIAGONAL = COARSE_CELL * math.sqrt(2.0)
"""Distance of two cells of the heuristic that touch at a corner, metres."""


@kernel
def room_grid(field: ObstacleField, body: Footprint, margin: float) -> FloatArray:
    """Room beside an inscribed disc in each coarse cell, metres; negative where it cannot be.

    Shape (n, n), [y, x]. The most favourable fine cell decides, so that a gap as wide as the
    robot stays open.
    """
    n = field.distance.shape[0] // COARSE_CELLS
    room = np.empty((n, n))
    for j in range(n):
        for i in range(n):
            best = -1.0  # `max` of a part of an array takes ten times as long
            for row in range(j * COARSE_CELLS, (j + 1) * COARSE_CELLS):
                for column in range(i * COARSE_CELLS, (i + 1) * COARSE_CELLS):
                    best = max(best, float(field.distance[row, column]))
            free = best + CELL_DIAGONAL >= body.half_width + margin
            room[j, i] = max(0.0, best - body.half_width) if free else -1.0
    return room


@kernel
def seconds_to(
    sources: NDArray[np.int64], first: FloatArray, room: FloatArray, costs: MotionCosts
) -> FloatArray:
    """The least time to a source over the free cells, 8-connected; infinite if cut off.

    Args:
        sources: cells as rows (j, i), shape (S, 2).
        first: time at each source, seconds, shape (S,).
        room: of `room_grid`.
        costs: gives the speed and the price of crowding.
    """
    straight, diagonal = COARSE_CELL / costs.speed, COARSE_DIAGONAL / costs.speed
    return least_costs(sources, first, _slowness(room, costs), straight, diagonal, False)


@kernel
def _slowness(room: FloatArray, costs: MotionCosts) -> FloatArray:
    """How many times as long a way takes in each cell; infinite where it cannot lead, (n, n)."""
    slowness = np.full(room.shape, np.inf)
    for j in range(room.shape[0]):
        for i in range(room.shape[1]):
            if room[j, i] >= 0.0:
                slowness[j, i] = 1.0 + crowding_at(room[j, i], costs)
    return slowness


@kernel
def coarse_cell(field: ObstacleField, x: float, y: float) -> tuple[int, int]:
    """The (j, i) of the heuristic's cell at a point; may lie outside the grid."""
    return math.floor((y - field.y) / COARSE_CELL), math.floor((x - field.x) / COARSE_CELL)


@kernel
def seconds_at(field: ObstacleField, time: FloatArray, x: float, y: float) -> float:
    """Seconds to go from a point, from its cell or the best neighbour; infinite outside."""
    n = time.shape[0]
    j, i = coarse_cell(field, x, y)
    if not (0 <= j < n and 0 <= i < n):
        return math.inf
    if time[j, i] < math.inf:
        return float(time[j, i])
    least = math.inf  # `min` of a table counts references when it is the first to be compiled
    for row in range(max(0, j - 1), min(n, j + 2)):
        for column in range(max(0, i - 1), min(n, i + 2)):
            least = min(least, time[row, column])
    return least + COARSE_CELL


def least_seconds(field: ObstacleField, a: Point, b: Point, costs: MotionCosts) -> float:
    """A time that no coarse way between two places undercuts, however free the floor is, seconds.

    It is the octile distance of their cells less a diagonal step, because `seconds_at` may begin at
    a neighbour of the cell of a place.
    """
    (j, i), (n, m) = coarse_cell(field, *a), coarse_cell(field, *b)
    fewer, more = sorted((abs(j - n), abs(i - m)))
    way = (more - fewer) * COARSE_CELL + (fewer - 1) * COARSE_DIAGONAL
    return way / costs.speed
