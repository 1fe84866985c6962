"""Rules of `Pilot` as kernels: what a goal means to the driver, and when a robot is stuck."""

from __future__ import annotations

from semnav_agents.planning.aim import Aim
from semnav_features.frames import Pose, Twist, compose
from semnav_features.kernels.compiling import kernel

STUCK_STEPS = 8
"""Steps of pushing without moving after which a robot counts as stuck."""

PUSHING_SPEED, STANDING_SPEED = 0.03, 0.02
"""Velocity that a robot was told from which it pushes, and below which it stands, m/s and rad/s."""

LOOKOUT_TOLERANCE = 0.4
"""Distance at which a lookout point counts as reached, metres."""

REACH_TOLERANCE, REACH_HEADING_TOLERANCE = 0.2, 0.15
"""Distance and heading error at which a place to stop at counts as reached, metres and radians."""


@kernel
def count_pushing(pushed: int, told: Twist, velocity: Twist) -> int:
    """The steps in a row in which a robot was told to move, and did not."""
    wanted = max(abs(told[0]), abs(told[1]), abs(told[2]))
    speed = max(abs(velocity[0]), abs(velocity[1]), abs(velocity[2]))
    return pushed + 1 if wanted > PUSHING_SPEED and speed < STANDING_SPEED else 0


@kernel
def place_aim(seeks: bool, place: Pose, pose: Pose, axle: float) -> Aim:
    """The aim of a goal that is no door, in the frame of `pose`.

    Args:
        seeks: whether it is a place to look from; otherwise it is one to stop at.
        place: of the goal, robot frame.
        pose: of the robot's centre.
        axle: x of the axle in the robot frame, metres.
    """
    x, y, heading = compose(pose, place)
    if seeks:
        return Aim(x, y, heading, LOOKOUT_TOLERANCE, 0.0, True, axle)
    return Aim(x, y, heading, REACH_TOLERANCE, REACH_HEADING_TOLERANCE, False, axle)
