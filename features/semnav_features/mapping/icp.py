"""The kernel of the scan matcher: iterative closest points (ICP)."""

from __future__ import annotations

import math

import numpy as np

from semnav_features.frames import FloatArray
from semnav_features.kernels.compiling import kernel
from semnav_features.mapping.closest import pair
from semnav_features.mapping.steps import (
    CONVERGED,
    ITERATIONS,
    RESIDUAL,
    add_guess,
    find_weak,
    linearise,
    procrustes,
    solve,
    wrapped,
)

SETTINGS = np.dtype(
    [
        ("roughness", "f8"),
        ("max_distance", "f8"),
        ("outliers", "f8"),
        ("tolerance_position", "f8"),
        ("tolerance_angle", "f8"),
        ("guess_position", "f8"),
        ("guess_angle", "f8"),
        ("undetermined", "f8"),
        ("max_iterations", "i8"),
        ("point_to_point", "?"),
    ]
)
"""What the kernel reads of `MatchSettings`."""

_MIN_PAIR_DISTANCE = 0.15
"""Points up to this far apart are always paired, metres: that of two beams on a far wall."""

_COARSE_STRIDE = 4
"""While the solution is far, only every fourth beam is paired."""


@kernel
def align(
    reference: FloatArray,
    scan: FloatArray,
    angle_min: float,
    angle_increment: float,
    settings: np.ndarray,
    pose: FloatArray,
    information: FloatArray,
    report: FloatArray,
) -> None:
    """Move `pose` until the scan lies on the reference.

    Args:
        reference: surface, shape (`ROWS`, n), with its beams `angle_increment` apart.
        scan: surface, shape (`ROWS`, m).
        angle_min: of the reference, radians.
        angle_increment: of the reference, radians.
        settings: `SETTINGS`, shape (1,).
        pose: x, y, heading of the scan in the reference: in, the first guess; out, the match.
        information: out, shape (3, 3): what the pairs say about the pose.
        report: out, shape (`REPORT_SIZE`,); the weak direction is (0, 0) where there is none.
    """
    s = settings[0]
    guess = pose.copy()
    pairs = np.full(scan.shape[1], -1, np.int64)
    gate, far = np.inf, s.max_distance
    stride = _COARSE_STRIDE
    normal_matrix, gradient = np.empty((3, 3)), np.empty(3)
    report[CONVERGED] = 0.0
    step = np.empty(3)
    for iteration in range(s.max_iterations):
        pair(reference, scan, angle_min, angle_increment, pose, stride, far, pairs)
        spread = linearise(
            reference, scan, pairs, stride, pose, gate, s, normal_matrix, gradient, report
        )
        if s.point_to_point:
            procrustes(reference, scan, pairs, stride, pose, gate, step)
        else:
            find_weak(normal_matrix, s.undetermined, report)
            add_guess(normal_matrix, gradient, guess, pose, s, report)
            solve(normal_matrix, gradient, step)
        for k in range(3):
            pose[k] += step[k]
        gate = s.outliers * max(1.0, spread)
        far = min(far, max(_MIN_PAIR_DISTANCE, s.outliers * report[RESIDUAL]))
        report[ITERATIONS] = iteration + 1
        distance, heading_change = math.hypot(step[0], step[1]), abs(step[2])
        if stride > 1:
            if distance < 20.0 * s.tolerance_position and heading_change < 20.0 * s.tolerance_angle:
                stride = 1
        elif distance < s.tolerance_position and heading_change < s.tolerance_angle:
            report[CONVERGED] = 1.0
            break
    pair(reference, scan, angle_min, angle_increment, pose, 1, far, pairs)
    linearise(reference, scan, pairs, 1, pose, gate, s, information, gradient, report)
    find_weak(information, s.undetermined, report)
    pose[2] = wrapped(pose[2])
