"""Selects which centres of the obstacle memory are obstacles, see `obstacle_kernels`."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from semnav_agents.planning.obstacle_kernels import VOXEL, WRAP, is_beyond, slot
from semnav_features.frames import FloatArray
from semnav_features.kernels.compiling import kernel

NEIGHBOUR_DISTANCE = 0.09
"""Distance of a neighbour, metres; a centre with far fewer hits than a neighbour is noise."""

NEIGHBOUR_REACH = 3 * VOXEL
"""Distance beyond which nothing is a neighbour, metres: those up to two voxels away are."""

MIN_LEAN = 0.6
"""Share of its neighbours to whose side a centre must lean to be the end of a row."""


class SelectionLimits(NamedTuple):
    """Those of `MemorySettings` that decide which centres count as obstacles.

    Attributes:
        sure: least number of hits.
        share: least number of hits, as a share of a neighbour's.
        blunt: length by which the ends of walls are shortened, metres.
    """

    sure: int
    share: float
    blunt: float


class SearchBox(NamedTuple):
    """A rectangle along the axes, metres."""

    left: float
    lower: float
    right: float
    upper: float


@kernel
def box_around(x: float, y: float, reach: float) -> SearchBox:
    """The square of half side `reach` around a place."""
    return SearchBox(x - reach, y - reach, x + reach, y + reach)


@kernel
def _holds(box: SearchBox, x: float, y: float, more: float) -> bool:
    """Whether a place lies in a box that is wider by `more` at each side."""
    return box.left - more < x < box.right + more and box.lower - more < y < box.upper + more


@kernel
def select(
    centres: NDArray[Any], table: NDArray[np.int32], box: SearchBox, limits: SelectionLimits
) -> FloatArray:
    """Positions of the centres that were hit often enough, by themselves and beside neighbours.

    The last centre of a row averages over the end of the wall it stands for. A centre with
    neighbours on one side only therefore gets a second point, `blunt` metres farther out.

    Args:
        centres: all of them.
        table: of voxels, -1 everywhere, before and after.
        box: where positions are wanted; some positions lie beside it.
        limits: of what counts.
    """
    chosen, n = np.empty(len(centres), np.int64), 0
    for k in range(len(centres)):
        if _holds(box, centres[k].x, centres[k].y, limits.blunt + NEIGHBOUR_REACH):
            chosen[n] = k
            n += 1
            j, i = slot(centres[k].x, centres[k].y)
            best: int = table[j, i]
            if best < 0 or centres[best].hits < centres[k].hits:
                table[j, i] = k
    points = _sure_points(centres, chosen[:n], table, box, limits)
    for k in chosen[:n]:
        j, i = slot(centres[k].x, centres[k].y)
        table[j, i] = -1
    return points


@kernel
def _sure_points(
    centres: NDArray[Any],
    chosen: NDArray[np.int64],
    table: NDArray[np.int32],
    box: SearchBox,
    limits: SelectionLimits,
) -> FloatArray:
    """See `select`; of the chosen centres those in the box."""
    points, n, share = np.empty((2 * len(chosen), 2)), 0, limits.share
    for k in chosen:
        centre = centres[k]
        if centre.hits < limits.sure or not _holds(box, centre.x, centre.y, limits.blunt):
            continue
        most, may_end = _neighbours(centres, table, k, share)
        if centre.hits < share * most:
            continue
        points[n, 0], points[n, 1] = centre.x, centre.y
        n += 1
        if not may_end or centre.hits < 2.0 * share * most:
            continue
        weight, to_x, to_y = _lean(centres, table, k, share)
        away = math.hypot(to_x, to_y)
        if weight > 0 and away > MIN_LEAN * weight:
            points[n, 0] = centre.x - limits.blunt * to_x / away
            points[n, 1] = centre.y - limits.blunt * to_y / away
            n += 1
    return points[:n]


@kernel
def _neighbours(
    centres: NDArray[Any], table: NDArray[np.int32], k: int, share: float
) -> tuple[float, bool]:
    """The largest number of hits of a neighbour, and whether `_lean` may be that of an end.

    Lengths are rounded here: only close cases need them exactly, most need no length at all.
    """
    j, i = slot(centres[k].x, centres[k].y)
    most, count, x, y, is_apart = 0.0, 0.0, 0.0, 0.0, True
    for b in range(j - 2, j + 3):
        for a in range(i - 2, i + 3):
            m: int = table[b & WRAP, a & WRAP]
            if m < 0 or m == k:
                continue
            dx, dy = centres[m].x - centres[k].x, centres[m].y - centres[k].y
            if not is_beyond(dx, dy, NEIGHBOUR_DISTANCE):
                most = max(most, centres[m].hits)
            squared = dx * dx + dy * dy
            is_apart &= squared > 1e-11
            if centres[m].hits >= share * centres[k].hits:
                inverse = 1.0 / math.sqrt(squared)
                count, x, y = count + 1.0, x + dx * inverse, y + dy * inverse
    least = MIN_LEAN * count - 1e-9
    return most, not is_apart or least < 0.0 or x * x + y * y > least * least


@kernel
def _lean(
    centres: NDArray[Any], table: NDArray[np.int32], k: int, share: float
) -> tuple[float, float, float]:
    """The number of centres up to two voxels away, and the sum of the unit vectors to them."""
    j, i = slot(centres[k].x, centres[k].y)
    count, x, y = 0.0, 0.0, 0.0
    for b in range(j - 2, j + 3):
        for a in range(i - 2, i + 3):
            m: int = table[b & WRAP, a & WRAP]
            if m < 0 or m == k:
                continue
            dx, dy = centres[m].x - centres[k].x, centres[m].y - centres[k].y
            away = math.hypot(dx, dy)
            if centres[m].hits >= share * centres[k].hits and away > 1e-6:
                count, x, y = count + 1.0, x + dx / away, y + dy / away
    return count, x, y
