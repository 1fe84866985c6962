"""Poses before and after a door (point planning: Mes 2021, sections 2.1 and 5)."""

from __future__ import annotations

import math

import numpy as np

from semnav_env.agents.planning.obstacles import points_of_segments
from semnav_env.agents.planning.planner import DriveTarget
from semnav_env.features.frames import FloatArray, Point, Pose
from semnav_env.features.scene import Door
from semnav_env.robots import RobotSpec

DOORWAY_DISTANCE = 0.1
"""Distance from the footprint to a doorway's line below which the robot stands in it, metres."""

DOOR_DISTANCE = 1.0
"""From the door to the robot's centre before and after it, metres (Mes 2021, section 2.1)."""

THROUGH_DISTANCE = 1.3
"""From the door to the middle of the region where a robot is through it, metres: at a tolerance of
0.5 m a robot 1.1 m long has left the doorway."""


def poses_through(
    door: Door, approach: Point, before: float = DOOR_DISTANCE, after: float = DOOR_DISTANCE
) -> tuple[Pose, Pose]:
    """Poses on the door's axis: before it, facing it, and behind it, heading away from it.

    Args:
        door: its two jambs.
        approach: a place on the side one comes from, metres.
        before: metres from the door to the centre.
        after: the same, behind it.

    Raises:
        ValueError: the jambs are the same point.
    """
    if door.width < 1e-6:
        raise ValueError(f"the door at {door.start} has no width; its jambs must be two points")
    heading = math.atan2(door.end[1] - door.start[1], door.end[0] - door.start[0]) + math.pi / 2
    x, y = door.midpoint
    c, s = math.cos(heading), math.sin(heading)
    if (approach[0] - x) * c + (approach[1] - y) * s > 0:
        heading, c, s = math.remainder(heading + math.pi, 2 * math.pi), -c, -s
    heading = math.remainder(heading, 2 * math.pi)
    return (x - before * c, y - before * s, heading), (x + after * c, y + after * s, heading)


def barriers_across(doors: FloatArray, robot: RobotSpec) -> FloatArray:
    """Points that bar the doorways of other doors, except one in which the robot stands.

    Args:
        doors: x and y of both jambs, metres, robot frame, shape (n, 4).
        robot: gives the footprint.

    Returns:
        shape (N, 2), robot frame.
    """
    lines = [points_of_segments(door[None]) for door in doors]
    reach = np.array((robot.length, robot.width)) / 2 + DOORWAY_DISTANCE
    others = [line for line in lines if not (np.abs(line) < reach).all(axis=1).any()]
    return np.concatenate([np.empty((0, 2)), *others])


def target_behind(door: Door, approach: Point) -> DriveTarget:
    """A target wholly through the door, in any heading: a leaf may bar the way along its axis."""
    behind = poses_through(door, approach, after=THROUGH_DISTANCE)[1]
    return DriveTarget(behind, 0.5, None, gate=(door.start, door.end))
