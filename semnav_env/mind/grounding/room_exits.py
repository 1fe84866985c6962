"""Finds the doors in view that lead out of the room of the robot."""

from __future__ import annotations

import math

import numpy as np

from semnav_env.mind.grounding.door_geometry import heading_through, lies_behind
from semnav_env.mind.grounding.visible_doors import doors_around, places_in
from semnav_env.rules import GroundingRules
from semnav_features.frames import FloatArray, Pose, heading_between
from semnav_features.scene import Door, Scene, ends_of

BEHIND_OPENING = 0.01
"""Share of the distance to an opening by which a ray through it begins behind it, so that the wall
of the opening does not count."""

SURVEY_DEPTH = 0.3
"""Distance behind the middle of a gap at which its surroundings are checked, metres: more than the
thickness of walls."""

SURVEY_HEADINGS = math.pi * ((np.arange(30) + 0.5) / 30 - 0.5)
"""Directions that are checked there, from straight ahead, radians: 6 degrees apart."""

OPEN_DISTANCE = 3.0
"""A direction is open if nothing is known up to this distance, metres: more than a niche is
wide."""

MIN_OPEN_SHARE = 0.1
"""Least share of open directions behind a door; a space that is closed all around is a part of the
room. No true exit had less, in half of the episodes of `train` that begin in a room."""

SIMILAR_SHARE = 0.05
"""Doors whose shares of open directions differ by less than this are equally open: one
direction."""


def room_exits(
    doors: list[Door], scene: Scene, pose: Pose, rules: GroundingRules = GroundingRules()
) -> list[Door]:
    """The doors around a pose that lead out of the room, in an incomplete scene.

    The walls of the room may not have been seen as a whole yet, so doors farther on are in view. A
    door behind the line of another door is not the room's. A gap between pieces of furniture is no
    exit: it shows a wall close by, or nothing where another door shows the outside. What was seen
    far less often than another door is none either. Of what is left the most open one leads out
    (see `open_share`).
    """
    depths = [_depth_behind(door, scene, pose) for door in doors]
    pairs = list(zip(doors, depths, strict=True))
    out = [door for door, depth in pairs if depth >= rules.leading_out_depth]
    dark = [door for door, depth in pairs if math.isnan(depth)]
    doors = out or dark or doors
    most = max((door.sightings for door in doors), default=0)
    often = [door for door in doors if rules.sightings_ratio * door.sightings >= most]
    least = rules.other_wall_distance
    exits = [door for door in often if not any(lies_behind(door, o, pose, least) for o in often)]
    if len(exits) < 2:
        return exits
    shares = [open_share(door, scene, pose) for door in exits]
    least = max(shares) - SIMILAR_SHARE
    return [door for door, share in zip(exits, shares, strict=True) if share > least]


def without_gaps(
    scene: Scene, pose: Pose, rules: GroundingRules = GroundingRules()
) -> tuple[Scene, list[Door]]:
    """A scene without gaps between pieces of furniture, and its doors in view from a pose.

    Walls close the space behind such a gap, so it is a part of the room; doors that are seen
    through the gap belong to the room as well.
    """
    while True:
        around = doors_around(scene, pose, rules=rules)
        shut = [door for door in around if open_share(door, scene, pose) < MIN_OPEN_SHARE]
        if not shut:
            return scene, around
        scene = Scene(scene.walls, tuple(door for door in scene.doors if door not in shut))


def open_share(door: Door, scene: Scene, pose: Pose) -> float:
    """The share of open directions behind a door, seen from a pose.

    Behind a true door is a corridor or another room, of which little is known: most directions are
    open. Behind a gap between pieces of furniture are the walls of the room itself.
    """
    if door.width == 0.0:
        return 1.0
    through = heading_through(door, heading_between(pose[:2], door.midpoint))
    x, y = door.midpoint
    c, s = math.cos(through), math.sin(through)
    behind = np.array((x + SURVEY_DEPTH * c, y + SURVEY_DEPTH * s))
    far = distances_to(_solid_but(door, scene), behind, through + SURVEY_HEADINGS)
    return float(np.count_nonzero(far > OPEN_DISTANCE)) / len(far)


def _depth_behind(door: Door, scene: Scene, pose: Pose) -> float:
    """Distance behind a door to the next wall or door that is seen through it, metres; or NaN.

    It is the median over a few rays; rays that meet nothing known do not count.
    """
    solid = _solid_but(door, scene)
    across = heading_through(door, heading_between(pose[:2], door.midpoint))
    depths = []
    for place in places_in(door):
        heading = heading_between(pose[:2], (float(place[0]), float(place[1])))
        begin = place + BEHIND_OPENING * (place - pose[:2])
        seen = float(distances_to(solid, begin, np.array([heading]))[0])
        depths += [seen * math.cos(heading - across)] if math.isfinite(seen) else []
    return float(np.median(depths)) if depths else math.nan


def _solid_but(door: Door, scene: Scene) -> FloatArray:
    """The walls of a scene and its doors except one, shape (n, 4)."""
    others = [other for other in scene.doors if other is not door]
    return np.vstack((ends_of(scene.walls), ends_of(others)))


def distances_to(segments: FloatArray, place: FloatArray, headings: FloatArray) -> FloatArray:
    """Distances along each heading to the first of the segments, shape (n, 4), or inf.

    In a frame that looks along a heading, a segment is met where its ends lie on different sides
    of the x axis; `share` is where on the segment, by similar triangles.

    Args:
        segments: x and y of both ends, metres.
        place: from which to look, shape (2,), or one for each heading, shape (k, 2).
        headings: radians, shape (k,).
    """
    c, s = np.cos(headings)[:, None], np.sin(headings)[:, None]
    x, y = place[..., 0, None], place[..., 1, None]
    x1, y1, x2, y2 = segments[:, 0] - x, segments[:, 1] - y, segments[:, 2] - x, segments[:, 3] - y
    aside1, aside2 = c * y1 - s * x1, c * y2 - s * x2
    meets = aside1 * aside2 < 0.0
    share = aside1 / np.where(meets, aside1 - aside2, 1.0)
    along = (1.0 - share) * (c * x1 + s * y1) + share * (c * x2 + s * y2)
    distance: FloatArray = np.where(meets & (along > 0.0), along, np.inf)
    nearest: FloatArray = distance.min(axis=1, initial=np.inf)
    return nearest
