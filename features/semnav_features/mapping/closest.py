"""Pairs the points of two scans: each with the nearest one, found in beam order."""

from __future__ import annotations

import math

import numpy as np

from semnav_features.frames import FloatArray
from semnav_features.kernels.compiling import kernel
from semnav_features.mapping.surface import RANGE, X, Y


@kernel
def pair(
    reference: FloatArray,
    scan: FloatArray,
    angle_min: float,
    angle_increment: float,
    pose: FloatArray,
    stride: int,
    far: float,
    pairs: np.ndarray,
) -> None:
    """For each point of the scan the nearest of the reference, -1 if none is within `far`.

    The search runs outwards from the beam that points at it, in both directions, and stops
    where all that follows must be farther away: a beam at an angle a to the point at range r
    passes it at r sin(a) (Censi 2008, section III-C, has the same bound).
    """
    c, s = math.cos(pose[2]), math.sin(pose[2])
    n = reference.shape[1]
    full_turn = 2.0 * math.pi
    per_radian = 1.0 / angle_increment
    sines = np.empty(n)
    quarter = 0
    for k in range(n):
        if k * angle_increment > 0.5 * math.pi:
            break
        sines[k] = math.sin(k * angle_increment) ** 2
        quarter = k + 1
    xs, ys, ranges = reference[X], reference[Y], reference[RANGE]
    for j in range(0, scan.shape[1], stride):
        pairs[j] = -1
        if scan[RANGE, j] == 0.0:
            continue
        x = pose[0] + c * scan[X, j] - s * scan[Y, j]
        y = pose[1] + s * scan[X, j] + c * scan[Y, j]
        towards = math.atan2(y, x) - angle_min
        towards -= full_turn * math.floor(towards / full_turn)
        beam = int(towards * per_radian + 0.5)
        if beam >= n:
            beam = (
                n - 1
                if towards - n * angle_increment < 0.5 * (full_turn - n * angle_increment)
                else 0
            )
        squared = x * x + y * y
        best, nearest = -1, far * far
        for k in range(quarter):
            if k > 0 and squared * sines[k - 1] > nearest:
                break
            i = beam + k
            if i < n and ranges[i] > 0.0:
                d = (xs[i] - x) ** 2 + (ys[i] - y) ** 2
                if d < nearest:
                    best, nearest = i, d
            i = beam - k
            if i >= 0 and ranges[i] > 0.0:
                d = (xs[i] - x) ** 2 + (ys[i] - y) ** 2
                if d < nearest:
                    best, nearest = i, d
        pairs[j] = best
