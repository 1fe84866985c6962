"""The most likely partition of a group in plain NumPy; see `kernels.optimal_partition`."""

from __future__ import annotations

import numpy as np

from semnav_features.frames import FloatArray


def best_cuts(points: FloatArray, variance: float, price: float) -> list[int]:
    """The first point of every piece but the first, where the whole costs least.

    F(i) = min over j < i of F(j) + C(j, i) + price, with C the squared distances from the total
    least squares line, in variances.
    """
    x, y = (points - points[0]).T
    sums = np.cumsum(np.stack((np.ones_like(x), x, y, x * x, x * y, y * y)), axis=1)
    sums = np.concatenate((np.zeros((6, 1)), sums), axis=1)
    cost, before = np.full(len(points) + 1, -price), np.zeros(len(points) + 1, np.int64)
    for i in range(1, len(points) + 1):
        count, x, y, xx, xy, yy = sums[:, i : i + 1] - sums[:, :i]
        xx, xy, yy = xx - x * x / count, xy - x * y / count, yy - y * y / count
        scatter = np.maximum((xx + yy - np.sqrt((xx - yy) ** 2 + 4 * xy * xy)) / 2, 0.0)
        total = cost[:i] + scatter / variance
        before[i] = np.argmin(total)
        cost[i] = total[before[i]] + price
    cuts: list[int] = []
    start = int(before[-1])
    while start > 0:
        cuts.insert(0, start)
        start = int(before[start])
    return cuts
