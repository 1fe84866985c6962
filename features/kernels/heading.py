"""Finds the direction along which most of the wall around a place runs."""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from semnav_env.features.frames import FloatArray

RAY_COUNT = 72
"""Number of rays around the place, one every 5 degrees."""

BIN_COUNT = 45
"""Bins of the histogram of directions: of 2 degrees, over the 90 degrees around the heading."""

MAX_SPREAD = math.radians(5.0)
"""Walls within this angle of the most common direction share in the mean, radians."""


@njit(cache=True)
def prevailing_heading(solid: FloatArray, walls: int, x: float, y: float, heading: float) -> float:
    """The direction, within 45 degrees of `heading`, that most of the wall in view runs along.

    Args:
        solid: what hides what, shape (n, 4), metres; walls first.
        walls: how many of them are walls, whose direction counts.
        x: where to look from, metres.
        y: the same.
        heading: radians.

    Returns:
        Radians; `heading` itself where no wall in view runs along it.
    """
    angles = np.full(RAY_COUNT, np.inf)
    length = np.zeros(RAY_COUNT)
    for k in range(RAY_COUNT):
        angle = heading + (k + 0.5) * (2.0 * math.pi / RAY_COUNT)
        hit, distance = _first_hit(solid, x, y, math.cos(angle), math.sin(angle))
        if 0 <= hit < walls:
            along = math.atan2(solid[hit, 3] - solid[hit, 1], solid[hit, 2] - solid[hit, 0])
            angles[k] = _fold(along - heading)
            length[k] = distance / max(abs(math.sin(along - angle)), 0.1)
    centre = _commonest(angles, length)
    total, mean = 0.0, 0.0
    for k in range(RAY_COUNT):
        if abs(angles[k] - centre) < MAX_SPREAD:
            total += length[k]
            mean += length[k] * angles[k]
    return heading + mean / total if total > 0.0 else heading


@njit(cache=True)
def _first_hit(solid: FloatArray, x: float, y: float, c: float, s: float) -> tuple[int, float]:
    """Which segment the ray from (x, y) in direction (c, s) meets first (-1: none), and where."""
    nearest, hit = np.inf, -1
    for i in range(len(solid)):
        ax, ay = solid[i, 0] - x, solid[i, 1] - y
        bx, by = solid[i, 2] - x, solid[i, 3] - y
        left_a, left_b = c * ay - s * ax, c * by - s * bx
        if (left_a > 0.0) == (left_b > 0.0):
            continue
        share = left_a / (left_a - left_b)
        distance = c * (ax + share * (bx - ax)) + s * (ay + share * (by - ay))
        if 0.0 < distance < nearest:
            nearest, hit = distance, i
    return hit, nearest


@njit(cache=True)
def _fold(angles: float) -> float:
    """The direction of a line (which has no sense of direction) in [-pi/2, pi/2), radians."""
    return angles - math.pi * math.floor(angles / math.pi + 0.5)


@njit(cache=True)
def _commonest(angles: FloatArray, length: FloatArray) -> float:
    """The middle of the three neighbouring bins that hold most length, radians; inf without any.

    The array of bins has an empty one at each end, so that every bin has two neighbours.
    """
    bins = np.zeros(BIN_COUNT + 2)
    for k in range(len(angles)):
        if abs(angles[k]) < math.pi / 4:
            bins[1 + int((angles[k] / (math.pi / 2) + 0.5) * BIN_COUNT)] += length[k]
    best, most = -1, 0.0
    for k in range(BIN_COUNT):
        near = bins[k] + bins[k + 1] + bins[k + 2]
        if near > most:
            best, most = k, near
    return ((best + 0.5) / BIN_COUNT - 0.5) * (math.pi / 2) if best >= 0 else np.inf
