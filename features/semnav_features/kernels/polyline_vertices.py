"""Chooses the points of a scan that make the best polylines, by dynamic programming.

The objective is the likelihood of Schaefer et al. (IROS 2018, section III): the squared
differences between measured and predicted ranges, along the beams, and a constant for every beam
that no line explains. They remove the vertex that costs least, again and again; here the best
choice of end points is found exactly.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from semnav_features.frames import FloatArray
from semnav_features.kernels.compiling import kernel


@kernel
def chord_cost(
    directions: FloatArray, ranges: FloatArray, first: int, last: int, limit: float
) -> float:
    """Squared range residuals of the points between two points, against their chord.

    A beam of direction d meets the line through a and b at the range a x b / d x (b - a).

    Returns:
        Square metres; infinity above the limit, or where a beam does not meet the chord.
    """
    start_x, start_y = ranges[first] * directions[first, 0], ranges[first] * directions[first, 1]
    end_x, end_y = ranges[last] * directions[last, 0], ranges[last] * directions[last, 1]
    along_x, along_y = end_x - start_x, end_y - start_y
    area = start_x * end_y - start_y * end_x
    if not area > 0.0:
        return math.inf
    total = 0.0
    for i in range(first + 1, last):
        slope = directions[i, 0] * along_y - directions[i, 1] * along_x
        if not slope > 0.0:
            return math.inf
        residual = area / slope - ranges[i]
        total += residual * residual
        if total > limit:
            return math.inf
    return total


@kernel
def choose_vertices(
    directions: FloatArray,
    ranges: FloatArray,
    group_first: NDArray[np.int64],
    vertices: int,
    missed: float,
) -> tuple[NDArray[np.int64], NDArray[np.bool_]]:
    """The points that make the best polylines of at most a given number of vertices.

    D(v, i) is the least cost of the points before i with v vertices, L(v, i) that of the points
    up to i where i is at least the second vertex of a polyline:

        L(v, i) = min over j < i of min( D(v - 2, j), L(v - 1, j) ) + chord_cost(j, i)
        D(v, i + 1) = min( D(v, i) + missed^2, L(v, i) )

    Args:
        directions: cosine and sine of the beam of every point, shape (n, 2), counter-clockwise.
        ranges: metres, shape (n,), positive.
        group_first: where connected groups begin, and n at the end, shape (groups + 1,); no
            line joins two groups.
        vertices: of all polylines together, at least 2.
        missed: the residual that counts for a point on no line, metres.

    Returns:
        The chosen points in beam order, and which of them start a polyline.
    """
    points, penalty = len(ranges), missed * missed
    done = np.full((vertices + 1, points + 1), math.inf)
    done[:, 0] = 0.0
    linked = np.full((vertices + 1, points), math.inf)
    before = np.zeros((vertices + 1, points), np.int64)
    for group in range(len(group_first) - 1):
        for i in range(group_first[group], group_first[group + 1]):
            for j in range(group_first[group], i):
                cost = chord_cost(directions, ranges, j, i, penalty * (i - j))
                if cost < math.inf:
                    link(cost, j, i, done, linked, before)
            for v in range(vertices + 1):
                done[v, i + 1] = min(done[v, i] + penalty, linked[v, i])
    return trace(done, linked, before)


@kernel
def link(
    cost: float,
    first: int,
    last: int,
    done: FloatArray,
    linked: FloatArray,
    before: NDArray[np.int64],
) -> None:
    """Try the line between two points as the last one, for every number of vertices."""
    for v in range(2, len(linked)):
        total = min(done[v - 2, first], linked[v - 1, first]) + cost
        if total < linked[v, last]:
            linked[v, last] = total
            before[v, last] = first


@kernel
def trace(
    done: FloatArray, linked: FloatArray, before: NDArray[np.int64]
) -> tuple[NDArray[np.int64], NDArray[np.bool_]]:
    """The choices that led to the least cost, in beam order."""
    end = done.shape[1] - 1
    left = int(np.argmin(done[:, end]))
    chosen, starts = np.zeros(left, np.int64), np.zeros(left, np.bool_)
    while end > 0:
        end -= 1
        if done[left, end + 1] < linked[left, end]:
            continue
        left -= 1
        chosen[left] = end
        while not starts[left]:
            end = before[left + 1, end]
            starts[left - 1] = done[left - 1, end] <= linked[left, end]
            left -= 1
            chosen[left] = end
    return chosen[left:], starts[left:]
