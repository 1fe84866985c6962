"""The data from the simulator for the robot, and the true motion for the judge."""

from __future__ import annotations

from typing import NamedTuple

from semnav_features.frames import Contact, FloatArray, Pose, Twist


class Motion(NamedTuple):
    """The true motion of one control period, for the judge only.

    Attributes:
        pose: true pose of the robot's centre, world frame.
        speed: m/s.
        yaw_rate: rad/s.
        in_contact: whether the body touches anything.
        seconds: duration of the period.
    """

    pose: Pose
    speed: float
    yaw_rate: float
    in_contact: bool
    seconds: float


class Sensed(NamedTuple):
    """The sensor data of a robot in one control period.

    Attributes:
        ranges: ranges of the scan, metres, shape (beams,); overwritten in the next period.
        odometry: pose by dead reckoning, odom frame: its origin is the start pose.
        velocity: velocity of the robot by odometry.
        bumps: contact points of the body with things that cannot move, robot frame.
        motion: the true motion; not for the robot.
    """

    ranges: FloatArray
    odometry: Pose
    velocity: Twist
    bumps: list[Contact]
    motion: Motion
