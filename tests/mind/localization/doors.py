"""Doors of a small plan, as robots see them."""

from __future__ import annotations

import math

import numpy as np
from hypothesis import strategies as st

from semnav_features.clouds.detected_door import DetectedDoor
from semnav_features.elements import Door
from semnav_features.frames import FloatArray, Point, Pose, to_local

JAMB_SIGMA = 0.03
"""Standard deviation of a detected jamb, metres."""

LEFT, RIGHT = Door((0.0, 3.0), (0.9, 3.0), "left"), Door((1.9, 3.0), (2.8, 3.0), "right")
"""Two doors in one wall, their jambs 1 m apart."""

poses = st.tuples(st.floats(-2.0, 5.0), st.floats(-1.0, 2.5), st.floats(-3.1, 3.1))
"""Of a robot in the room below that wall."""


def door_seen_from(
    pose: Pose, door: Door, covariance: FloatArray | None = None, **seen: bool
) -> DetectedDoor:
    """What a perfect detector finds."""
    start, end = to_local(pose, door.start), to_local(pose, door.end)
    covariance = np.zeros((4, 4)) if covariance is None else covariance
    return DetectedDoor(start, end, covariance=covariance, **seen)


def turned_about(centre: Point, pose: Pose, angle: float) -> Pose:
    """The pose after a turn of the robot about a point of the plan."""
    c, s = math.cos(angle), math.sin(angle)
    dx, dy = pose[0] - centre[0], pose[1] - centre[1]
    return centre[0] + c * dx - s * dy, centre[1] + s * dx + c * dy, pose[2] + angle
