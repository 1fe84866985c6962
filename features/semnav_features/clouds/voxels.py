"""Downsampling to a voxel grid (Mes 2021, 3.4 and 6.3.4)."""

from __future__ import annotations

import numpy as np

from semnav_features.frames import FloatArray


def voxel_grid(points: FloatArray, leaf: float = 0.05) -> FloatArray:
    """The centroid of the points in each occupied voxel, shape (m, 3).

    Args:
        points: metres, shape (n, 3).
        leaf: side of a voxel, metres; 0.05 in Mes 2021, 6.3.4.

    Raises:
        ValueError: a leaf that is not positive.
    """
    if not leaf > 0.0:
        raise ValueError(f"leaf is {leaf} m; it must be positive")
    if len(points) == 0:
        return points
    cells = np.floor((points - points.min(axis=0)) / leaf)
    order = np.lexsort(cells.T)
    ordered = cells[order]
    first = np.flatnonzero(np.r_[True, (ordered[1:] != ordered[:-1]).any(axis=1)])
    counts = np.diff(np.r_[first, len(points)])
    return np.asarray(np.add.reduceat(points[order], first) / counts[:, None])
