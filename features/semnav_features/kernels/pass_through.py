"""Tells whether the beams of a scan pass through what is remembered as a wall."""

from __future__ import annotations

import math

from semnav_features.frames import FloatArray
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.remembered import Ends

SAMPLES, MIN_SAMPLES_IN_VIEW = 6, 4
"""Places along a wall at which beams are looked at, and how many of them must be in the scan."""

MIN_VIEW_SHARE, MIN_VIEW_LENGTH = 0.6, 1.5
"""The stretch in good view must be this share of the wall, or this long, metres: more than a
doorway, through which beams may pass though the wall stands."""

MAX_VIEW_DISTANCE = 6.0
"""A place farther from the lidar than this is not in good view, metres."""

MIN_INCIDENCE_SINE = math.sin(math.radians(20.0))
"""Sine of the angle between beam and wall below which a place is not in good view either."""

PASS_DEPTH = 0.4
"""A beam passes through a wall if it ends this far behind it, metres: odometry drifts."""


@kernel
def is_passed_by_beams(
    ranges: FloatArray,
    angle_min: float,
    angle_increment: float,
    pose: tuple[float, float, float],
    wall: Ends,
) -> bool:
    """Whether the beams to three in four of the places in good view end behind the wall.

    Args:
        ranges: of the scan, metres, shape (n,); a beam without a return tells nothing.
        angle_min: of the scan, radians.
        angle_increment: of the scan, radians.
        pose: of the lidar in the wall's frame.
        wall: its ends, metres.
    """
    start_x, start_y, end_x, end_y = wall
    dx, dy = end_x - start_x, end_y - start_y
    x, y = start_x - pose[0], start_y - pose[1]
    length = math.sqrt(dx * dx + dy * dy)
    across = abs(x * dy - y * dx) / length
    reach = min(MAX_VIEW_DISTANCE, across / MIN_INCIDENCE_SINE)
    if reach <= across:
        return False
    foot, half = -(x * dx + y * dy) / length, math.sqrt(reach * reach - across * across)
    first, last = max(foot - half, 0.0), min(foot + half, length)
    if last - first < min(MIN_VIEW_SHARE * length, MIN_VIEW_LENGTH):
        return False
    in_view = passed = 0
    for k in range(SAMPLES):
        share = (first + (k + 0.5) / SAMPLES * (last - first)) / length
        px, py = x + share * dx, y + share * dy
        distance = math.sqrt(px * px + py * py)
        angle = math.atan2(py, px) - pose[2] - angle_min
        angle -= 2.0 * math.pi * math.floor(angle / (2.0 * math.pi))
        beam = int(angle / angle_increment + 0.5)
        if beam < len(ranges) and ranges[beam] < math.inf:
            in_view += 1
            passed += ranges[beam] > distance + PASS_DEPTH
    return bool(in_view >= MIN_SAMPLES_IN_VIEW and 4 * passed >= 3 * in_view)
