"""Numba kernel that takes drift out of odometry: walls that are seen again lie where they lay.

Mes 2021 corrects the drift of SPOT's odometry by known walls; here they are the remembered ones.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numba import njit

from semnav_env.features.frames import FloatArray, Pose

KNOWN_HITS = 5
"""A remembered wall tells where the robot is once it was seen so often."""

OVERLAP, MOST_OVERLAP = 0.4, 3.0
"""Two walls are compared where both are, along at least so much; more than the second counts as that
much, metres."""

BESIDE = 0.3
"""Walls farther than this beside each other are two walls, metres."""

SLANT = math.cos(math.radians(10.0))
"""Cosine of the angle from which on they are two as well."""

ROUGH = 0.05
"""Standard deviation of the distance between two sightings of a metre of wall, metres."""

OUTLIER = 0.1
"""What lies farther off than this counts less, metres."""

SHIFT, TURN = 0.01, 0.004
"""Standard deviations of the drift from one scan to the next, metres and radians."""


@njit(cache=True, error_model="numpy")
def without_drift(walls: FloatArray, known: Any, pose: Pose) -> Pose:
    """The pose at which the walls of a scan lie best on the remembered ones.

    It minimises sum w_i d_i^2 + (dx^2 + dy^2) / SHIFT^2 + dtheta^2 / TURN^2 in one Gauss-Newton step:
    d_i are the distances of the ends of each shared stretch from the remembered line, and w_i grows
    with its length. What the walls do not tell, such as the place along a bare corridor, stays.

    Args:
        walls: ends x1, y1, x2, y2 of the scan's walls as the pose places them, metres, shape (n, 4).
        known: `REMEMBERED_WALL`, in the same frame.
        pose: of the lidar by odometry, in the same frame.

    Returns:
        The corrected pose.
    """
    normal = np.zeros((3, 3))
    normal[0, 0] = normal[1, 1] = 1.0 / SHIFT**2
    normal[2, 2] = 1.0 / TURN**2
    pull = np.zeros(3)
    for i in range(len(walls)):
        _compare(walls[i], known, pose, normal, pull)
    if not pull.any():
        return pose
    dx, dy, turn = np.linalg.solve(normal, pull)
    return pose[0] + dx, pose[1] + dy, pose[2] + turn


@njit(cache=True, error_model="numpy")
def _compare(
    wall: FloatArray, known: Any, pose: Pose, normal: FloatArray, pull: FloatArray
) -> None:
    """Add what a wall, shape (4,), tells beside the nearest remembered one that is like it."""
    x1, y1, x2, y2 = wall
    ux, uy = x2 - x1, y2 - y1
    length = math.hypot(ux, uy)
    nearest, best, begin, end = BESIDE, -1, 0.0, 0.0
    for k in range(len(known)):
        old = known[k]
        dx, dy = old.end_x - old.start_x, old.end_y - old.start_y
        if old.hits < KNOWN_HITS or ux * dx + uy * dy < 0.0:
            continue
        reach = math.hypot(dx, dy)
        if ux * dx + uy * dy < SLANT * length * reach:
            continue
        first = ((x1 - old.start_x) * dx + (y1 - old.start_y) * dy) / reach
        last = ((x2 - old.start_x) * dx + (y2 - old.start_y) * dy) / reach
        low, high = max(first, 0.0), min(last, reach)
        if high - low < OVERLAP:
            continue
        low, high = (low - first) / (last - first), (high - first) / (last - first)
        middle = 0.5 * (low + high)
        x, y = x1 + middle * ux - old.start_x, y1 + middle * uy - old.start_y
        beside = abs(y * dx - x * dy) / reach
        if beside < nearest:
            nearest, best, begin, end = beside, k, low, high
    if best < 0:
        return
    old = known[best]
    dx, dy = old.end_x - old.start_x, old.end_y - old.start_y
    reach = math.hypot(dx, dy)
    nx, ny = -dy / reach, dx / reach
    weight = 0.5 * min((end - begin) * length, MOST_OVERLAP) / ROUGH**2
    for share in (begin, end):
        x, y = x1 + share * ux, y1 + share * uy
        off = nx * (x - old.start_x) + ny * (y - old.start_y)
        lever = ny * (x - pose[0]) - nx * (y - pose[1])
        counts = weight / (1.0 + (off / OUTLIER) ** 2)
        row = (nx, ny, lever)
        for i in range(3):
            pull[i] -= counts * row[i] * off
            for j in range(3):
                normal[i, j] += counts * row[i] * row[j]
