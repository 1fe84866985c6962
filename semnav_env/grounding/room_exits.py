"""Which of the doors in view lead out of the room that a robot is in."""

from __future__ import annotations

import math

import numpy as np

from semnav_env.features.frames import FloatArray, Pose, heading_between
from semnav_env.features.scene import Door, Scene, ends_of
from semnav_env.grounding.door_geometry import heading_through, lies_behind
from semnav_env.grounding.visible_doors import places_in
from semnav_env.rules import GroundingRules

BEHIND_OPENING = 0.01
"""Share of the way to an opening by which a look through it begins behind it, so that its own wall
does not count."""


def room_exits(
    doors: list[Door], scene: Scene, pose: Pose, rules: GroundingRules = GroundingRules()
) -> list[Door]:
    """Those of the doors around a pose that lead out of the room, on a scene that is incomplete.

    The walls of the room may not have been seen as a whole yet, so doors farther on are in view. A
    door behind the line of another door is not the room's. A gap between pieces of furniture is no
    exit: it shows a wall close by, or nothing where another door shows the outside. What was seen
    far less often than another door is none either.
    """
    depths = [_depth_behind(door, scene, pose) for door in doors]
    pairs = list(zip(doors, depths, strict=True))
    out = [door for door, depth in pairs if depth >= rules.leading_out_depth]
    dark = [door for door, depth in pairs if math.isnan(depth)]
    doors = out or dark or doors
    most = max((door.sightings for door in doors), default=0)
    often = [door for door in doors if rules.sightings_ratio * door.sightings >= most]
    least = rules.other_wall_distance
    return [door for door in often if not any(lies_behind(door, o, pose, least) for o in often)]


def _depth_behind(door: Door, scene: Scene, pose: Pose) -> float:
    """How far behind a door the next wall or door is that is seen through it, metres; or NaN.

    The median of a few looks; those that meet nothing known say nothing.
    """
    others = [other for other in scene.doors if other is not door]
    solid = np.vstack((ends_of(scene.walls), ends_of(others)))
    across = heading_through(door, heading_between(pose[:2], door.midpoint))
    depths = []
    for place in places_in(door):
        heading = heading_between(pose[:2], (float(place[0]), float(place[1])))
        seen = _distance_to(solid, place + BEHIND_OPENING * (place - pose[:2]), heading)
        depths += [seen * math.cos(heading - across)] if math.isfinite(seen) else []
    return float(np.median(depths)) if depths else math.nan


def _distance_to(segments: FloatArray, place: FloatArray, heading: float) -> float:
    """Distance from a place along a heading to the first of the segments, shape (n, 4), or inf.

    In a frame that looks along the heading, a segment is met where its ends lie on different sides
    of the x axis; `share` is where on the segment, by similar triangles.
    """
    c, s = math.cos(heading), math.sin(heading)
    x, y = segments[:, (0, 2)] - place[0], segments[:, (1, 3)] - place[1]
    along, aside = c * x + s * y, c * y - s * x
    meets = aside[:, 0] * aside[:, 1] < 0.0
    share = aside[meets, 0] / (aside[meets, 0] - aside[meets, 1])
    distance = along[meets, 0] + share * (along[meets, 1] - along[meets, 0])
    return float(distance[distance > 0.0].min(initial=math.inf))
