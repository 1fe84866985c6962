"""Finds the door at the back of a niche, whose mouth looks like a door, too."""

from __future__ import annotations

import math
from dataclasses import replace

from semnav_env.mind.grounding.counted_doors import CountedDoor
from semnav_features.frames import Pose, heading_between, to_local
from semnav_features.scene import Door, Scene, Wall

NICHE_DEPTH = 1.1
"""Deepest niche, metres: less than the width of nearly all corridors."""

LEAST_DEPTH = 0.25
"""Nearer doors are one door, seen twice, metres."""

MOST_ASIDE, MOST_TURNED = 0.4, math.sin(math.radians(15.0))
"""How far the middle of the door may lie beside that of the mouth, metres, and the sine of the
angle between them."""

SIDE_SHARE = 0.5
"""Least share of the depth along which a wall leads from the mouth to the door."""


def at_the_back(mouth: CountedDoor, scene: Scene) -> CountedDoor:
    """The door at the back of the niche of which `mouth` is the mouth; without one, `mouth`.

    Two doors that face each other across a corridor look alike but for the niche's side: a wall
    leads along it from the one to the other.
    """
    line = mouth.pose(0.0)
    for door in scene.doors:
        depth, aside = to_local(line, door.midpoint)
        turned = abs(math.cos(heading_between(door.start, door.end) - line[2]))
        behind = LEAST_DEPTH < depth < NICHE_DEPTH and abs(aside) < MOST_ASIDE
        if behind and turned < MOST_TURNED and _has_a_side(line, mouth.door, depth, scene):
            return replace(mouth, door=door)
    return mouth


def _has_a_side(line: Pose, mouth: Door, depth: float, scene: Scene) -> bool:
    """Whether a wall leads along a side of the niche, which is about as wide as its mouth."""
    farthest = mouth.width / 2 + MOST_ASIDE
    sides = (_along_side(line, wall, depth, farthest) for wall in scene.walls)
    return max(sides, default=0.0) >= SIDE_SHARE * depth


def _along_side(line: Pose, wall: Wall, depth: float, farthest: float) -> float:
    """Length of the part of a wall that leads from the mouth inwards, metres; 0 if it does not."""
    (ax, ay), (bx, by) = to_local(line, wall.start), to_local(line, wall.end)
    inwards = abs(by - ay) < MOST_TURNED * wall.length and max(abs(ay), abs(by)) < farthest
    return max(0.0, min(max(ax, bx), depth) - max(min(ax, bx), 0.0)) if inwards else 0.0
