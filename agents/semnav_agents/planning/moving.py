"""Tells the hits on what moves, people and leaves of doors, from those on what stands.

Each scan is compared with how far earlier scans could see, see `kernels.past_views`.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from semnav_features.frames import FloatArray, Pose
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.past_views import (
    FREE,
    look_back,
    mark_maybe_free,
    note_view,
)

MAX_DISTANCE = 5.0
"""Distance beyond which nothing that moves matters to a robot, metres."""

MIN_RUN = 0.15
"""Least length of neighbouring hits in free places that are something that moves, metres: single
ones are noise at the edges of what stands."""


@kernel
def mark_moving(
    ranges: FloatArray,
    start: float,
    step: float,
    pose: Pose,
    used: Any,
    views: Any,
    moving: NDArray[np.bool_],
) -> None:
    """Write which beams end on something that moves, and keep the scan as a view if one is due.

    Args:
        ranges: metres, shape (n,); infinite where nothing returned.
        start: direction of the first beam, lidar frame, radians.
        step: angle between two beams, radians.
        pose: of the lidar, odometry frame.
        used: an entry of `MEMORY_STATE`, changed in place.
        views: an entry of `PAST_VIEWS`, changed in place.
        moving: written where something moves; False before; shape (n,).
    """
    maybe = _maybe_free(ranges, start, step, pose, used.views, views)
    first, length, last_x, last_y = -1, 0.0, 0.0, 0.0
    for i in range(len(ranges) + 1):
        is_free, x, y = False, 0.0, 0.0
        if i < len(ranges) and maybe[i] and 0.05 < ranges[i] < MAX_DISTANCE:
            angle = pose[2] + start + i * step
            x, y = pose[0] + ranges[i] * np.cos(angle), pose[1] + ranges[i] * np.sin(angle)
            is_free = look_back(x, y, used.views, views) == FREE
        if is_free:
            if first < 0:
                first, length = i, 0.0
            else:
                length += np.hypot(x - last_x, y - last_y)
            last_x, last_y = x, y
        elif first >= 0:
            moving[first:i] = length >= MIN_RUN
            first = -1
    note_view(ranges, start, step, pose, used, views)
    used.scans += 1


@kernel
def _maybe_free(
    ranges: FloatArray, start: float, step: float, pose: Pose, count: int, views: Any
) -> NDArray[np.bool_]:
    """Which hits may lie in free places, see `mark_maybe_free`, shape (n,)."""
    x, y = np.empty(len(ranges)), np.empty(len(ranges))
    c, s = math.cos(pose[2] + start), math.sin(pose[2] + start)  # of the beam, to some 1e-13
    turn_c, turn_s = math.cos(step), math.sin(step)
    for i in range(len(ranges)):
        near = ranges[i] if ranges[i] < MAX_DISTANCE else MAX_DISTANCE  # also for NaN
        x[i], y[i] = pose[0] + near * c, pose[1] + near * s
        c, s = turn_c * c - turn_s * s, turn_c * s + turn_s * c
    maybe = np.empty(len(ranges), np.bool_)
    mark_maybe_free(x, y, count, views, maybe)
    return maybe
