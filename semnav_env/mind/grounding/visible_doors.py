"""Finds the doors that are in view from a pose."""

from __future__ import annotations

import math

import numpy as np

from semnav_env.mind.grounding.door_geometry import lies_across
from semnav_env.rules import GroundingRules
from semnav_features.corridor import doorway_at
from semnav_features.frames import FloatArray, Pose, to_local
from semnav_features.scene import Door, Scene, ends_of

VIEW_SAMPLES = (0.2, 0.5, 0.8)
"""Places in an opening that are tested for being in view, as shares of its width: one of them is
enough, for a jamb may be hidden."""

FREE_SHARE = 0.98
"""Share of the distance to such a place that must be free; the rest may lie in the wall of the
door."""


def doors_around(
    scene: Scene, pose: Pose, own: Door | None = None, rules: GroundingRules = GroundingRules()
) -> list[Door]:
    """The doors that are in view from a pose, behind no wall and through no other door.

    Args:
        scene: walls and doors.
        pose: pose of the view, in the scene's frame.
        own: the door in which the robot stands: it is not in view, and hides nothing.
        rules: distances.
    """
    doors = [door for door in scene.doors if own is None or not _is_same(door, own, rules)]
    walls, openings = ends_of(scene.walls), ends_of(doors)
    seen = []
    for k, door in enumerate(doors):
        between = np.vstack((walls, np.delete(openings, k, axis=0)))
        places = places_in(door)
        reach = np.array(pose[:2]) + FREE_SHARE * (places - np.array(pose[:2]))
        if any(not _is_crossed(between, pose, place) for place in reach):
            seen.append(door)
    return seen


def doors_across(scene: Scene, pose: Pose, own: Door | None, rules: GroundingRules) -> list[Door]:
    """The doors ahead of a pose and in view that lie across its heading; see `doors_around`."""
    return [door for door in doors_around(scene, pose, own, rules) if lies_across(door, pose)]


def own_doorway(scene: Scene, pose: Pose, rules: GroundingRules) -> Door | None:
    """The doorway in which a robot stands, or through which it has just come; or None."""
    door = doorway_at(scene, pose)
    if door is None or to_local(pose, door.midpoint)[0] > rules.doorway_depth:
        return None
    return door


def places_in(door: Door) -> FloatArray:
    """The `VIEW_SAMPLES` of an opening, shape (3, 2), metres."""
    shares = np.array(VIEW_SAMPLES)[:, None]
    places: FloatArray = np.array(door.start) + shares * np.subtract(door.end, door.start)
    return places


def _is_same(door: Door, other: Door, rules: GroundingRules) -> bool:
    return math.dist(door.midpoint, other.midpoint) < rules.same_door_distance


def _is_crossed(segments: FloatArray, pose: Pose, place: FloatArray) -> bool:
    """Whether the line from a pose to a place crosses one of the segments, shape (n, 4).

    It does if the ends of the segment lie on different sides of the line, and the pose and the
    place on different sides of the segment.
    """
    x, y = pose[0], pose[1]
    dx, dy = place - (x, y)
    first = dx * (segments[:, 1] - y) - dy * (segments[:, 0] - x)
    last = dx * (segments[:, 3] - y) - dy * (segments[:, 2] - x)
    rx, ry = segments[:, 2] - segments[:, 0], segments[:, 3] - segments[:, 1]
    here = rx * (y - segments[:, 1]) - ry * (x - segments[:, 0])
    there = rx * (place[1] - segments[:, 1]) - ry * (place[0] - segments[:, 0])
    return bool(((first * last < 0.0) & (here * there < 0.0)).any())
