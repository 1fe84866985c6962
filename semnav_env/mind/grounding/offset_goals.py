"""The goal of "a metre before the corner": a place at a distance from another along the hallway."""

from __future__ import annotations

import math
from dataclasses import replace

from semnav_env.language.clauses import Follow, Turning
from semnav_env.language.references import (
    DoorReference,
    Place,
    PlaceOffset,
    Relation,
    RoomReference,
)
from semnav_env.language.told import Told
from semnav_env.mind.grounding.errors import NOT_BEHIND, GroundingError
from semnav_env.mind.grounding.find import find_door, find_junction
from semnav_env.mind.grounding.goal import Goal, ReachGoal
from semnav_env.mind.grounding.goals import search_goal
from semnav_env.mind.grounding.junctions import mouth_of
from semnav_env.mind.grounding.landmark_goals import follow_to_room
from semnav_env.mind.grounding.search import Searching
from semnav_env.mind.grounding.situation import Situation
from semnav_features.corridor import Junction
from semnav_features.frames import Pose, compose

SHARE = 0.6
"""Largest error as a share of the distance: who is beside the place itself has not arrived."""


def offset_goal(offset: PlaceOffset, situation: Situation) -> Goal:
    """The goal of following the hallway until so far before or after a place.

    Raises:
        GroundingError: there is no such place, or the hallway ends before.
    """
    far = situation.metres(offset.distance)
    shift = far if offset.relation is Relation.AFTER else -far
    place = offset.place
    if isinstance(place, RoomReference):
        return _off_room(offset, place, shift, situation)
    if isinstance(place, DoorReference):
        door = find_door(place, situation)
        if isinstance(door, Searching):
            return search_goal(door)
        return _along(offset, door.value.along + shift, situation)
    if place.place is Place.END:
        if math.isinf(situation.last_stop):
            return search_goal(situation.go_on(place))
        return _along(offset, situation.corridor.end + shift, situation)
    found = find_junction(place, None, situation)
    if isinstance(found, Searching):
        return search_goal(found)
    return _off_junction(offset, found.value, shift, situation)


def _off_junction(
    offset: PlaceOffset, junction: Junction, shift: float, situation: Situation
) -> ReachGoal:
    """Before the opening of a junction, behind it, or so far in the only arm of a corner."""
    if offset.relation is Relation.BEFORE:
        near = min(opening.near for opening in junction.openings)
        return _along(offset, near + shift, situation)
    if junction.is_corner:
        way = Turning.RIGHT if junction.left is None else Turning.LEFT
        rules = situation.rules.grounding
        mouth = mouth_of(junction, way, situation.corridor, situation.scene, rules)
        return _goal(offset, compose(mouth, (shift, 0.0, 0.0)), situation)
    if not junction.ahead and situation.complete:
        raise GroundingError(Told(NOT_BEHIND, place=offset.place))
    return _along(offset, junction.far + shift, situation)


def _off_room(
    offset: PlaceOffset, room: RoomReference, shift: float, situation: Situation
) -> ReachGoal:
    """Off the door of a room, along the way that the robot is told."""
    beside = follow_to_room(Follow(room), situation)
    pose = compose(beside.pose, (situation.rules.grounding.before_door + shift, 0.0, 0.0))
    goal = _goal(offset, pose, situation)
    return replace(
        goal,
        corridor=None,
        offset_tolerance=beside.offset_tolerance,
        places=(*beside.places[:-1], pose[:2]),
    )


def _along(offset: PlaceOffset, along: float, situation: Situation) -> ReachGoal:
    """The goal at a distance along the hallway, not before its beginning and not behind its end.

    Raises:
        GroundingError: the hallway is known, and ends before.
    """
    most = situation.corridor.end - situation.rules.grounding.end_margin / 2
    if along > most and offset.relation is Relation.AFTER and situation.complete:
        end = situation.corridor.end
        raise GroundingError(
            Told("{offset}: the hallway ends after {end:.1f} m", offset=offset, end=end)
        )
    return _goal(offset, situation.corridor.place(max(0.0, min(along, most))), situation)


def _goal(offset: PlaceOffset, pose: Pose, situation: Situation) -> ReachGoal:
    return ReachGoal(
        pose,
        min(situation.rules.success.corridor_distance, SHARE * situation.metres(offset.distance)),
        because=Told("go on to {place:to}", place=offset),
        corridor=situation.corridor,
    )
