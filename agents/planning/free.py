"""Checks of many poses at once."""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from semnav_env.agents.planning.collision import Body, Field, room_at
from semnav_env.features.frames import FloatArray


@njit(cache=True)
def rooms(field: Field, body: Body, poses: FloatArray) -> FloatArray:
    """About the clearance at axle poses, shape (M, 3), in metres, shape (M,)."""
    room = np.empty(len(poses))
    for k in range(len(poses)):
        room[k] = room_at(field, body, poses[k, 0], poses[k, 1], poses[k, 2])
    return room


@njit(cache=True)
def all_clear(
    points: FloatArray, poses: FloatArray, length: float, width: float, margin: float
) -> bool:
    """Whether no point lies in a rectangle of that size, grown by the margin, at any pose."""
    half_length, half_width = length / 2 + margin, width / 2 + margin
    around = math.hypot(half_length, half_width)
    for m in range(len(poses)):
        x, y = poses[m, 0], poses[m, 1]
        c, s = math.cos(poses[m, 2]), math.sin(poses[m, 2])
        for k in range(len(points)):
            dx, dy = points[k, 0] - x, points[k, 1] - y
            if (
                abs(dx) < around
                and abs(dy) < around
                and abs(c * dx + s * dy) < half_length
                and abs(c * dy - s * dx) < half_width
            ):
                return False
    return True
