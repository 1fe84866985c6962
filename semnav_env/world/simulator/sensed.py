"""What crosses the seam from the simulator to the robot, and what the judge is told beside it."""

from __future__ import annotations

from typing import NamedTuple

from semnav_features.frames import Contact, FloatArray, Pose, Twist


class Motion(NamedTuple):
    """The true motion of one control period; only the judge is told.

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
    """What a robot senses in one control period.

    Attributes:
        ranges: of the scan, metres, shape (beams,); written anew in the next period.
        odometry: pose by dead reckoning, odometry frame: its origin is the start pose.
        velocity: of the robot.
        bumps: where the body touches what cannot move, robot frame.
        motion: what truly happened; not for the robot.
    """

    ranges: FloatArray
    odometry: Pose
    velocity: Twist
    bumps: list[Contact]
    motion: Motion
