"""Whether the beams of a scan pass through what is remembered as a wall."""

from __future__ import annotations

import math
from typing import Any

from numba import njit

from semnav_env.features.frames import FloatArray

LOOKS, LEAST = 6, 4
"""So many places along a wall are looked at, and so many of them must be in the scan."""
SHARE, STRETCH = 0.6, 1.5
"""They lie in the stretch in good view, which is so much of the wall, or so long, metres: longer
than a doorway."""
REACH = 6.0
"""A place farther off is not in good view, metres."""
FLATTEST = math.sin(math.radians(20.0))
"""Nor is one that its beam meets at a smaller sine."""
BEHIND = 0.4
"""A beam passes through a wall if it ends this far behind it, metres: odometry drifts."""


@njit(cache=True, error_model="numpy")
def is_seen_through(
    ranges: FloatArray,
    angle_min: float,
    angle_increment: float,
    pose: tuple[float, float, float],
    wall: Any,
) -> bool:
    """Whether three in four of the places in good view are passed by their beams.

    Args:
        ranges: of the scan, metres, shape (n,); a beam without a return does not tell.
        angle_min: of the scan, radians.
        angle_increment: of the scan, radians.
        pose: of the lidar in the wall's frame.
        wall: with its ends.
    """
    dx, dy = wall.end_x - wall.start_x, wall.end_y - wall.start_y
    x, y = wall.start_x - pose[0], wall.start_y - pose[1]
    length = math.sqrt(dx * dx + dy * dy)
    across = abs(x * dy - y * dx) / length
    reach = min(REACH, across / FLATTEST)
    if reach <= across:
        return False
    foot, half = -(x * dx + y * dy) / length, math.sqrt(reach * reach - across * across)
    first, last = max(foot - half, 0.0), min(foot + half, length)
    if last - first < min(SHARE * length, STRETCH):
        return False
    in_view = passed = 0
    for k in range(LOOKS):
        share = (first + (k + 0.5) / LOOKS * (last - first)) / length
        px, py = x + share * dx, y + share * dy
        distance = math.sqrt(px * px + py * py)
        turn = math.atan2(py, px) - pose[2] - angle_min
        turn -= 2.0 * math.pi * math.floor(turn / (2.0 * math.pi))
        beam = int(turn / angle_increment + 0.5)
        if beam < len(ranges) and ranges[beam] < math.inf:
            in_view += 1
            passed += ranges[beam] > distance + BEHIND
    return bool(in_view >= LEAST and 4 * passed >= 3 * in_view)
