"""The upright line with the most points, by RANSAC, and the pair of them that makes a door."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from semnav_features.frames import FloatArray, Point

TRIALS = 50
"""Pairs of points that are tried for a line."""

_LEAST_LENGTH = 1e-6
"""Distance below which two points give no direction, metres."""


@dataclass(frozen=True)
class UprightLine:
    """A line fitted to a cluster.

    Attributes:
        point: (x, y) of its inliers' mean, metres, robot frame.
        low: least height of its inliers, metres.
        high: largest height.
        support: how many inliers.
    """

    point: Point
    low: float
    high: float
    support: int


def upright_line(
    points: FloatArray,
    rng: np.random.Generator,
    angle: float = 0.2,
    distance: float = 0.05,
    trials: int = TRIALS,
) -> UprightLine | None:
    """The line parallel to the z axis that has the most points (Mes 2021, 6.3.6).

    Args:
        points: of a cluster, metres, shape (n, 3).
        rng: draws the pairs of points.
        angle: largest angle to the z axis, radians; 0.2 there (`epsAngle`).
        distance: largest distance of an inlier, metres; not given there: the side of a voxel.
        trials: how many pairs are drawn.

    Returns:
        None where no pair of points stands upright.
    """
    if len(points) < 2:
        return None
    a, b = points[rng.integers(len(points), size=(2, trials))]
    lengths = np.linalg.norm(b - a, axis=1)
    upright = (lengths > _LEAST_LENGTH) & (np.abs(b - a)[:, 2] >= math.cos(angle) * lengths)
    if not upright.any():
        return None
    starts, directions = a[upright], (b - a)[upright] / lengths[upright, None]
    offsets = points[None] - starts[:, None]
    along = np.einsum("ijk,ik->ij", offsets, directions)
    away = np.linalg.norm(offsets - along[..., None] * directions[:, None], axis=2)
    near = away <= distance
    inliers = points[near[near.sum(axis=1).argmax()]]
    x, y, _ = inliers.mean(axis=0).tolist()
    heights = inliers[:, 2]
    return UprightLine((x, y), float(heights.min()), float(heights.max()), len(inliers))


def pair_apart(
    lines: Sequence[UprightLine], width: float = 0.90, tolerance: float = 0.15
) -> tuple[UprightLine, UprightLine] | None:
    """The two lines whose distance is nearest to the width of a door.

    Args:
        lines: one for each cluster.
        width: between the jambs, metres; "approximately 90 centimeters" in Mes 2021, 6.3.6.
        tolerance: what "approximately" means, metres; not given there.
    """

    def misfit(pair: tuple[UprightLine, UprightLine]) -> float:
        return abs(math.dist(pair[0].point, pair[1].point) - width)

    best = min(combinations(lines, 2), key=misfit, default=None)
    return best if best is not None and misfit(best) <= tolerance else None
