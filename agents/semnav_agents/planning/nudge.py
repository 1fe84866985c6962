"""Small corrections of a path that odometry drift has brought too close to obstacles."""

from __future__ import annotations

import math

import numpy as np

from semnav_features.frames import FloatArray
from semnav_features.kernels.compiling import kernel

NUDGE_SHIFT, NUDGE_ANGLE, NUDGES_PER_SIDE = 0.005, 0.006, 4
"""The finest correction, metres and radians, and how many of them are tried to each side."""

NUDGE_PRICE = 0.1
"""Clearance that a correction must gain for each metre (or radian) by which it moves the path."""

RELEVANT_DISTANCE = 0.15
"""Distance from the footprints along the path beyond which points do not matter, metres."""


@kernel
def best_nudge(
    points: FloatArray, poses: FloatArray, length: float, width: float, wanted: float
) -> tuple[float, float, float]:
    """The shift to the left and the turn about the robot that give a path the most clearance.

    Args:
        points: obstacles in the robot frame, metres, shape (N, 2).
        poses: the centre's poses ahead, in the robot frame, shape (M, 3).
        length: of the footprint, metres.
        width: of the footprint, metres.
        wanted: clearance beyond which more is worth nothing, metres.

    Returns:
        left in metres, turn in radians, and the clearance with them (negative: overlap).
    """
    near = _near_points(points, poses, length, width)
    best = (0.0, 0.0, path_clearance(near, poses, length, width, 0.0, 0.0, -math.inf))
    score = min(best[2], wanted)
    for a in range(-NUDGES_PER_SIDE, NUDGES_PER_SIDE + 1):
        for b in range(-NUDGES_PER_SIDE, NUDGES_PER_SIDE + 1):
            left, turn = a * NUDGE_SHIFT, b * NUDGE_ANGLE
            price = NUDGE_PRICE * (abs(left) + abs(turn))
            clearance = path_clearance(near, poses, length, width, left, turn, score + price)
            if min(clearance, wanted) - price > score + 1e-4:
                best, score = (left, turn, clearance), min(clearance, wanted) - price
    return best


@kernel
def path_clearance(
    points: FloatArray,
    poses: FloatArray,
    length: float,
    width: float,
    left: float,
    turn: float,
    enough: float,
) -> float:
    """Least distance by which points lie outside the footprints of the moved path, metres.

    A distance is the larger of its parts along and across the body. The search stops early at any
    distance below `enough`.
    """
    least = math.inf
    c, s = math.cos(turn), math.sin(turn)
    for m in range(len(poses)):
        ch, sh = math.cos(poses[m, 2]), math.sin(poses[m, 2])
        for k in range(len(points)):
            px, py = points[k, 0], points[k, 1] - left
            dx, dy = c * px + s * py - poses[m, 0], c * py - s * px - poses[m, 1]
            ahead, aside = abs(ch * dx + sh * dy), abs(ch * dy - sh * dx)
            least = min(least, float(max(ahead - length / 2, aside - width / 2)))
            if least < enough:
                return least
    return least


@kernel
def path_clearances(
    points: FloatArray, poses: FloatArray, length: float, width: float, most: float
) -> FloatArray:
    """Clearance at each of the poses, (M, 3), as `path_clearance` and at most `most`, (M,)."""
    clearance = np.empty(len(poses))
    for m in range(len(poses)):
        least = path_clearance(points, poses[m : m + 1], length, width, 0.0, 0.0, -math.inf)
        clearance[m] = min(least, most)
    return clearance


@kernel
def _near_points(points: FloatArray, poses: FloatArray, length: float, width: float) -> FloatArray:
    kept = np.empty_like(points)
    n = 0
    for k in range(len(points)):
        if (
            path_clearance(points[k : k + 1], poses, length, width, 0.0, 0.0, RELEVANT_DISTANCE)
            < RELEVANT_DISTANCE
        ):
            kept[n] = points[k]
            n += 1
    return kept[:n]
