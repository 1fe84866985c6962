"""The plane with the most points, by RANSAC (Fischler and Bolles 1981; Mes 2021, 3.3, 6.3.3)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from semnav_features.frames import FloatArray

TRIALS = 100
"""Planes that are tried: one of them has three inliers with a probability of 0.99 where at least a
third of the points lies on the plane."""

_LEAST_AREA = 1e-6
"""Twice the area of three points that count as lying on one line, square metres."""


def plane_inliers(
    points: FloatArray, rng: np.random.Generator, distance: float = 0.10, trials: int = TRIALS
) -> NDArray[np.bool_]:
    """Mask of the points on the plane with the most points, shape (n,).

    Args:
        points: metres, shape (n, 3).
        rng: draws the triples.
        distance: largest distance of an inlier, metres; 0.10 in Mes 2021, 6.3.3.
        trials: how many triples are drawn.

    Returns:
        No point at all where there is no plane: fewer than three points, or all on one line.
    """
    if len(points) < 3:
        return np.zeros(len(points), dtype=bool)
    a, b, c = points[rng.integers(len(points), size=(3, trials))]
    normals = np.cross(b - a, c - a)
    areas = np.linalg.norm(normals, axis=1)
    real = areas > _LEAST_AREA
    normals = normals[real] / areas[real, None]
    if len(normals) == 0:
        return np.zeros(len(points), dtype=bool)
    offsets = np.einsum("ij,ij->i", normals, a[real])
    best = max(
        zip(normals, offsets, strict=True), key=lambda plane: _near(points, plane, distance).sum()
    )
    return _near(points, best, distance)


def _near(
    points: FloatArray, plane: tuple[FloatArray, np.float64], distance: float
) -> NDArray[np.bool_]:
    normal, offset = plane
    return np.asarray(np.abs(points @ normal - offset) <= distance)
