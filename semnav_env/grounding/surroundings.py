"""What a robot stands among: the doors in view around it, and those that face a place."""

from __future__ import annotations

import math

import numpy as np

from semnav_env.features.corridor import doorway_at
from semnav_env.features.frames import FloatArray, Point, Pose, to_local, wrap_angle
from semnav_env.features.scene import Door, Scene, ends_of

SHARES = (0.2, 0.5, 0.8)
"""Where in an opening one looks to see whether it is in view, as shares of its width."""

FARTHER = 0.3
"""So far behind the line of another door a door is in another wall, metres."""

LEADS_OUT = 1.0
"""So far behind a door that leads out of a room one can go at least, metres."""

SELDOM = 4
"""A door that was seen so many times less often than another one is doubtful beside it."""

SHORT_OF = 0.98
"""How much of the way to it must be free: it begins in a wall."""

STILL_BEFORE = 0.25
"""Who is farther before a doorway, and faces it, does not stand in it, metres."""

SAME = 0.5
"""Doors whose middles are nearer than this are one, metres."""


def doors_around(scene: Scene, pose: Pose, own: Door | None = None) -> list[Door]:
    """The doors that are in view from a pose, behind no wall and through no other door.

    Args:
        scene: walls and doors.
        pose: from where, in the scene's frame.
        own: a door that one stands in: it is not in view, and in nobody's way.
    """
    doors = [door for door in scene.doors if own is None or not _is_same(door, own)]
    walls, openings = ends_of(scene.walls), ends_of(doors)
    seen = []
    for k, door in enumerate(doors):
        between = np.vstack((walls, np.delete(openings, k, axis=0)))
        shares = np.array(SHARES)[:, None]
        places = np.array(door.start) + shares * np.subtract(door.end, door.start)
        reach = np.array(pose[:2]) + SHORT_OF * (places - np.array(pose[:2]))
        if any(not _is_crossed(between, pose, place) for place in reach):
            seen.append(door)
    return seen


def own_doorway(scene: Scene, pose: Pose) -> Door | None:
    """The doorway that one stands in or has just come through; None if there is none."""
    door = doorway_at(scene, pose)
    if door is None or to_local(pose, door.midpoint)[0] > STILL_BEFORE:
        return None
    return door


def doors_across(scene: Scene, pose: Pose, own: Door | None = None) -> list[Door]:
    """The doors ahead of a pose and in view that lie across its heading.

    Args:
        scene: walls and doors.
        pose: from where and which way, in the scene's frame.
        own: a door that one stands in; it does not count.
    """
    return [door for door in doors_around(scene, pose, own) if _lies_across(door, pose)]


def doors_of_the_room(doors: list[Door], scene: Scene, pose: Pose) -> list[Door]:
    """Of the doors that a robot has made out around it those that lead out of the room.

    What parts a room from its surroundings may not have been seen as a whole yet, so that doors
    further on are in view: a door behind the line of another one is not the room's. Nor is a gap
    between pieces of furniture, through which one sees a wall close by, or nothing where one sees
    out by another door; nor what was seen far less often than another door.
    """
    depths = [_depth_behind(door, scene, pose) for door in doors]
    out = [door for door, depth in zip(doors, depths, strict=True) if depth >= LEADS_OUT]
    dark = [door for door, depth in zip(doors, depths, strict=True) if math.isnan(depth)]
    doors = out or dark or doors
    most = max((door.sightings for door in doors), default=0)
    often = [door for door in doors if SELDOM * door.sightings >= most]
    return [door for door in often if not any(_lies_behind(door, other, pose) for other in often)]


def bearing(pose: Pose, door: Door) -> float:
    """How far a door's middle lies off the way straight ahead of a pose, radians, 0 to pi."""
    return abs(wrap_angle(heading_between(pose[:2], door.midpoint) - pose[2]))


def shared_width(door: Door, pose: Pose, half: float) -> float:
    """How much of a door lies straight ahead of what reaches `half` to either side of a pose.

    In metres; negative where the door lies beside that.
    """
    sides = to_local(pose, door.start)[1], to_local(pose, door.end)[1]
    return min(max(sides), half) - max(min(sides), -half)


def heading_through(door: Door, about: float) -> float:
    """The heading at right angles to a door that is nearest to another one, radians."""
    normal = math.atan2(door.end[1] - door.start[1], door.end[0] - door.start[0]) + math.pi / 2
    return wrap_angle(normal if math.cos(normal - about) > 0 else normal + math.pi)


def heading_between(start: Point, end: Point) -> float:
    """The heading from one place to another, radians."""
    return math.atan2(end[1] - start[1], end[0] - start[0])


def _lies_across(door: Door, pose: Pose) -> bool:
    """Whether one who goes on along a heading comes to a door and not along it."""
    (ax, ay), (bx, by) = to_local(pose, door.start), to_local(pose, door.end)
    return ax + bx > 0.0 and abs(bx - ax) < abs(by - ay)


def _is_same(door: Door, other: Door) -> bool:
    return math.dist(door.midpoint, other.midpoint) < SAME


def _depth_behind(door: Door, scene: Scene, pose: Pose) -> float:
    """How far behind a door the next wall or door is that one sees through it, metres; or NaN.

    The median of a few looks; those that meet nothing known say nothing.
    """
    others = [other for other in scene.doors if other is not door]
    solid = np.vstack((ends_of(scene.walls), ends_of(others)))
    across = heading_through(door, heading_between(pose[:2], door.midpoint))
    depths = []
    for share in SHARES:
        place = np.array(door.start) + share * np.subtract(door.end, door.start)
        heading = heading_between(pose[:2], (float(place[0]), float(place[1])))
        seen = _distance_to(solid, place + 0.01 * (place - pose[:2]), heading)
        depths += [seen * math.cos(heading - across)] if math.isfinite(seen) else []
    return float(np.median(depths)) if depths else math.nan


def _distance_to(segments: FloatArray, place: FloatArray, heading: float) -> float:
    """How far from a place the first of the segments, shape (n, 4), is; infinite if none is."""
    c, s = math.cos(heading), math.sin(heading)
    x, y = segments[:, (0, 2)] - place[0], segments[:, (1, 3)] - place[1]
    along, aside = c * x + s * y, c * y - s * x
    meets = aside[:, 0] * aside[:, 1] < 0.0
    share = aside[meets, 0] / (aside[meets, 0] - aside[meets, 1])
    distance = along[meets, 0] + share * (along[meets, 1] - along[meets, 0])
    return float(distance[distance > 0.0].min(initial=math.inf))


def _lies_behind(door: Door, other: Door, pose: Pose) -> bool:
    """Whether one door is on the far side of the line of another."""
    (ax, ay), (bx, by) = other.start, other.end
    dx, dy = (bx - ax) / other.width, (by - ay) / other.width
    here = dx * (pose[1] - ay) - dy * (pose[0] - ax)
    there = dx * (door.midpoint[1] - ay) - dy * (door.midpoint[0] - ax)
    return here * there < 0.0 and abs(there) > FARTHER


def _is_crossed(segments: FloatArray, pose: Pose, place: FloatArray) -> bool:
    """Whether the line from a pose to a place meets one of the segments, shape (n, 4)."""
    x, y = pose[0], pose[1]
    dx, dy = place - (x, y)
    first = dx * (segments[:, 1] - y) - dy * (segments[:, 0] - x)
    last = dx * (segments[:, 3] - y) - dy * (segments[:, 2] - x)
    rx, ry = segments[:, 2] - segments[:, 0], segments[:, 3] - segments[:, 1]
    here = rx * (y - segments[:, 1]) - ry * (x - segments[:, 0])
    there = rx * (place[1] - segments[:, 1]) - ry * (place[0] - segments[:, 0])
    return bool(((first * last < 0.0) & (here * there < 0.0)).any())
