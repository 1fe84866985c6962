"""Geometry of doors relative to a pose and to each other."""

from __future__ import annotations

import math

from semnav_features.frames import Pose, heading_between, to_local, wrap_angle
from semnav_features.scene import Door


def heading_through(door: Door, about: float) -> float:
    """The normal of a door that is nearest to a given heading, radians."""
    normal = heading_between(door.start, door.end) + math.pi / 2
    return wrap_angle(normal if math.cos(normal - about) > 0 else normal + math.pi)


def bearing(pose: Pose, door: Door) -> float:
    """The angle between a pose's heading and the direction to a door's middle, 0 to pi radians."""
    return abs(wrap_angle(heading_between(pose[:2], door.midpoint) - pose[2]))


def shared_width(door: Door, pose: Pose, half: float) -> float:
    """Overlap of a door with the strip ahead of a pose that reaches `half` to both sides, metres.

    The overlap is negative if the door lies beside the strip.
    """
    sides = to_local(pose, door.start)[1], to_local(pose, door.end)[1]
    return min(max(sides), half) - max(min(sides), -half)


def lies_across(door: Door, pose: Pose) -> bool:
    """Whether a door lies ahead and more across a pose's heading than along it."""
    (ax, ay), (bx, by) = to_local(pose, door.start), to_local(pose, door.end)
    return ax + bx > 0.0 and abs(bx - ax) < abs(by - ay)


def lies_behind(door: Door, other: Door, pose: Pose, least: float) -> bool:
    """Whether a door is on the far side of the line of another one, by more than `least` metres.

    `here` and `there` are signed distances from that line: of different signs on its two sides.

    Raises:
        ValueError: the other door has no width, so it has no line.
    """
    if other.width == 0.0:
        raise ValueError(f"the door at {other.start} has no width; its jambs must be two points")
    (ax, ay), (bx, by) = other.start, other.end
    dx, dy = (bx - ax) / other.width, (by - ay) / other.width
    here = dx * (pose[1] - ay) - dy * (pose[0] - ax)
    there = dx * (door.midpoint[1] - ay) - dy * (door.midpoint[0] - ax)
    return here * there < 0.0 and abs(there) > least
