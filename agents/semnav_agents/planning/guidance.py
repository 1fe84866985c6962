"""Coarse paths to a target, for a disc as wide as the robot."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from semnav_agents.planning.collision import Footprint, ObstacleField
from semnav_agents.planning.heuristic import (
    COARSE_CELL,
    coarse_cell,
    room_grid,
    seconds_at,
    seconds_to,
)
from semnav_agents.planning.lanes import close_gaps
from semnav_agents.planning.motion import MotionCosts
from semnav_env.world.grid.costs import descent
from semnav_features.frames import FloatArray, Point

MAX_DETOURS = 4
"""Largest number of searches for another way after a gap on the last one proved too narrow."""


@dataclass(frozen=True, eq=False)
class Guidance:
    """A coarse path to a target, and the time to the target from every cell.

    Attributes:
        place: its end, metres: the target, or the place that replaces it.
        exact: whether `place` is the target.
        reachable: whether the target, or the edge of the window towards it, can be reached.
        time: seconds to `place` from every cell.
        room: of `heuristic.room_grid`, with gaps that are too narrow closed.
        seconds: duration of the way to the target, infinite if it cannot be reached.
        way: cells (j, i) from the start, shape (M, 2).
        margin: the margin that the room was measured for, metres.
    """

    place: Point
    exact: bool
    reachable: bool
    time: FloatArray
    room: FloatArray
    way: NDArray[np.int64]
    seconds: float
    margin: float


def guidance_to(
    target: Point,
    start: Point,
    field: ObstacleField,
    body: Footprint,
    margin: float,
    costs: MotionCosts,
) -> Guidance:
    """Compute the coarse path from the start to the target, or as far towards it as possible.

    A target outside the window is replaced by the place on the edge of the window from which the
    path through free space is shortest. A target that is cut off is replaced by the nearest
    reachable place.
    """
    room = room_grid(field, body, margin)
    sources, first = _sources(field, room, target, costs)
    time = seconds_to(sources, first, room, costs)
    way = _way(time, field, start)
    for _ in range(MAX_DETOURS):
        if not close_gaps(field, body, room, way, margin):
            break
        time = seconds_to(sources, first, room, costs)
        way = _way(time, field, start)
    seconds = seconds_at(field, time, *start)
    reachable = math.isfinite(seconds)
    if reachable and len(sources) == 1:
        return Guidance(target, True, True, time, room, way, seconds, margin)
    place = (
        _centre(field, *way[-1].tolist())
        if reachable
        else _nearest(field, room, start, target, costs)
    )
    cell = np.array([coarse_cell(field, *place)])
    time = seconds_to(cell, np.zeros(1), room, costs)
    way = _way(time, field, start)
    return Guidance(place, False, reachable, time, room, way, seconds, margin)


def _way(time: FloatArray, field: ObstacleField, start: Point) -> NDArray[np.int64]:
    """The cells (j, i) from the start downhill; a way in the window is not longer than this."""
    way: NDArray[np.int64] = descent(time, *coarse_cell(field, *start), 4 * len(time))
    return way


def _sources(
    field: ObstacleField, room: FloatArray, target: Point, costs: MotionCosts
) -> tuple[NDArray[np.int64], FloatArray]:
    """The cell of the target, or all free edge cells with the time of a straight line beyond."""
    n = len(room)
    j, i = coarse_cell(field, *target)
    if 0 <= j < n and 0 <= i < n:
        return np.array([(j, i)]), np.zeros(1)
    edge = np.zeros((n, n), dtype=bool)
    edge[[1, -2], 1:-1] = edge[1:-1, [1, -2]] = True
    cells = np.ascontiguousarray(np.argwhere(edge & (room >= 0)))
    x, y = field.x + (cells[:, 1] + 0.5) * COARSE_CELL, field.y + (cells[:, 0] + 0.5) * COARSE_CELL
    return cells, np.hypot(x - target[0], y - target[1]) / costs.speed


def _nearest(
    field: ObstacleField, room: FloatArray, start: Point, target: Point, costs: MotionCosts
) -> Point:
    """The reachable place nearest to the target."""
    time = seconds_to(np.array([coarse_cell(field, *start)]), np.zeros(1), room, costs)
    j, i = np.indices(room.shape)
    distance = np.hypot(
        field.x + (i + 0.5) * COARSE_CELL - target[0], field.y + (j + 0.5) * COARSE_CELL - target[1]
    )
    best = int(np.argmin(np.where(np.isfinite(time), distance, np.inf)))
    return _centre(field, *divmod(best, len(room)))


def _centre(field: ObstacleField, j: int, i: int) -> Point:
    return field.x + (i + 0.5) * COARSE_CELL, field.y + (j + 0.5) * COARSE_CELL
