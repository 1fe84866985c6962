"""A last look ahead: does the steering lead into something within the next moments?"""

from __future__ import annotations

import math

import numpy as np

from semnav_env.agents.planning.motion import moved
from semnav_env.agents.planning.nudge import path_clearance
from semnav_env.features.frames import FloatArray
from semnav_env.robots import RobotSpec

ALERT = 0.006
"""Metres of clearance below which it counts as a collision."""

FORESIGHT = 0.3
"""Seconds; the time to brake comes on top."""

SHARES = (1.0, 0.5, 0.25)
"""Shares of a steering that are tried before it is refused."""


def safe_share(
    points: FloatArray,
    command: tuple[float, float, float],
    velocity: tuple[float, float, float],
    robot: RobotSpec,
) -> float:
    """The largest share of a command that leads into nothing, or 0.

    Args:
        points: obstacles in the robot frame, metres, shape (N, 2).
        command: (forward, left, turn), m/s and rad/s.
        velocity: the same, now.
        robot: gives footprint, axle and limits.
    """
    seconds = FORESIGHT + math.hypot(velocity[0], velocity[1]) / robot.max_acceleration / 2
    near = points[np.abs(points).max(axis=1, initial=0.0) < robot.length]
    for share in SHARES:
        if not _hits(near, command, share * seconds, robot):
            return share
    return 0.0


def _hits(
    points: FloatArray, command: tuple[float, float, float], seconds: float, robot: RobotSpec
) -> bool:
    """Whether driving on comes closer than `ALERT`; one already there may not go on."""
    forward, left, turn = command
    twist = (forward, left - robot.axle * turn, turn)
    poses = np.array([moved(0.0, 0.0, 0.0, twist, seconds * k / 4) for k in range(5)])
    size = (robot.length, robot.width)
    now = path_clearance(points, poses[:1], *size, 0.0, 0.0, -math.inf)
    soon = path_clearance(points, poses[1:], *size, 0.0, 0.0, -math.inf)
    return bool(soon < ALERT and soon < now - 0.004)
