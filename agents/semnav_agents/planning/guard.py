"""The last check of a steering: whether it leads into an obstacle within a short time."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from semnav_agents.planning.motion import Move, moved
from semnav_agents.planning.nudge import path_clearance
from semnav_env.robots import RobotSpec
from semnav_features.frames import FloatArray, Twist
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.exact_hypot import exact_hypot

CONTACT_CLEARANCE = 0.006
"""Clearance below which a steering counts as a collision, metres: small, because a robot
must also get through gaps that leave it a few centimetres."""

FORESIGHT = 0.3
"""Time for which a steering is checked, in addition to the time to brake, seconds: a few steps."""

GUARD_REACH = 1.5
"""Distance within which points matter to `safe_share`, in lengths of the body."""

SPEED_SHARES = (1.0, 0.5, 0.25)
"""Shares of the wanted velocity that are tried in turn before a steering is refused."""


class GuardedBody(NamedTuple):
    """What of a `RobotSpec` decides where a steering leads.

    Attributes:
        length: metres.
        width: metres.
        axle: x of the axle in the robot frame, metres.
        max_acceleration: m/s^2.
    """

    length: float
    width: float
    axle: float
    max_acceleration: float

    @staticmethod
    def of(robot: RobotSpec) -> GuardedBody:
        """That of a robot."""
        sizes = float(robot.length), float(robot.width), float(robot.axle)
        return GuardedBody(*sizes, float(robot.max_acceleration))


@kernel
def safe_share(points: FloatArray, twist: Twist, velocity: Twist, body: GuardedBody) -> float:
    """The largest share of a velocity that leads into no obstacle, or 0.

    Args:
        points: obstacles in the robot frame, metres, shape (N, 2).
        twist: the velocity that is wanted, of the robot's centre.
        velocity: its velocity now.
        body: of the robot.
    """
    near, n = np.empty_like(points), 0
    for k in range(len(points)):
        if abs(points[k, 0]) < body.length and abs(points[k, 1]) < body.length:
            near[n] = points[k]
            n += 1
    seconds = FORESIGHT + exact_hypot(velocity[0], velocity[1]) / body.max_acceleration / 2
    axle_twist = Move(twist[0], twist[1] - body.axle * twist[2], twist[2])
    for share in SPEED_SHARES:
        if not _hits(near[:n], axle_twist, share * seconds, body.length, body.width):
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
