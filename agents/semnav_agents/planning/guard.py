"""The last check of a steering: whether it leads into an obstacle within a short time."""

from __future__ import annotations

import math

import numpy as np

from semnav_agents.planning.motion import Move, moved
from semnav_agents.planning.nudge import path_clearance
from semnav_env.robots import RobotSpec
from semnav_features.frames import FloatArray, Twist

CONTACT_CLEARANCE = 0.006
"""Clearance below which a steering counts as a collision, metres: small, because a robot
must also get through gaps that leave it a few centimetres."""

FORESIGHT = 0.3
"""Time for which a steering is checked, in addition to the time to brake, seconds: a few steps."""

SPEED_SHARES = (1.0, 0.5, 0.25)
"""Shares of the wanted velocity that are tried in turn before a steering is refused."""


def safe_share(
    points: FloatArray,
    twist: Twist,
    velocity: Twist,
    robot: RobotSpec,
) -> float:
    """The largest share of a velocity that leads into no obstacle, or 0.

    Args:
        points: obstacles in the robot frame, metres, shape (N, 2).
        twist: the velocity that is wanted, of the robot's centre.
        velocity: its velocity now.
        robot: gives footprint, axle and limits.
    """
    seconds = FORESIGHT + math.hypot(velocity[0], velocity[1]) / robot.max_acceleration / 2
    near = points[np.abs(points).max(axis=1, initial=0.0) < robot.length]
    for share in SPEED_SHARES:
        if not _hits(near, twist, share * seconds, robot):
            return share
    return 0.0


def _hits(points: FloatArray, twist: Twist, seconds: float, robot: RobotSpec) -> bool:
    """Whether driving on comes closer to a point than `CONTACT_CLEARANCE` and than now."""
    forward, left, yaw_rate = twist
    axle_twist = Move(forward, left - robot.axle * yaw_rate, yaw_rate)
    poses = np.array([moved(0.0, 0.0, 0.0, axle_twist, seconds * k / 4) for k in range(5)])
    size = (robot.length, robot.width)
    now = path_clearance(points, poses[:1], *size, 0.0, 0.0, -math.inf)
    soon = path_clearance(points, poses[1:], *size, 0.0, 0.0, -math.inf)
    return bool(soon < CONTACT_CLEARANCE and soon < now - 0.004)
