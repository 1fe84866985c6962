"""What compiled code must know of robots to drive them on while nothing happens.

A robot cruises while it follows a free path to a target that stays where it is. The kernels of
`cruise_kernels` then decide for all robots in one call. Where anything else happens they change
nothing, and Python decides: it reads the record first (`Pilot.take`) and writes it afterwards
(`Pilot.put`).
"""

from __future__ import annotations

from typing import Any

import numpy as np

from semnav_agents.planning.aim import Aim
from semnav_agents.planning.planner import DriveTarget
from semnav_agents.planning.track import FollowerLimits, PathTrack
from semnav_env.mind.observations.layout import GOAL, GOAL_KINDS, ODOMETRY
from semnav_env.robots import RobotSpec

MAX_SAMPLES, MAX_LEGS = 2048, 256
"""Room for a path in a record: 80 m, at 4 cm a sample. A robot with a longer path never cruises."""

ODOMETRY_ROW = np.dtype([(name, "f4") for name in ODOMETRY.columns])
"""The "odometry" entry of an observation."""

GOAL_ROW = np.dtype(
    [("kinds", "f4", len(GOAL_KINDS))] + [(name, "f4") for name in GOAL.columns[len(GOAL_KINDS) :]]
)
"""The "goal" entry of an observation."""

CRUISE_COUNTS = np.dtype(
    [
        (name, "i8")
        for name in (
            *("ready", "step", "wait", "around", "backing", "yielded", "refusals"),
            *("leg", "sample", "pushed"),
            *("pace", "heeds_barriers", "backing_out", "knows_door", "aims_at_pose", "tries_ways"),
        )
    ]
)
"""Whether the robot cruises at all; then counters, which change while it does, and flags of its
`Driver`, `Pilot` and `ExitViaDoor`, by the names that they have there."""

CRUISE_TARGET = np.dtype([(name, "i8" if name == "any_heading" else "f8") for name in Aim._fields])
"""A target, as `Aim`."""

BODY = (
    *("length", "width", "axle", "max_speed", "max_sideways_speed", "max_turn_rate"),
    *("max_acceleration", "holonomic"),
)
"""What of a `RobotSpec` counts."""

CRUISE_BODY = np.dtype([(name, "f8") for name in (*BODY, "check_every", "tolerance")])
"""The body, and the settings of the driver that count while it cruises."""

CRUISE_LIMITS = np.dtype([(name, "f8") for name in FollowerLimits._fields])
"""Limits of the follower, as `FollowerLimits`."""

CRUISE = np.dtype(
    [
        ("counts", CRUISE_COUNTS),
        ("body", CRUISE_BODY),
        ("limits", CRUISE_LIMITS),
        ("last", "f8", 3),
        ("shift", "f8", 3),
        ("target", CRUISE_TARGET),
        ("door", "f8", 5),
        ("end", "f8", 2),
        ("complete", "i8"),
        ("travel", "f8"),
        ("margin", "f8"),
        ("samples", "i8"),
        ("leg_count", "i8"),
        ("legs", "i8", (MAX_LEGS, 3)),
        ("poses", "f8", (MAX_SAMPLES, 3)),
        ("centres", "f8", (MAX_SAMPLES, 3)),
        ("distance", "f8", MAX_SAMPLES),
        ("curvature", "f8", MAX_SAMPLES),
        ("speed", "f8", MAX_SAMPLES),
        ("left", "f8", MAX_SAMPLES),
        ("clearance", "f8", MAX_SAMPLES),
    ]
)
"""A cruising robot; shape (1,).

`last` are the last velocities, `shift` is the pose
of the path's frame, metres and radians. `target` is where the path leads. `door` is the middle
of the door that is passed, and the pose that is aimed at, in the frame of the door. The rest is the
path: its end, whether it leads to the target, its length, the margin that it keeps, and its samples
and legs as in `TrackArrays`; `centres` are the poses of the robot's centre there, `clearance` is
what the planner measured.
"""


def fits(track: PathTrack) -> bool:
    """Whether there is room for a path in a record."""
    return len(track.distance) <= MAX_SAMPLES and len(track.legs) <= MAX_LEGS


def put_path(record: Any, track: PathTrack, target: DriveTarget) -> None:
    """Write a path and the target to which it leads."""
    path, arrays, m = track.path, track.arrays, len(track.distance)
    record["target"] = tuple(target.aim(track.robot))
    record["limits"] = tuple(track.limits)
    record["complete"], record["margin"] = path.complete, path.margin
    record["travel"], record["end"] = path.length, path.end[:2]
    record["samples"], record["leg_count"] = m, len(arrays.legs)
    record["legs"][: len(arrays.legs)] = arrays.legs
    record["poses"][:m], record["centres"][:m] = arrays.poses, path.poses
    record["distance"][:m], record["speed"][:m] = arrays.distance, arrays.speed
    record["curvature"][: m - 1], record["left"][: m - 1] = arrays.curvature, arrays.left
    record["clearance"][:m] = path.clearance


def put_body(record: Any, robot: RobotSpec, check_every: int, tolerance: float) -> None:
    """Write the body, and the settings of its driver that count while it cruises."""
    body = record["body"]
    for name in BODY:
        body[name] = getattr(robot, name)
    body["check_every"], body["tolerance"] = check_every, tolerance
