"""The state estimate of a robot as a record, which kernels read and write at every scan."""

from __future__ import annotations

import math
from struct import Struct
from typing import Any

import numpy as np

from semnav_env.mind.grounding.clause_progress import GOAL_RECORD
from semnav_features.frames import MOST_CONTACTS, FloatArray, Pose, Twist, wrap_angle

ESTIMATE = np.dtype(
    [("contact_count", "i8"), ("odometry", "f8", 3), ("seconds", "f8")]
    + [(name, "f8", 3) for name in ("velocity", "pose", "last_odometry", "look_pose")]
    + [(name, "i8") for name in ("scan", "clause", "look_scan", "look_walls", "look_doors")]
    + [("contacts", "f8", (MOST_CONTACTS, 3)), ("corrects_drift", "?")]
    + [("observes_features", "?"), ("target", GOAL_RECORD)]
)
"""A robot's estimate of its state; shape (1,). Poses are (x, y, heading) in metres and radians,
odometry frame.

Set when a command is begun:
    corrects_drift: whether walls that are seen again correct the odometry.
    observes_features: whether features are observed. Otherwise corners and corridors, which a
        belief does not need, are not looked for.

Set before each scan:
    contact_count: how many `contacts` are given, the first ones.
    contacts: where the body touches what cannot move, each a `Contact`, robot frame.
    odometry: pose by dead reckoning.
    seconds: since the scan before.
    velocity: of the robot, a `Twist`.

Written by `understand`:
    pose: believed pose.
    last_odometry: the odometry that `pose` belongs to.
    scan: number of the scan, from 0.

Written where an event calls for it:
    clause, target: as in `Belief`.
    look_pose, look_scan: from where, and at which scan, the clause was last grounded.
    look_walls, look_doors: how many walls and doors counted then.
"""

SENSED = Struct("q7d")
"""The first fields of an estimate: count of contacts, odometry, seconds and velocity."""

BELIEVED = Struct("6d")
"""The fields from `velocity` on: velocity and believed pose."""

BELIEVED_OFFSET = ESTIMATE.fields["velocity"][1] if ESTIMATE.fields else 0


def pose_in(field: FloatArray) -> Pose:
    """A pose that is a field of an estimate."""
    x, y, heading = field.tolist()
    return x, y, heading


def mean_velocity(estimate: Any, after: Pose, seconds: float) -> Twist:
    """Mean velocity since the last scan, in the robot frame at that scan; 0 at the first scan.

    Args:
        estimate: an entry of dtype `ESTIMATE`.
        after: odometry now.
        seconds: since the last scan.
    """
    if estimate["scan"] < 0:
        return 0.0, 0.0, 0.0
    before = pose_in(estimate["odometry"])
    x, y = after[0] - before[0], after[1] - before[1]
    c, s = math.cos(before[2]), math.sin(before[2])
    yaw = wrap_angle(after[2] - before[2])
    return (c * x + s * y) / seconds, (c * y - s * x) / seconds, yaw / seconds
