"""Where a way through a door leads, and which doors are the same."""

from __future__ import annotations

import math

from numba.extending import register_jitable

from semnav_agents.planning.aim import Aim
from semnav_agents.planning.doorway import THROUGH_TOLERANCE, pose_behind
from semnav_env.approach.door_side import doorway_frame, jambs_from
from semnav_features.frames import Point, Pose, compose, middle_of, to_parent
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.exact_hypot import exact_hypot

for _function in (doorway_frame, jambs_from):
    register_jitable(_function)

POSE_TOLERANCE, POSE_HEADING_TOLERANCE = 0.10, 0.15
"""Distance and heading error at which a pose before or behind a door is reached, metres and
radians."""

SAME_DOOR_DISTANCE = 0.5
"""Distance of their middles below which two doors are the same, metres: a door is wider."""

MAX_OBSTACLE_DISTANCE = 2.5
"""Distance from the middle of a door within which obstacles matter to the poses, metres."""


@kernel
def jambs_facing(start: Point, end: Point, outward: float) -> tuple[Point, Point]:
    """The right and the left jamb for a robot that passes a door in a direction, radians."""
    x, y = middle_of(start, end)
    return jambs_from(start, end, (x - math.cos(outward), y - math.sin(outward)))


@kernel
def aim_through(right: Point, left: Point, has_pose: bool, pose: Pose, axle: float) -> Aim:
    """Where a way through a door leads next.

    Args:
        right: the jamb to the right of the robot, metres.
        left: the jamb to its left.
        has_pose: whether the way leads to a pose next, and not to the region behind the door.
        pose: that pose, in the frame of the doorway.
        axle: x of the axle in the robot frame, metres.
    """
    frame = doorway_frame(right, left)
    if has_pose:
        x, y, heading = compose(frame, pose)
        return Aim(x, y, heading, POSE_TOLERANCE, POSE_HEADING_TOLERANCE, False, axle)
    x, y, heading = pose_behind(right, left, to_parent(frame, (-1.0, 0.0)))
    return Aim(x, y, heading, THROUGH_TOLERANCE, 0.0, True, axle)


@kernel
def is_same_door(middle: Point, other: Point) -> bool:
    """Whether doors with these middles are the same one."""
    return exact_hypot(middle[0] - other[0], middle[1] - other[1]) <= SAME_DOOR_DISTANCE


@kernel
def ends_at_door(end: Point, middle: Point) -> bool:
    """Whether a path that ends there shows that there is no way through the door.

    A path that ends far from the door still leads nearer to it, and is driven.
    """
    return exact_hypot(end[0] - middle[0], end[1] - middle[1]) <= MAX_OBSTACLE_DISTANCE
