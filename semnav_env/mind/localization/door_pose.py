"""The pose of the robot from a detected door of the plan, with its covariance."""

from __future__ import annotations

import math

import numpy as np

from semnav_features.clouds.detected_door import DetectedDoor
from semnav_features.elements import Door
from semnav_features.frames import (
    FloatArray,
    Pose,
    heading_between,
    to_local,
    to_parent,
    wrap_angle,
)

ROUNDING = 1e-9
"""Tolerance for rounding errors of a covariance, square metres."""


def pose_from_door(door_world: Door, detected: DetectedDoor) -> tuple[Pose, FloatArray]:
    """The pose from which a door of the plan appears as it was detected, and its covariance.

    The heading is the difference of the directions from jamb to jamb: its error is that of the
    jambs across the wall, over the width of the door. The middle of the door then gives the place,
    whose error beside the line of sight is the error of the heading times the distance.

    Args:
        door_world: of the plan; anything with `start`, `end` and `midpoint`.
        detected: with both jambs.

    Returns:
        The pose, world frame; and the covariance of x, y (square metres) and heading, shape (3, 3).

    Raises:
        ValueError: one jamb was not found, for the other leaves a circle of poses; or a detection
            that `check_detected` refuses.
    """
    check_detected(detected)
    if not detected.is_whole or detected.width <= 0.0:
        raise ValueError("a pose takes a door with both jambs; one jamb leaves a circle of poses")
    heading = wrap_angle(
        heading_between(door_world.start, door_world.end)
        - heading_between(detected.start, detected.end)
    )
    x, y = to_parent((0.0, 0.0, heading), detected.midpoint)
    pose = door_world.midpoint[0] - x, door_world.midpoint[1] - y, heading
    jacobian = _jacobian(heading, detected)
    return pose, jacobian @ detected.covariance @ jacobian.T


def _jacobian(heading: float, detected: DetectedDoor) -> FloatArray:
    """Of `pose_from_door` by (start x, start y, end x, end y), shape (3, 4)."""
    (x1, y1), (x2, y2) = detected.start, detected.end
    across = np.array([y1 - y2, x2 - x1]) / detected.width**2
    by_heading = np.r_[across, -across]
    c, s = math.cos(heading), math.sin(heading)
    turn = np.array([[c, -s], [s, c]])
    mx, my = detected.midpoint
    place = -turn @ (0.5 * np.hstack((np.eye(2), np.eye(2))) + np.outer((-my, mx), by_heading))
    return np.vstack((place, by_heading))


def seen_jambs(
    pose: Pose, door_world: Door, detected: DetectedDoor
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """The residual, Jacobian and noise of the jambs that were found, for a filter.

    Args:
        pose: about which to linearise, world frame.
        door_world: of the plan.
        detected: the same door.

    Returns:
        Detected minus expected x and y of each found jamb, robot frame, shape (n,); the Jacobian
        of the expected ones by the pose, shape (n, 3); the covariance of the detected ones, shape
        (n, n). n is 4 for a whole door and 2 for one jamb.
    """
    c, s = math.cos(pose[2]), math.sin(pose[2])
    residual, jacobian = np.empty(4), np.empty((4, 3))
    pairs = (door_world.start, detected.start), (door_world.end, detected.end)
    for k, (known, found) in enumerate(pairs):
        x, y = to_local(pose, known)
        residual[2 * k : 2 * k + 2] = found[0] - x, found[1] - y
        jacobian[2 * k : 2 * k + 2] = (-c, -s, y), (s, -c, -x)
    found_rows = np.repeat((detected.start_seen, detected.end_seen), 2)
    covariance = detected.covariance[np.ix_(found_rows, found_rows)]
    return residual[found_rows], jacobian[found_rows], covariance


def check_detected(detected: DetectedDoor) -> None:
    """Refuse a detection that is not a valid measurement.

    Raises:
        ValueError: jambs that are not finite, no jamb found, or a covariance that is none.
    """
    covariance = detected.covariance
    if not all(map(math.isfinite, (*detected.start, *detected.end))):
        raise ValueError(f"jambs {detected.start} and {detected.end}; they must be finite")
    if not (detected.start_seen or detected.end_seen):
        raise ValueError("neither jamb was found; a detected door has one at least")
    if covariance.shape != (4, 4) or not is_covariance(covariance):
        raise ValueError("the covariance of a detected door is 4 x 4, symmetric and not negative")


def is_covariance(matrix: FloatArray) -> bool:
    """Whether a square matrix is finite, symmetric and has no negative eigenvalue."""
    return bool(
        np.isfinite(matrix).all()
        and np.allclose(matrix, matrix.T, rtol=ROUNDING, atol=ROUNDING)
        and np.linalg.eigvalsh(matrix)[0] >= -ROUNDING
    )
