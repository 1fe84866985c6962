"""The numbers with which compiled code drives one robot."""

from __future__ import annotations

import math

import numpy as np

from semnav_env.robots import RobotSpec
from semnav_env.world.physics.bodies import joint_accelerations
from semnav_features.frames import MOST_CONTACTS

POSE = np.dtype([("x", "f8"), ("y", "f8"), ("heading", "f8")])
"""A `Pose` in a record: metres, radians."""

TWIST = np.dtype([("forward", "f8"), ("left", "f8"), ("turn", "f8")])
"""A `Twist` in a record: m/s, m/s, rad/s; robot frame."""

BODY_MOTION = np.dtype([(name, "f8") for name in ("x", "y", "angle", "vx", "vy", "turn")])
"""Pose and velocity of a body: metres, radians, m/s, rad/s; world frame."""

BODY_VELOCITY = np.dtype([("vx", "f8"), ("vy", "f8"), ("turn", "f8")])
"""A velocity in the world frame: m/s, m/s, rad/s."""

DRIVE = np.dtype(
    [
        ("space", "u8"),
        ("control", "u8"),
        ("body", "u8"),
        ("max_speed", "f8"),
        ("max_sideways_speed", "f8"),
        ("max_turn_rate", "f8"),
        ("max_change", "f8"),
        ("max_turn_change", "f8"),
        ("axle", "f8"),
        ("half_length", "f8"),
        ("half_width", "f8"),
        ("radius", "f8"),
        ("longest_way", "f8"),
        ("joint_change", "f8"),
        ("joint_turn_change", "f8"),
        ("period", "f8"),
        ("dt", "f8"),
        ("substeps", "i8"),
        ("follows", "i8"),
        ("is_ahead", "i8"),
        ("command", TWIST),
        ("demand", BODY_VELOCITY),
        ("motion", BODY_MOTION),
        ("axle_velocity", TWIST),
        ("pose", POSE),
        ("velocity", TWIST),
        ("touches", "i8"),
        ("impulse", "f8"),
        ("contact_count", "i8"),
        ("contacts", "f8", (MOST_CONTACTS, 3)),
    ]
)
"""A robot, its drive and its motion; shape (1,).

Set when a world is made or reset:
    space: address of Chipmunk's space; 0 where Pymunk carries out the substeps.
    control: address of the kinematic body to which the joints hold the robot.
    body: address of the robot's body; its origin is the axle's middle.
    max_speed, max_sideways_speed, max_turn_rate: limits of the robot, m/s, rad/s.
    max_change, max_turn_change: largest change of the velocity in a control period, m/s, rad/s.
    axle: x of the axle's middle in the robot frame, metres.
    half_length, half_width: of the footprint, metres.
    radius: of the circle about the axle's middle that holds the footprint, metres.
    longest_way: how far a corner can come in a control period, metres.
    joint_change, joint_turn_change: the joints have the force for a smaller change of the velocity
        in a substep, m/s, rad/s; 0 where more moves than the robot.
    period, dt: durations of a control period and of a substep, seconds.
    substeps: in a control period.

Set before each control period:
    command: demanded velocity of the axle's middle, robot frame.

Written in each control period:
    demand: velocity of the control body.
    follows: 1 if the body moves as demanded and touches nothing.
    is_ahead: 1 if `motion` went on without Chipmunk's body, see `move_freely`.
    motion: of the robot's body.
    axle_velocity: of the axle's middle, robot frame.
    pose: of the footprint's centre, world frame; the heading is in [-pi, pi].
    velocity: of the footprint's centre, robot frame.
    touches: pairs of shapes that touched, summed over the substeps.
    impulse: sum of the magnitudes of their impulses, N s.
    contact_count: how many `contacts` are known, the first ones.
    contacts: where the robot touches what cannot move, each a `Contact`; world frame during the
        substeps, then robot frame.
"""


ROUNDING = 1e-6
"""Margin for rounding in the motion of a corner, metres."""

SURE_SHARE = 0.999
"""Share of the joints' force up to which it suffices in spite of rounding."""


def drive_record(robot: RobotSpec, period: float, substeps: int) -> np.ndarray:
    """A record of a robot at rest that has no body yet, dtype `DRIVE`, shape (1,)."""
    record = np.zeros(1, DRIVE)
    for name in ("max_speed", "max_sideways_speed", "max_turn_rate", "axle"):
        record[name] = getattr(robot, name)
    record["half_length"], record["half_width"] = robot.length / 2, robot.width / 2
    record["radius"], record["longest_way"] = radius(robot), longest_way(robot, period)
    record["max_change"] = robot.max_acceleration * period
    record["max_turn_change"] = robot.max_turn_acceleration * period
    record["period"], record["dt"], record["substeps"] = period, period / substeps, substeps
    acceleration, turn_acceleration = joint_accelerations(robot)
    record["joint_change"] = SURE_SHARE * acceleration * period / substeps
    record["joint_turn_change"] = SURE_SHARE * turn_acceleration * period / substeps
    return record


def radius(robot: RobotSpec) -> float:
    """Distance of the footprint's farthest corner from the axle's middle, metres."""
    return math.hypot(robot.length / 2 + abs(robot.axle), robot.width / 2)


def longest_way(robot: RobotSpec, period: float) -> float:
    """Largest motion of a corner of the footprint in a control period, metres."""
    speed = math.hypot(robot.max_speed, robot.max_sideways_speed)
    return ROUNDING + period * (speed + robot.max_turn_rate * radius(robot))
