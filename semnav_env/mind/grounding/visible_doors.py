"""Finds the doors that are in view from a pose."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from semnav_env.mind.grounding.door_geometry import lies_across
from semnav_env.rules import GroundingRules
from semnav_features.corridor import doorway_at
from semnav_features.frames import FloatArray, Pose, to_local
from semnav_features.kernels.compiling import kernel
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
    seen = in_view(ends_of(doors), ends_of(scene.walls), pose[0], pose[1])
    return [door for door, is_seen in zip(doors, seen.tolist(), strict=True) if is_seen]


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


@kernel
def in_view(openings: FloatArray, walls: FloatArray, x: float, y: float) -> NDArray[np.bool_]:
    """Whether each opening is in view from a place, behind no wall and through no other opening.

    Args:
        openings: x and y of both ends, metres, shape (n, 4).
        walls: the same, shape (m, 4).
        x: of the place, metres.
        y: the same.

    Returns:
        Shape (n,).
    """
    seen = np.zeros(len(openings), np.bool_)
    for k in range(len(openings)):
        door = openings[k]
        for share in VIEW_SAMPLES:
            there_x = x + FREE_SHARE * (door[0] + share * (door[2] - door[0]) - x)
            there_y = y + FREE_SHARE * (door[1] + share * (door[3] - door[1]) - y)
            hidden = _is_crossed(walls, -1, x, y, there_x, there_y)
            if not hidden and not _is_crossed(openings, k, x, y, there_x, there_y):
                seen[k] = True
                break
    return seen


@kernel
def _is_crossed(
    segments: FloatArray, but: int, x: float, y: float, there_x: float, there_y: float
) -> bool:
    """Whether the line from (x, y) to another place crosses a segment other than number `but`.

    It does if the ends of the segment lie on different sides of the line, and both places on
    different sides of the segment.
    """
    dx, dy = there_x - x, there_y - y
    for k in range(len(segments)):
        x1, y1, x2, y2 = segments[k, 0], segments[k, 1], segments[k, 2], segments[k, 3]
        first, last = dx * (y1 - y) - dy * (x1 - x), dx * (y2 - y) - dy * (x2 - x)
        if k == but or not first * last < 0.0:
            continue
        here = (x2 - x1) * (y - y1) - (y2 - y1) * (x - x1)
        there = (x2 - x1) * (there_y - y1) - (y2 - y1) * (there_x - x1)
        if here * there < 0.0:
            return True
    return False
