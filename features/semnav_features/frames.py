"""Poses and rigid transforms in the plane: x forward, y left, angles counter-clockwise."""

from __future__ import annotations

import math
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

Point: TypeAlias = tuple[float, float]
"""(x, y) in metres."""

Pose: TypeAlias = tuple[float, float, float]
"""(x, y, heading) in metres and radians."""

Twist: TypeAlias = tuple[float, float, float]
"""A velocity (forward m/s, left m/s, yaw rate rad/s) in the robot frame."""

Contact: TypeAlias = tuple[float, float, float]
"""A point where a body touches something: (x, y) in metres, and the direction from there into the
touched object, radians; robot frame."""

MOST_CONTACTS = 9
"""Largest number of contacts of a control period that are used: substeps repeat them."""

FloatArray: TypeAlias = NDArray[np.float64]

ORIGIN: Pose = (0.0, 0.0, 0.0)
"""The pose of a frame in itself."""


def wrap_angle(angle: float) -> float:
    """The same angle in [-pi, pi]."""
    return math.remainder(angle, math.tau)


def compose(frame: Pose, local: Pose) -> Pose:
    """Express in the parent frame a pose that is given in `frame`."""
    x, y = to_parent(frame, (local[0], local[1]))
    return x, y, wrap_angle(frame[2] + local[2])


def relative(frame: Pose, pose: Pose) -> Pose:
    """Express in `frame` a pose that is given in its parent frame; the inverse of `compose`."""
    x, y = to_local(frame, (pose[0], pose[1]))
    return x, y, wrap_angle(pose[2] - frame[2])


def to_parent(frame: Pose, point: Point) -> Point:
    """Express in the parent frame a point that is given in `frame`."""
    c, s = math.cos(frame[2]), math.sin(frame[2])
    return frame[0] + c * point[0] - s * point[1], frame[1] + s * point[0] + c * point[1]


def to_local(frame: Pose, point: Point) -> Point:
    """Express in `frame` a point that is given in its parent frame."""
    c, s = math.cos(frame[2]), math.sin(frame[2])
    dx, dy = point[0] - frame[0], point[1] - frame[1]
    return c * dx + s * dy, c * dy - s * dx


def heading_between(start: tuple[float, ...], end: tuple[float, ...]) -> float:
    """The heading from one point to another, radians."""
    return math.atan2(end[1] - start[1], end[0] - start[0])


def middle_of(start: tuple[float, ...], end: tuple[float, ...]) -> Point:
    """The point halfway between two points."""
    return (start[0] + end[0]) / 2, (start[1] + end[1]) / 2


def path_length(points: FloatArray) -> float:
    """Length of the line through points, shape (n, 2), metres."""
    steps = np.diff(points, axis=0)
    return float(np.hypot(steps[:, 0], steps[:, 1]).sum())


def distances_along(points: FloatArray) -> FloatArray:
    """Distance along the line through points, shape (n, 2), up to each of them, metres."""
    return np.concatenate(([0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))))


def points_to_parent(frame: Pose, points: FloatArray) -> FloatArray:
    """`to_parent` for an array of points, shape (..., 2)."""
    c, s = math.cos(frame[2]), math.sin(frame[2])
    x, y = points[..., 0], points[..., 1]
    return np.stack((frame[0] + c * x - s * y, frame[1] + s * x + c * y), axis=-1)


def points_to_local(frame: Pose, points: FloatArray) -> FloatArray:
    """`to_local` for an array of points, shape (..., 2)."""
    c, s = math.cos(frame[2]), math.sin(frame[2])
    dx, dy = points[..., 0] - frame[0], points[..., 1] - frame[1]
    return np.stack((c * dx + s * dy, c * dy - s * dx), axis=-1)
