"""Finds the intersections and corners ahead that count, and the mouths of their arms."""

from __future__ import annotations

import math

from semnav_env.language.clauses import Turning
from semnav_env.language.references import Place
from semnav_env.rules import GroundingRules
from semnav_features.corridor import Corridor, Junction, corridor_at
from semnav_features.frames import Pose, to_parent
from semnav_features.scene import Scene

QUARTER_TURNS = {Turning.LEFT: 1, Turning.RIGHT: -1, Turning.AROUND: 2}
"""Heading change of each turn, in quarters of a circle, counter-clockwise."""


def junctions_ahead(
    corridor: Corridor,
    place: Place | None = None,
    turning: Turning | None = None,
    rules: GroundingRules = GroundingRules(),
) -> list[Junction]:
    """The junctions ahead of the named kind that open to the side of the turn, in order."""
    return [
        junction
        for junction in corridor.junctions
        if junction.far > rules.junction_ahead
        and junction.centre < corridor.end
        and _is_a(junction, place)
        and _opens_to(junction, turning)
    ]


def mouth_of(
    junction: Junction,
    turning: Turning,
    corridor: Corridor,
    scene: Scene,
    rules: GroundingRules,
) -> Pose:
    """The pose in the mouth of an arm, on its centre line, facing along the arm.

    Args:
        junction: the junction with the arm.
        turning: left or right, to the arm.
        corridor: the corridor of the junction.
        scene: the scene in which the corridor was found.
        rules: distances.
    """
    opening = junction.left if turning is Turning.LEFT else junction.right
    assert opening is not None
    side, depth = QUARTER_TURNS[turning], rules.arm_depth
    inside = corridor.place(opening.centre, side * (opening.offset + depth), side * math.pi / 2)
    arm = corridor_at(scene, inside).frame
    moved = math.dist(arm[:2], inside[:2])
    fits = moved < (opening.far - opening.near) / 2
    inside = arm if fits else inside
    return (*to_parent(inside, (-depth, 0.0)), inside[2])


def _is_a(junction: Junction, place: Place | None) -> bool:
    match place:
        case Place.CORNER:
            return junction.is_corner
        case Place.INTERSECTION:
            return not junction.is_corner
        case Place.END:
            return not junction.ahead
        case Place.T_JUNCTION:
            return not junction.ahead and len(junction.openings) == 2
        case Place.TURNING | None:
            return True


def _opens_to(junction: Junction, turning: Turning | None) -> bool:
    if turning is None:
        return True
    return (junction.left if turning == Turning.LEFT else junction.right) is not None
