"""Straight pieces of a group of points: the most likely partition, by dynamic programming."""

from __future__ import annotations

import math
from typing import Any

from numba import njit

from semnav_env.features.frames import FloatArray

PIECE_PRICE = 20.0
"""What one more piece must gain, in minus twice the log likelihood: by the Bayesian information
criterion three parameters (a line and a cut) times the logarithm of 800 beams."""

COST, BEFORE, TOTAL = 5, 6, 7
"""Columns of the table after the five moments."""


@njit(cache=True, error_model="numpy")
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
    table[0, COST] = -price
    kept = 0
    for i in range(1, count + 1):
        starts[kept] = i - 1
        kept += 1
        best, argument = math.inf, 0
        for k in range(kept):
            j = starts[k]
            total = table[j, COST] + scatter(table, j, i) / variance
            table[k, TOTAL] = total
            if total < best:
                best, argument = total, j
        table[i, COST], table[i, BEFORE] = best + price, argument
        left = 0
        for k in range(kept):
            if table[k, TOTAL] <= best + price:
                starts[left] = starts[k]
                left += 1
        kept = left
    return trace(first, last, table, scratch.vertices)


@njit(cache=True, error_model="numpy")
def accumulate(xs: FloatArray, ys: FloatArray, first: int, last: int, table: FloatArray) -> None:
    """Sums of x, y, xx, xy, yy of the points before each, about the first point."""
    table[0, :5] = 0.0
    for i in range(first, last + 1):
        x, y = xs[i] - xs[first], ys[i] - ys[first]
        row = i - first
        table[row + 1, 0] = table[row, 0] + x
        table[row + 1, 1] = table[row, 1] + y
        table[row + 1, 2] = table[row, 2] + x * x
        table[row + 1, 3] = table[row, 3] + x * y
        table[row + 1, 4] = table[row, 4] + y * y


@njit(cache=True, error_model="numpy")
def scatter(table: FloatArray, first: int, end: int) -> float:
    """Squared distances of points first to end (exclusive) from their least squares line."""
    count = end - first
    x, y = table[end, 0] - table[first, 0], table[end, 1] - table[first, 1]
    xx = table[end, 2] - table[first, 2] - x * x / count
    xy = table[end, 3] - table[first, 3] - x * y / count
    yy = table[end, 4] - table[first, 4] - y * y / count
    return float(max(0.5 * (xx + yy - math.sqrt((xx - yy) ** 2 + 4.0 * xy * xy)), 0.0))


@njit(cache=True, error_model="numpy")
def trace(first: int, last: int, table: FloatArray, vertices: Any) -> int:
    """The cuts of the cheapest partition, in order."""
    cuts = 2
    i = int(table[last - first + 1, BEFORE])
    while i > 0:
        cuts += 1
        i = int(table[i, BEFORE])
    vertices[0], vertices[cuts - 1] = first, last
    i = int(table[last - first + 1, BEFORE])
    for k in range(cuts - 2, 0, -1):
        vertices[k] = first + i
        i = int(table[i, BEFORE])
    return cuts
