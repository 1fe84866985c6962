"""Poses before and after a door (point planning: Mes 2021, sections 2.1 and 5)."""

from __future__ import annotations

import math

from semnav_env.agents.planning.planner import Target
from semnav_env.features.frames import Point, Pose
from semnav_env.features.scene import Door

BEFORE = AFTER = 1.0
"""Metres between the door and the robot's centre (Mes 2021, section 2.1)."""


def poses_through(
    door: Door, approach: Point, before: float = BEFORE, after: float = AFTER
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


def target_before(door: Door, approach: Point) -> Target:
    """Stand before the door on its axis, facing it."""
    return Target(poses_through(door, approach)[0], 0.15, 0.15)


def target_behind(door: Door, approach: Point) -> Target:
    """Be wholly through the door, in any heading: a leaf may bar the way along its axis."""
    return Target(poses_through(door, approach, after=1.3)[1], 0.5, None)
