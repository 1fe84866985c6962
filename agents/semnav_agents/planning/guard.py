"""The last check of a steering: whether it leads into an obstacle within a short time."""

from __future__ import annotations

import math

import numpy as np

from semnav_agents.planning.motion import Move, moved
from semnav_agents.planning.nudge import path_clearance
from semnav_env.robots import RobotSpec
from semnav_features.frames import FloatArray, Twist
from semnav_features.kernels.compiling import kernel

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
    if not len(points):
        return SPEED_SHARES[0]
    forward, left, yaw_rate = twist
    seconds = FORESIGHT + math.hypot(velocity[0], velocity[1]) / robot.max_acceleration / 2
    axle_twist = Move(forward, left - robot.axle * yaw_rate, yaw_rate)
    return float(free_share(points, axle_twist, seconds, robot.length, robot.width))


@kernel
def free_share(
    points: FloatArray, axle_twist: Move, seconds: float, length: float, width: float
) -> float:
    """See `safe_share`, with the velocity of the axle and the time for a share of 1."""
    near, n = np.empty_like(points), 0
    for k in range(len(points)):
        if abs(points[k, 0]) < length and abs(points[k, 1]) < length:
            near[n] = points[k]
            n += 1
    for share in SPEED_SHARES:
        if not _hits(near[:n], axle_twist, share * seconds, length, width):
            return share
    return 0.0


@kernel
def _hits(
    points: FloatArray, axle_twist: Move, seconds: float, length: float, width: float
) -> bool:
    """Whether driving on comes closer to a point than `CONTACT_CLEARANCE` and than now."""
    poses = np.empty((5, 3))
    for k in range(5):
        poses[k] = moved(0.0, 0.0, 0.0, axle_twist, seconds * k / 4)
    now = path_clearance(points, poses[:1], length, width, 0.0, 0.0, -math.inf)
    soon = path_clearance(points, poses[1:], length, width, 0.0, 0.0, -math.inf)
    return bool(soon < CONTACT_CLEARANCE and soon < now - 0.004)
