"""Euclidean clustering (Rusu and Cousins 2011; Mes 2021, 6.3.5)."""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from semnav_features.frames import FloatArray


def euclidean_clusters(
    points: FloatArray, tolerance: float = 0.10, smallest: int = 5, largest: int = 100
) -> list[FloatArray]:
    """Groups of points that are connected by steps of at most a tolerance.

    Mes 2021 searches with an octree; the k-d tree of SciPy finds the same neighbours.

    Args:
        points: metres, shape (n, 3).
        tolerance: longest step, metres; 0.10 in Mes 2021, 6.3.5.
        smallest: least number of points of a cluster; 5 there.
        largest: largest number; 100 there. Larger clusters are left out, not cut.
    """
    if len(points) == 0:
        return []
    pairs = cKDTree(points).query_pairs(tolerance, output_type="ndarray")
    links = coo_matrix((np.ones(len(pairs)), pairs.T), shape=(len(points),) * 2)
    count, labels = connected_components(links, directed=False)
    sizes = np.bincount(labels, minlength=count)
    chosen = np.flatnonzero((sizes >= smallest) & (sizes <= largest))
    return [points[labels == label] for label in chosen]
