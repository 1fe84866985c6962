"""One step of the scan matcher: the motion that moves each point onto its partner."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from semnav_features.frames import FloatArray
from semnav_features.kernels.compiling import kernel
from semnav_features.mapping.surface import (
    FOOT_X,
    FOOT_Y,
    NORMAL_X,
    NORMAL_Y,
    RANGE,
    SPACING,
    TILT,
    VARIANCE,
    X,
    Y,
)

PAIRS, INLIERS, RESIDUAL, CHI_SQUARED, WEAK_X, WEAK_Y, ITERATIONS, CONVERGED = range(8)
"""Entries of the kernel's report: points of the scan, pairs that fit, their root mean square
distance (m), sum of their weighted squared distances, weak direction (unit vector or zero),
iterations made, and whether the last step was small enough."""

REPORT_SIZE = CONVERGED + 1

_MIN_FACING_COSINE = math.cos(math.radians(40.0))
"""Cosine of the largest angle between the normals of paired surfaces."""

_WEAK_GUESS_WEIGHT = 1e10
"""Weight of the first guess along a weak direction, 1 / m^2: more than any scan's."""


@kernel
def linearise(
    reference: FloatArray,
    scan: FloatArray,
    pairs: np.ndarray,
    stride: int,
    pose: FloatArray,
    gate: float,
    settings: Any,
    matrix: FloatArray,
    gradient: FloatArray,
    report: FloatArray,
) -> float:
    """Write the normal equations of the weighted point-to-line error; returns its weighted RMS.

    Pairs whose residual exceeds the gate are marked -1. A line's direction is uncertain, too: noisy
    normals of a wall point a little along it and so add information on where along it the scan
    lies, which is not there. Its expected value is subtracted from the matrix.
    """
    c, s = math.cos(pose[2]), math.sin(pose[2])
    matrix[:] = 0.0
    gradient[:] = 0.0
    total, inliers, squares, chi = 0, 0, 0.0, 0.0
    for j in range(0, scan.shape[1], stride):
        i = pairs[j]
        total += scan[RANGE, j] > 0.0
        if i < 0:
            continue
        px, py = c * scan[X, j] - s * scan[Y, j], s * scan[X, j] + c * scan[Y, j]
        nx, ny = reference[NORMAL_X, i], reference[NORMAL_Y, i]
        mx = c * scan[NORMAL_X, j] - s * scan[NORMAL_Y, j]
        my = s * scan[NORMAL_X, j] + c * scan[NORMAL_Y, j]
        dx, dy = pose[0] + px - reference[FOOT_X, i], pose[1] + py - reference[FOOT_Y, i]
        error = nx * dx + ny * dy
        beside = ny * dx - nx * dy
        variance = reference[VARIANCE, i] + scan[VARIANCE, j] + settings.roughness**2
        weight = 1.0 / variance
        if (
            nx * mx + ny * my < _MIN_FACING_COSINE
            or error * error * weight > gate * gate
            or abs(beside) > reference[SPACING, i] + scan[SPACING, j]
        ):
            pairs[j] = -1
            continue
        inliers += 1
        lever = ny * px - nx * py
        _add(matrix, weight, nx, ny, lever)
        tilt = -weight * reference[TILT, i]
        _add(matrix, tilt, ny, -nx, -(nx * px + ny * py))
        gradient[0] -= weight * nx * error
        gradient[1] -= weight * ny * error
        gradient[2] -= weight * lever * error
        squares += error * error
        chi += weight * error * error
    report[PAIRS], report[INLIERS] = total, inliers
    report[RESIDUAL] = math.sqrt(squares / max(inliers, 1))
    report[CHI_SQUARED] = chi
    return math.sqrt(chi / max(inliers, 1))


@kernel
def _add(matrix: FloatArray, weight: float, a: float, b: float, c: float) -> None:
    """Add the weighted outer product of (a, b, c) with itself."""
    matrix[0, 0] += weight * a * a
    matrix[0, 1] += weight * a * b
    matrix[0, 2] += weight * a * c
    matrix[1, 1] += weight * b * b
    matrix[1, 2] += weight * b * c
    matrix[2, 2] += weight * c * c
    matrix[1, 0], matrix[2, 0], matrix[2, 1] = matrix[0, 1], matrix[0, 2], matrix[1, 2]


@kernel
def find_weak(matrix: FloatArray, share: float, report: FloatArray) -> None:
    """Report the direction along which the matrix says too little about the place, if any.

    The heading is free, so what a rotation explains is taken off the matrix's part for the place
    (its Schur complement). The direction is the minor axis of what is left, if its eigenvalue is at
    most `share` of the major one.
    """
    rotation = max(matrix[2, 2], 1e-12)
    a = matrix[0, 0] - matrix[0, 2] * matrix[0, 2] / rotation
    b = matrix[0, 1] - matrix[0, 2] * matrix[1, 2] / rotation
    d = matrix[1, 1] - matrix[1, 2] * matrix[1, 2] / rotation
    middle, half = 0.5 * (a + d), math.hypot(0.5 * (a - d), b)
    weak = middle - half <= share * (middle + half)
    angle = 0.5 * math.atan2(-2.0 * b, d - a)
    report[WEAK_X] = math.cos(angle) if weak else 0.0
    report[WEAK_Y] = math.sin(angle) if weak else 0.0


@kernel
def add_guess(
    matrix: FloatArray,
    gradient: FloatArray,
    guess: FloatArray,
    pose: FloatArray,
    settings: Any,
    report: FloatArray,
) -> None:
    """Add the first guess as one more observation; along a weak direction it alone decides."""
    x, y = report[WEAK_X], report[WEAK_Y]
    _add(matrix, _WEAK_GUESS_WEIGHT, x, y, 0.0)
    off = _WEAK_GUESS_WEIGHT * (x * (guess[0] - pose[0]) + y * (guess[1] - pose[1]))
    gradient[0] += off * x
    gradient[1] += off * y
    for k in range(3):
        deviation = settings.guess_angle if k == 2 else settings.guess_position
        weight = 1.0 / (deviation * deviation)
        matrix[k, k] += weight
        gradient[k] += weight * (guess[k] - pose[k])


@kernel
def solve(m: FloatArray, g: FloatArray, x: FloatArray) -> None:
    """Solve the symmetric system m x = g of three unknowns by cofactors; zero if singular."""
    a = m[1, 1] * m[2, 2] - m[1, 2] * m[1, 2]
    b = m[0, 2] * m[1, 2] - m[0, 1] * m[2, 2]
    c = m[0, 1] * m[1, 2] - m[0, 2] * m[1, 1]
    d = m[0, 0] * m[2, 2] - m[0, 2] * m[0, 2]
    e = m[0, 1] * m[0, 2] - m[0, 0] * m[1, 2]
    f = m[0, 0] * m[1, 1] - m[0, 1] * m[0, 1]
    determinant = m[0, 0] * a + m[0, 1] * b + m[0, 2] * c
    inverse = 1.0 / determinant if determinant > 0.0 else 0.0
    x[0] = inverse * (a * g[0] + b * g[1] + c * g[2])
    x[1] = inverse * (b * g[0] + d * g[1] + e * g[2])
    x[2] = inverse * (c * g[0] + e * g[1] + f * g[2])


@kernel
def procrustes(
    reference: FloatArray,
    scan: FloatArray,
    pairs: np.ndarray,
    stride: int,
    pose: FloatArray,
    gate: float,
    step: FloatArray,
) -> None:
    """The rigid motion that lays the paired points on each other with least squares."""
    count, ax, ay, bx, by, dot, cross = 0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for j in range(0, scan.shape[1], stride):
        i = pairs[j]
        if i < 0:
            continue
        px, py = scan[X, j], scan[Y, j]
        qx, qy = reference[X, i], reference[Y, i]
        count += 1
        ax, ay, bx, by = ax + px, ay + py, bx + qx, by + qy
        dot += px * qx + py * qy
        cross += px * qy - py * qx
    step[:] = 0.0
    if count < 2:
        return
    ax, ay, bx, by = ax / count, ay / count, bx / count, by / count
    heading = math.atan2(cross - count * (ax * by - ay * bx), dot - count * (ax * bx + ay * by))
    c, s = math.cos(heading), math.sin(heading)
    step[0] = bx - (c * ax - s * ay) - pose[0]
    step[1] = by - (s * ax + c * ay) - pose[1]
    step[2] = wrapped(heading - pose[2])


@kernel
def wrapped(angle: float) -> Any:
    """The same angle in [-pi, pi)."""
    return angle - 2.0 * math.pi * math.floor(angle / (2.0 * math.pi) + 0.5)
