"""Clearance of the footprint at many poses at once."""

from __future__ import annotations

import math

import numpy as np

from semnav_agents.planning.collision import Footprint, ObstacleField, bins_around
from semnav_features.frames import FloatArray, Pose
from semnav_features.kernels.compiling import kernel


@kernel
def clearances(field: ObstacleField, body: Footprint, poses: FloatArray, most: float) -> FloatArray:
    """Distance from the footprint to the nearest point at axle poses, metres, shape (M,).

    A distance is the larger of its parts along and across the body; it is at most `most`, and
    negative where the point is inside.
    """
    clearance = np.empty(len(poses))
    middle = (body.front - body.rear) / 2
    half_length, half_width = (body.front + body.rear) / 2, body.half_width
    around = math.hypot(half_length + most, half_width + most)
    for m in range(len(poses)):
        c, s = math.cos(poses[m, 2]), math.sin(poses[m, 2])
        x, y = poses[m, 0] + c * middle, poses[m, 1] + s * middle
        clearance[m] = most
        for k, upto in bins_around(field, x, y, around):
            for p in range(k, upto):
                dx, dy = field.points[p, 0] - x, field.points[p, 1] - y
                outside = max(abs(c * dx + s * dy) - half_length, abs(c * dy - s * dx) - half_width)
                clearance[m] = min(clearance[m], outside)
    return clearance


@kernel
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


@kernel
def points_around(pose: Pose, points: FloatArray, reach: float) -> FloatArray:
    """The points within a square of that half side around a pose, in its frame, shape (M, 2)."""
    c, s = math.cos(pose[2]), math.sin(pose[2])
    kept = np.empty_like(points)
    n = 0
    for k in range(len(points)):
        dx, dy = points[k, 0] - pose[0], points[k, 1] - pose[1]
        if abs(dx) < reach and abs(dy) < reach:
            kept[n, 0], kept[n, 1] = c * dx + s * dy, c * dy - s * dx
            n += 1
    return kept[:n]
