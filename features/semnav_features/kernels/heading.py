"""Finds the direction along which most of the wall around a place runs."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from semnav_features.frames import FloatArray
from semnav_features.kernels.compiling import kernel

RAY_COUNT = 72
"""Number of rays around the place, one every 5 degrees."""

RAY_STEP = 2.0 * math.pi / RAY_COUNT
"""Angle between two rays, radians."""

ROUGHNESS = 0.1
"""Largest error of a direction by which rays are chosen, in steps of rays."""

BIN_COUNT = 45
"""Bins of the histogram of directions: of 2 degrees, over the 90 degrees around the heading."""

MAX_SPREAD = math.radians(5.0)
"""Walls within this angle of the most common direction share in the mean, radians."""


@kernel
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
    hits, distances = _first_hits(solid, x, y, heading)
    before, along = -1, 0.0  # neighbouring rays mostly meet the same wall
    for k in range(RAY_COUNT):
        hit = hits[k]
        if 0 <= hit < walls:
            if hit != before:
                along = math.atan2(solid[hit, 3] - solid[hit, 1], solid[hit, 2] - solid[hit, 0])
                before = hit
            angle = heading + (k + 0.5) * RAY_STEP
            angles[k] = _fold(along - heading)
            length[k] = distances[k] / max(abs(math.sin(along - angle)), 0.1)
    centre = _commonest(angles, length)
    total, mean = 0.0, 0.0
    for k in range(RAY_COUNT):
        if abs(angles[k] - centre) < MAX_SPREAD:
            total += length[k]
            mean += length[k] * angles[k]
    return heading + mean / total if total > 0.0 else heading


@kernel
def _first_hits(
    solid: FloatArray, x: float, y: float, heading: float
) -> tuple[NDArray[np.int64], FloatArray]:
    """Which segment each ray from (x, y) meets first (-1: none), and how far off.

    Each segment is tried with the rays between the directions of its ends, and with one ray more
    at either side where that is close.
    """
    cosines, sines = np.empty(RAY_COUNT), np.empty(RAY_COUNT)
    for k in range(RAY_COUNT):
        angle = heading + (k + 0.5) * RAY_STEP
        cosines[k], sines[k] = math.cos(angle), math.sin(angle)
    hits, nearest = np.full(RAY_COUNT, -1), np.full(RAY_COUNT, np.inf)
    directions = np.empty((2, len(solid)))
    for i in range(len(solid)):
        directions[0, i] = rough_angle(solid[i, 0] - x, solid[i, 1] - y)
        directions[1, i] = rough_angle(solid[i, 2] - x, solid[i, 3] - y)
    for i in range(len(solid)):
        first, count = _rays_between(directions[0, i], directions[1, i], heading)
        if count <= 0:
            continue
        ax, ay = solid[i, 0] - x, solid[i, 1] - y
        bx, by = solid[i, 2] - x, solid[i, 3] - y
        for ray in range(first, first + count):
            k = ray % RAY_COUNT
            c, s = cosines[k], sines[k]
            left_a, left_b = c * ay - s * ax, c * by - s * bx
            if (left_a > 0.0) == (left_b > 0.0):
                continue
            share = left_a / (left_a - left_b)
            distance = c * (ax + share * (bx - ax)) + s * (ay + share * (by - ay))
            if 0.0 < distance < nearest[k]:
                nearest[k], hits[k] = distance, i
    return hits, nearest


@kernel
def _rays_between(a: float, b: float, heading: float) -> tuple[int, int]:
    """The first ray between two directions that are less than half a turn apart, and how many.

    All rays if that is nearly half a turn: then rounding says on which side the segment lies.
    """
    spread = b - a
    if abs(spread) > math.pi:  # across the direction of -x
        spread -= math.copysign(2.0 * math.pi, spread)
    if abs(spread) > math.pi - RAY_STEP:
        return 0, RAY_COUNT
    begin = (min(a, a + spread) - heading) * (1.0 / RAY_STEP) - 0.5
    first = math.ceil(begin - ROUGHNESS)
    return first, math.floor(begin + abs(spread) * (1.0 / RAY_STEP) + ROUGHNESS) - first + 1


@kernel
def rough_angle(x: float, y: float) -> float:
    """The direction of a vector to 0.0003 rad, in a tenth of the time of `math.atan2`.

    The polynomial is that of Abramowitz and Stegun 4.4.47, shortened.
    """
    low, high = min(abs(x), abs(y)), max(abs(x), abs(y))
    ratio = low / high if high > 0.0 else 0.0
    square = ratio * ratio
    angle = ratio * (1.0 + square * (-0.327622764 + square * (0.15931422 - 0.0464964749 * square)))
    angle = 0.5 * math.pi - angle if abs(y) > abs(x) else angle
    angle = math.pi - angle if x < 0.0 else angle
    return -angle if y < 0.0 else angle


@kernel
def _fold(angles: float) -> float:
    """The direction of a line (which has no sense of direction) in [-pi/2, pi/2), radians."""
    return angles - math.pi * math.floor(angles / math.pi + 0.5)


@kernel
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
