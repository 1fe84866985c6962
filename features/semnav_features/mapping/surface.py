"""A scan as the matcher needs it: points, each with the line through its neighbours."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from semnav_features.frames import FloatArray
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.segmentation import is_return

X, Y, FOOT_X, FOOT_Y, NORMAL_X, NORMAL_Y, SPACING, VARIANCE, TILT, RANGE = range(10)
"""Rows of a surface: a point, its foot on the line through its neighbours, that line's unit
normal towards the scanner, distance to the farther neighbour (m), variance of the point across
the line (m^2), variance of the line's direction (rad^2), and the range (m; 0 where there is no
point with a line)."""

ROWS = RANGE + 1

_MIN_INCIDENCE = math.radians(4.0)
"""Neighbours that only a wall at a flatter incidence could join are not joined, radians."""

_NORMAL_MEDIAN = 0.6745
"""Median of the absolute value of a standard normal variable."""

_MIN_NOISE, _MAX_NOISE = 0.003, 0.05
"""Limits of what `range_noise` returns, metres."""

_MIN_LINE_POINTS = 3
"""Points of a line."""

_STACK_SIZE = 64
"""Pieces of one run that can wait to be split; a run with more is not split further."""


@kernel
def range_noise(ranges: FloatArray, limits: tuple[float, float]) -> Any:
    """The standard deviation of the ranges' noise, metres, estimated from the scan itself.

    Along a wall the second difference of the ranges, r[i-1] - 2 r[i] + r[i+1], is almost only
    noise, of six times the variance. The median of its absolute value ignores corners and jumps.
    """
    sizes = np.empty(len(ranges))
    count = 0
    for i in range(1, len(ranges) - 1):
        before, here, after = ranges[i - 1], ranges[i], ranges[i + 1]
        # Each by itself: what `min` and `max` make of a NaN depends on where it stands.
        if is_return(before, *limits) and is_return(here, *limits) and is_return(after, *limits):
            sizes[count] = abs(before - 2.0 * here + after)
            count += 1
    median = np.median(sizes[:count]) if count > 10 else 0.0
    return min(max(median / (_NORMAL_MEDIAN * math.sqrt(6.0)), _MIN_NOISE), _MAX_NOISE)


@kernel
def sense_surface(
    ranges: FloatArray,
    directions: FloatArray,
    angle_increment: float,
    limits: tuple[float, float],
    sigma: float,
    window: int,
    out: FloatArray,
) -> None:
    """Fit a line about every point of a scan, within the straight piece that it lies on.

    Pieces are parted by jumps of the range (Borges and Aldon's adaptive breakpoints) and by the
    iterative end-point fit; the line of a point is the total least squares fit of at most
    `window` neighbours on either side within its piece, from running sums.

    Args:
        ranges: of the scan, metres, shape (n,).
        directions: cosine and sine of each beam, shape (n, 2).
        angle_increment: of the scan, radians.
        limits: range_min and range_max of the scan, metres.
        sigma: standard deviation of a range, metres.
        window: neighbours on either side.
        out: shape (`ROWS`, n), see the names of its rows.
    """
    n = len(ranges)
    index = np.empty(n, np.int64)
    count = 0
    for i in range(n):
        r = ranges[i]
        out[RANGE, i] = 0.0
        out[X, i] = r * directions[i, 0]
        out[Y, i] = r * directions[i, 1]
        if is_return(r, *limits):
            index[count] = i
            count += 1
    first = 0
    for k in range(1, count + 1):
        if k == count or _parted(ranges, index[k - 1], index[k], angle_increment, sigma):
            _fit_pieces(out, index, first, k, ranges, directions, sigma, window)
            first = k


@kernel
def _parted(ranges: FloatArray, i: int, j: int, increment: float, sigma: float) -> Any:
    """Whether the surface jumps between two beams (Borges and Aldon 2004, eq. (5) of Weerakoon)."""
    angle_between = increment * (j - i)
    flattest = max(_MIN_INCIDENCE, 2.0 * angle_between)
    near, far = min(ranges[i], ranges[j]), max(ranges[i], ranges[j])
    limit = near * math.sin(angle_between) / math.sin(flattest - angle_between) + 4.0 * sigma
    apart = near * near + far * far - 2.0 * near * far * math.cos(angle_between)
    return j - i > 3 or apart > limit * limit


@kernel
def _fit_pieces(
    out: FloatArray,
    index: np.ndarray,
    first: int,
    stop: int,
    ranges: FloatArray,
    directions: FloatArray,
    sigma: float,
    window: int,
) -> None:
    """Split a run of joined points where it bends, and fit each piece."""
    stack = np.empty((_STACK_SIZE, 2), np.int64)
    stack[0] = first, stop
    used = 1
    while used > 0:
        used -= 1
        a, b = stack[used]
        bend = _bend(out, index, a, b, 4.0 * sigma)
        if bend > 0 and used < _STACK_SIZE - 2:
            stack[used] = bend, b
            stack[used + 1] = a, bend
            used += 2
        elif b - a >= _MIN_LINE_POINTS:
            _fit_piece(out, index, a, b, ranges, directions, sigma, window)


@kernel
def _bend(out: FloatArray, index: np.ndarray, first: int, stop: int, tolerance: float) -> int:
    """Where a run is farthest from its chord, if farther than `tolerance`; else 0."""
    a, b = index[first], index[stop - 1]
    dx, dy = out[X, b] - out[X, a], out[Y, b] - out[Y, a]
    farthest, place = tolerance * math.hypot(dx, dy), 0
    for k in range(first + 1, stop - 1):
        i = index[k]
        off = abs((out[X, i] - out[X, a]) * dy - (out[Y, i] - out[Y, a]) * dx)
        if off > farthest:
            farthest, place = off, k
    return place


@kernel
def _fit_piece(
    out: FloatArray,
    index: np.ndarray,
    first: int,
    stop: int,
    ranges: FloatArray,
    directions: FloatArray,
    sigma: float,
    window: int,
) -> None:
    """The line about each point of a straight piece, by total least squares on running sums."""
    x0, y0 = out[X, index[first]], out[Y, index[first]]
    low, high = first, first
    sx, sy, sxx, sxy, syy = 0.0, 0.0, 0.0, 0.0, 0.0
    for k in range(first, stop):
        while high < min(stop, k + window + 1):
            x, y = out[X, index[high]] - x0, out[Y, index[high]] - y0
            sx, sy = sx + x, sy + y
            sxx, sxy, syy = sxx + x * x, sxy + x * y, syy + y * y
            high += 1
        while low < k - window:
            x, y = out[X, index[low]] - x0, out[Y, index[low]] - y0
            sx, sy = sx - x, sy - y
            sxx, sxy, syy = sxx - x * x, sxy - x * y, syy - y * y
            low += 1
        m = high - low
        mx, my = sx / m, sy / m
        cxx, cxy, cyy = sxx - m * mx * mx, sxy - m * mx * my, syy - m * my * my
        angle = 0.5 * math.atan2(2.0 * cxy, cxx - cyy)
        ux, uy = math.cos(angle), math.sin(angle)
        length = max(cxx * ux * ux + 2.0 * cxy * ux * uy + cyy * uy * uy, 1e-12)
        i = index[k]
        nx, ny = -uy, ux
        if nx * out[X, i] + ny * out[Y, i] > 0.0:
            nx, ny = uy, -ux
        off = nx * (out[X, i] - x0 - mx) + ny * (out[Y, i] - y0 - my)
        out[FOOT_X, i] = out[X, i] - off * nx
        out[FOOT_Y, i] = out[Y, i] - off * ny
        out[NORMAL_X, i], out[NORMAL_Y, i] = nx, ny
        incidence = nx * directions[i, 0] + ny * directions[i, 1]
        out[VARIANCE, i] = sigma * sigma * incidence * incidence
        out[TILT, i] = out[VARIANCE, i] / length
        out[SPACING, i] = _spacing(out, index, k, first, stop)
        out[RANGE, i] = ranges[i]


@kernel
def _spacing(out: FloatArray, index: np.ndarray, k: int, first: int, stop: int) -> float:
    """Distance to the farther of the two neighbours in the piece, metres."""
    i = index[k]
    farther = 0.0
    if k > first:
        j = index[k - 1]
        farther = math.hypot(out[X, i] - out[X, j], out[Y, i] - out[Y, j])
    if k + 1 < stop:
        j = index[k + 1]
        farther = max(farther, math.hypot(out[X, i] - out[X, j], out[Y, i] - out[Y, j]))
    return farther
