"""Targets behind doors, and barriers across other doors (point planning: Mes 2021, 2.1 and 5)."""

from __future__ import annotations

import math

import numpy as np

from semnav_agents.planning.obstacles import point_counts, points_of_segments
from semnav_agents.planning.planner import DriveTarget
from semnav_env.approach.door_side import MIN_DOOR_WIDTH
from semnav_env.robots import RobotSpec
from semnav_features.frames import (
    FloatArray,
    Point,
    Pose,
    heading_between,
    middle_of,
    points_to_parent,
    to_local,
    wrap_angle,
)
from semnav_features.kernels.compiling import kernel
from semnav_features.scene import Door

DOORWAY_DISTANCE = 0.1
"""Distance from the footprint to a doorway's line below which the robot stands in it, metres."""

THROUGH_DISTANCE, THROUGH_TOLERANCE = 1.3, 0.5
"""Distance from the door and radius of the region in which a robot is through it, metres:
everywhere in it a robot 1.1 m long has left the doorway."""


ROOM_MARGIN = 1.5
"""Space that a path may take behind a door, beside the jambs and around the target, metres: that of
a body in any heading, and the radius of the region in which it is through."""


def barriers_across(doors: FloatArray, robot: RobotSpec) -> FloatArray:
    """Points that block the doorways of other doors, except one in which the robot stands.

    Args:
        doors: x and y of both jambs, metres, robot frame, shape (n, 4).
        robot: gives the footprint.

    Returns:
        shape (N, 2), robot frame.
    """
    points = points_of_segments(doors)
    reach = np.array((robot.length, robot.width)) / 2 + DOORWAY_DISTANCE
    owner = np.repeat(np.arange(len(doors)), point_counts(doors))
    stood_in = owner[(np.abs(points) < reach).all(axis=1)]
    others: FloatArray = points[~np.isin(owner, stood_in)]
    return others


def room_behind(gate: tuple[Point, Point], target: Pose) -> FloatArray:
    """Points along the walls of a room behind a gate that is open at the gate alone.

    Unseen space counts as free; these walls prevent a path through the wall beside the door.

    Args:
        gate: the jambs, metres.
        target: a pose behind them, in the same frame.

    Returns:
        shape (N, 2), in that frame.
    """
    (x, y), end = gate
    frame = x, y, heading_between(gate[0], end)
    width, (along, behind) = math.dist(gate[0], end), to_local(frame, target[:2])
    first, last = min(0.0, along) - ROOM_MARGIN, max(width, along) + ROOM_MARGIN
    inside = behind + math.copysign(ROOM_MARGIN, behind)
    corners = [(0.0, 0.0), (first, 0.0), (first, inside), (last, inside), (last, 0.0), (width, 0.0)]
    ends = points_to_parent(frame, np.array(corners))
    return points_of_segments(np.hstack((ends[:-1], ends[1:])))


def target_behind(door: Door, approach: Point) -> DriveTarget:
    """A target completely behind the door, with any heading: a leaf may block the door's axis.

    Args:
        door: its two jambs.
        approach: a place on the side from which the robot comes, metres.

    Raises:
        ValueError: the jambs are the same point.
    """
    if door.width < MIN_DOOR_WIDTH:
        raise ValueError(f"the door at {door.start} has no width; its jambs must be two points")
    behind = pose_behind(door.start, door.end, approach)
    return DriveTarget(behind, THROUGH_TOLERANCE, None, gate=(door.start, door.end))


@kernel
def pose_behind(start: Point, end: Point, approach: Point) -> Pose:
    """The pose `THROUGH_DISTANCE` behind a door, heading away from where the robot comes from."""
    heading = heading_between(start, end) + math.pi / 2
    x, y = middle_of(start, end)
    c, s = math.cos(heading), math.sin(heading)
    if (approach[0] - x) * c + (approach[1] - y) * s > 0:  # that axis heads back to the robot
        heading, c, s = wrap_angle(heading + math.pi), -c, -s
    return x + THROUGH_DISTANCE * c, y + THROUGH_DISTANCE * s, wrap_angle(heading)
