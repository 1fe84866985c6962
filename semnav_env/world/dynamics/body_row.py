"""The robot as one row of numbers, for the kernels of people and doors."""

from __future__ import annotations

import math

import numpy as np

from semnav_env.robots import RobotSpec
from semnav_features.frames import FloatArray, Pose, Twist

BODY_COLUMNS = (
    *("x", "y", "heading"),  # of the centre, world frame, metres and radians
    *("half_length", "half_width"),  # metres
    *("velocity_x", "velocity_y", "yaw_rate"),  # of the centre, world frame, m/s and rad/s
)
"""Names of the columns of a body's row."""

BODY_X, BODY_Y, BODY_HEADING, HALF_LENGTH, HALF_WIDTH, BODY_VX, BODY_VY, BODY_YAW_RATE = range(
    len(BODY_COLUMNS)
)
"""Index in the row of each of `BODY_COLUMNS`."""


def as_body(robot: RobotSpec, pose: Pose, velocity: Twist) -> FloatArray:
    """The row of a robot at a pose, shape (8,)."""
    c, s = math.cos(pose[2]), math.sin(pose[2])
    forward, left, yaw_rate = velocity
    moved = c * forward - s * left, s * forward + c * left
    return np.array([*pose, robot.length / 2, robot.width / 2, *moved, yaw_rate])
