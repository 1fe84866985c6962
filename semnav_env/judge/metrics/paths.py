"""How well a path follows a route: the measures of vision-and-language navigation.

A path or a route is an array of points, shape (n, 2), metres, with at least one row.
"""

from __future__ import annotations

import numpy as np
from scipy.spatial.distance import cdist

from semnav_features.frames import FloatArray, path_length
from semnav_features.kernels.compiling import kernel

PUBLISHED_GOAL_RADIUS = 3.0
"""Distance at which the published measures call a place reached, metres (Anderson et al. 2018b in
docs/concepts/metrics.md)."""

PATH_SPACING = 0.25
"""Distance between the points of a path and a route that are compared, metres."""


def resampled(path: FloatArray, spacing: float = PATH_SPACING) -> FloatArray:
    """Points on a path at equal distances along it, at most `spacing` apart; both ends are kept.

    Standing still adds none. A path of no length is its first point.
    """
    steps = np.hypot(*np.diff(path, axis=0).T)
    along = np.concatenate(([0.0], np.cumsum(steps)))
    if along[-1] == 0.0:
        return path[:1].copy()
    moved = np.concatenate(([True], steps > 0.0))
    places = np.linspace(0.0, along[-1], 1 + int(np.ceil(along[-1] / spacing)))
    return np.stack([np.interp(places, along[moved], path[moved, i]) for i in (0, 1)], axis=1)


def spl(success: bool, path_length: float, route_length: float) -> float:
    """Success weighted by path length (Anderson et al. 2018), of one episode.

    S * l / max(p, l): l is the length of the shortest way (geodesic), p of the path (Euclidean).
    The source leaves l = 0 open; there, as for a turn on the spot, it is S.
    """
    if route_length == 0.0:
        return float(success)
    return float(success) * route_length / max(path_length, route_length)


def soft_spl(
    success: bool, remaining: float, initial: float, path_length: float, route_length: float
) -> float:
    """SPL with progress in the place of success (Datta et al. 2020).

    (1 - d_T / d_0) * l / max(p, l), no less than 0: d_T and d_0 are the distances to the goal at
    the end and at the start. Where d_0 is 0, as for a way there and back, progress is success.

    Args:
        success: whether the command was carried out.
        remaining: distance to the goal at the end, geodesic, metres.
        initial: the same at the start.
        path_length: Euclidean, metres.
        route_length: geodesic, metres.
    """
    progress = 1.0 - remaining / initial if initial > 0.0 else float(success)
    return max(0.0, progress) * spl(True, path_length, route_length)


def dtw(path: FloatArray, route: FloatArray) -> float:
    """Dynamic time warping: the least sum of distances over all monotone alignments, metres.

    D(i, j) = d(r_i, q_j) + min(D(i-1, j), D(i, j-1), D(i-1, j-1)), with Euclidean distances d
    (Berndt and Clifford 1994; Ilharco et al. 2019).
    """
    return float(_warp(np.ascontiguousarray(cdist(path, route), np.float64)))


def ndtw(path: FloatArray, route: FloatArray, threshold: float = PUBLISHED_GOAL_RADIUS) -> float:
    """Normalised dynamic time warping (Ilharco et al. 2019), in [0, 1].

    exp(-DTW(R, Q) / (|R| * d_th)): R is the route with |R| points and Q the path. 1 if and only if
    both are the same points in the same order, repetitions apart.
    """
    return float(np.exp(-dtw(path, route) / (len(route) * threshold)))


def sdtw(
    success: bool, path: FloatArray, route: FloatArray, threshold: float = PUBLISHED_GOAL_RADIUS
) -> float:
    """Success weighted by normalised dynamic time warping (Ilharco et al. 2019): S * nDTW."""
    return float(success) * ndtw(path, route, threshold)


def cls(path: FloatArray, route: FloatArray, threshold: float = PUBLISHED_GOAL_RADIUS) -> float:
    """Coverage weighted by length score (Jain et al. 2019), in [0, 1].

    PC * LS with the coverage PC, the mean over the route's points of exp(-d(r, P) / d_th), and the
    length score LS = EPL / (EPL + |EPL - PL(P)|), where EPL = PC * PL(R) is the length expected and
    PL(P) that of the path. d is the Euclidean distance to the nearest point of the path. Where
    neither has a length, LS is 1.
    """
    coverage = float(np.exp(-cdist(route, path).min(axis=1) / threshold).mean())
    expected = coverage * path_length(route)
    longer = abs(expected - path_length(path))
    score = expected / (expected + longer) if expected + longer > 0.0 else 1.0
    return coverage * score


@kernel
def _warp(distances: FloatArray) -> float:
    """The cost of the cheapest monotone way through a matrix from its first cell to its last."""
    rows, columns = distances.shape
    cost = np.empty(columns)
    cost[0] = distances[0, 0]
    for j in range(1, columns):
        cost[j] = cost[j - 1] + distances[0, j]
    for i in range(1, rows):
        diagonal = cost[0]
        cost[0] += distances[i, 0]
        for j in range(1, columns):
            above = cost[j]
            cost[j] = distances[i, j] + min(above, cost[j - 1], diagonal)
            diagonal = above
    return float(cost[columns - 1])
