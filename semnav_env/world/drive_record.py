"""The numbers with which compiled code drives one robot."""

from __future__ import annotations

import numpy as np

from semnav_env.features.frames import MOST_CONTACTS
from semnav_env.robots import RobotSpec

POSE = np.dtype([("x", "f8"), ("y", "f8"), ("heading", "f8")])
"""A `Pose` in a record: metres, radians."""

TWIST = np.dtype([("forward", "f8"), ("left", "f8"), ("turn", "f8")])
"""A `Twist` in a record: m/s, m/s, rad/s; robot frame."""

BODY_MOTION = np.dtype([(name, "f8") for name in ("x", "y", "angle", "vx", "vy", "turn")])
"""Where a body is and how it moves: metres, radians, m/s, rad/s; world frame."""

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
        ("period", "f8"),
        ("dt", "f8"),
        ("substeps", "i8"),
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
    period, dt: durations of a control period and of a substep, seconds.
    substeps: in a control period.

Set before each control period:
    command: demanded velocity of the axle's middle, robot frame.

Written in each control period:
    demand: velocity of the control body.
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


def drive_record(robot: RobotSpec, period: float, substeps: int) -> np.ndarray:
    """A record of a robot at rest that has no body yet, dtype `DRIVE`, shape (1,)."""
    record = np.zeros(1, DRIVE)
    for name in ("max_speed", "max_sideways_speed", "max_turn_rate", "axle"):
        record[name] = getattr(robot, name)
    record["max_change"] = robot.max_acceleration * period
    record["max_turn_change"] = robot.max_turn_acceleration * period
    record["period"], record["dt"], record["substeps"] = period, period / substeps, substeps
    return record
