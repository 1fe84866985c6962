"""Cuts a group of points into the most likely straight pieces, by dynamic programming."""

from __future__ import annotations

import math
from typing import Any

from semnav_features.frames import FloatArray
from semnav_features.kernels.compiling import kernel

PIECE_PRICE = 20.0
"""What one more piece must gain, in minus twice the log likelihood: by the Bayesian information
criterion three parameters (a line and a cut) times the logarithm of 800 beams."""

SUM_X, SUM_Y, SUM_XX, SUM_XY, SUM_YY, LEAST_COST, LAST_START, TRIAL_COST = range(8)
"""Columns of the table: sums over the points before each row, the least cost F of these points,
where the last piece of their best partition starts, and the cost of each start under trial."""


@kernel
def partition(
    xs: FloatArray,
    ys: FloatArray,
    first: int,
    last: int,
    variance: float,
    price: float,
    scratch: Any,
) -> int:
    """Cut points first to last where total least squares lines explain them best.

    With C(j, i) the squared distances of points j to i (exclusive) from their own line, in
    variances, the least cost of the first i points is

        F(0) = -price,  F(i) = min over j < i of F(j) + C(j, i) + price,

    minus twice the logarithm of a likelihood with a prior on the number of pieces (optimal
    partitioning, Jackson et al. 2005). A start j is dropped for good once F(j) + C(j, i) > F(i):
    it can never win again, as cutting at i costs no more (PELT, Killick et al. 2012, (4)).

    Args:
        xs: metres, like ys.
        ys: points in beam order.
        first: first point of the group.
        last: last point of the group, after `first`.
        variance: of a point across a wall, square metres.
        price: what one more piece must gain.
        scratch: `vertices`, `stack` and `table` are written.

    Returns:
        How many indices were written to `scratch.vertices`: first, the first point of every
        further piece, last.
    """
    table, starts = scratch.table, scratch.stack
    accumulate(xs, ys, first, last, table)
    count = last - first + 1
    table[0, LEAST_COST] = -price
    kept = 0
    for i in range(1, count + 1):
        starts[kept] = i - 1
        kept += 1
        best, argument = math.inf, 0
        for k in range(kept):
            j = starts[k]
            total = table[j, LEAST_COST] + scatter(table, j, i) / variance
            table[k, TRIAL_COST] = total
            if total < best:
                best, argument = total, j
        table[i, LEAST_COST], table[i, LAST_START] = best + price, argument
        left = 0
        for k in range(kept):
            if table[k, TRIAL_COST] <= best + price:
                starts[left] = starts[k]
                left += 1
        kept = left
    return trace(first, last, table, scratch.vertices)


@kernel
def accumulate(xs: FloatArray, ys: FloatArray, first: int, last: int, table: FloatArray) -> None:
    """Sums of x, y, xx, xy, yy of the points before each, about the first point."""
    table[0, SUM_X : SUM_YY + 1] = 0.0
    for i in range(first, last + 1):
        x, y = xs[i] - xs[first], ys[i] - ys[first]
        row = i - first
        table[row + 1, SUM_X] = table[row, SUM_X] + x
        table[row + 1, SUM_Y] = table[row, SUM_Y] + y
        table[row + 1, SUM_XX] = table[row, SUM_XX] + x * x
        table[row + 1, SUM_XY] = table[row, SUM_XY] + x * y
        table[row + 1, SUM_YY] = table[row, SUM_YY] + y * y


@kernel
def scatter(table: FloatArray, first: int, end: int) -> float:
    """Squared distances of points first to end (exclusive) from their least squares line."""
    count = end - first
    x, y = table[end, SUM_X] - table[first, SUM_X], table[end, SUM_Y] - table[first, SUM_Y]
    xx = table[end, SUM_XX] - table[first, SUM_XX] - x * x / count
    xy = table[end, SUM_XY] - table[first, SUM_XY] - x * y / count
    yy = table[end, SUM_YY] - table[first, SUM_YY] - y * y / count
    return float(max(0.5 * (xx + yy - math.sqrt((xx - yy) ** 2 + 4.0 * xy * xy)), 0.0))


@kernel
def trace(first: int, last: int, table: FloatArray, vertices: Any) -> int:
    """The cuts of the cheapest partition, in order."""
    cuts = 2
    i = int(table[last - first + 1, LAST_START])
    while i > 0:
        cuts += 1
        i = int(table[i, LAST_START])
    vertices[0], vertices[cuts - 1] = first, last
    i = int(table[last - first + 1, LAST_START])
    for k in range(cuts - 2, 0, -1):
        vertices[k] = first + i
        i = int(table[i, LAST_START])
    return cuts
