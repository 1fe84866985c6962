"""Statistical outlier removal (Rusu and Cousins 2011; Mes 2021, 3.2 and 6.3.2)."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from semnav_features.frames import FloatArray


def remove_outliers(points: FloatArray, neighbours: int = 100, alpha: float = 0.1) -> FloatArray:
    """The points whose distance to their neighbours is not unusually large.

    A point goes if its mean distance d to its nearest neighbours exceeds
    T = mean(d) + alpha std(d) over all points (Mes 2021, 3.2).

    Args:
        points: metres, shape (n, 3).
        neighbours: number of neighbours; all others in a smaller cloud. 100 in Mes 2021, 6.3.2.
        alpha: multiplies the standard deviation; 0.1 in Mes 2021, 6.3.2.

    Raises:
        ValueError: no neighbour asked for.
    """
    if neighbours < 1:
        raise ValueError(f"neighbours is {neighbours}; it must be at least 1")
    count = min(neighbours, len(points) - 1)
    if count < 1:
        return points
    nearest, _ = cKDTree(points).query(points, k=count + 1)
    distances = nearest[:, 1:].mean(axis=1)  # the nearest of all is the point itself
    usual = np.asarray(distances <= distances.mean() + alpha * distances.std(), dtype=bool)
    return np.asarray(points[usual])
