"""The goals of clauses with a room as a landmark, and of facing something."""

from __future__ import annotations

import math

from semnav_env.language.clauses import Face, Follow
from semnav_env.language.references import DoorReference, Place, PlaceReference, RoomReference, Side
from semnav_env.language.told import Told, told
from semnav_env.mind.grounding.errors import NO_WAY_TOLD, GroundingError
from semnav_env.mind.grounding.find import find_door, find_junction
from semnav_env.mind.grounding.goal import Goal, ReachGoal
from semnav_env.mind.grounding.goals import search_goal
from semnav_env.mind.grounding.search import Searching
from semnav_env.mind.grounding.situation import Situation
from semnav_env.mind.grounding.ways import Way, door_near
from semnav_features.frames import Point, Pose, heading_between, to_local, to_parent, wrap_angle


def landmark_goal(clause: Follow | Face, situation: Situation) -> Goal:
    """The goal of a clause with a room as a landmark, or of facing something.

    Raises:
        GroundingError: the referent cannot be there, or the robot was not told the way.
    """
    if isinstance(clause, Face):
        return face_goal(clause, situation)
    return follow_to_room(clause, situation)


def follow_to_room(clause: Follow, situation: Situation) -> ReachGoal:
    """The goal of "go down the hallway until room 12", or past it: a place beside its door.

    Raises:
        GroundingError: the robot has not been told the way there.
    """
    way = _way(clause, situation)
    rules, accepted = situation.rules.grounding, situation.rules.success
    door = door_near(situation.scene, way, situation.pose, rules) or way.door
    middle = way.places[-1] if door is None else door.midpoint
    last = _last_in_hallway(way, middle, rules.stand_off)
    before = way.places[max(0, last - 1)]
    foot = way.places[last]
    along: Pose = (*foot, heading_between(before, foot) if before != foot else situation.begin[2])
    shift = rules.behind_referent if clause.past else -rules.before_door
    ahead = to_local(along, middle)[0] + shift
    x, y = to_parent(along, (max(0.0, ahead) if clause.past else ahead, 0.0))
    return ReachGoal(
        (x, y, along[2]),
        accepted.way_distance,
        because=Told(
            "go on behind {place}" if clause.past else "go on to {place:to}", place=clause.until
        ),
        beside=door,
        offset_tolerance=accepted.way_offset,
        places=(*way.places[: last + 1], (x, y)),
    )


def _last_in_hallway(way: Way, middle: Point, stand_off: float) -> int:
    """Index of the last place of a way in the corridor, before the way turns to the door."""
    far = [k for k, place in enumerate(way.places) if math.dist(place, middle) >= stand_off]
    return far[-1] if far else 0


def face_goal(clause: Face, situation: Situation) -> Goal:
    """The goal of "face the second door on the left": turn on the spot.

    Raises:
        GroundingError: the referent cannot be there.
    """
    what = clause.what
    if isinstance(what, Side):
        return _turned_to(_heading_along_wall(what, situation), clause, situation)
    if isinstance(what, RoomReference):
        way = _way(clause, situation)
        there = way.places[-1] if way.door is None else way.door.midpoint
        return _turned_to(heading_between(situation.begin[:2], there), clause, situation)
    if isinstance(what, DoorReference):
        found = find_door(what, situation)
        if isinstance(found, Searching):
            return search_goal(found)
        heading = heading_between(situation.begin[:2], found.value.door.midpoint)
        return _turned_to(heading, clause, situation)
    return _face_place(clause, what, situation)


def _face_place(clause: Face, what: PlaceReference, situation: Situation) -> Goal:
    if what.place is Place.END:
        return _turned_to(situation.corridor.frame[2], clause, situation)
    found = find_junction(what, None, situation)
    if isinstance(found, Searching):
        return search_goal(found)
    x, y, _ = situation.corridor.place(found.value.centre)
    return _turned_to(heading_between(situation.begin[:2], (x, y)), clause, situation)


def _heading_along_wall(side: Side, situation: Situation) -> float:
    """The heading at which the nearest of the walls beside and ahead is on the named side."""
    corridor = situation.corridor
    here = max(0.0, corridor.along(situation.begin[:2]))
    beside = to_local(corridor.frame, situation.begin[:2])[1]
    walls = {
        math.pi / 2: abs(corridor.side_at(True, here) - beside),
        -math.pi / 2: abs(corridor.side_at(False, here) + beside),
        0.0: corridor.end - here,
    }
    nearest = corridor.frame[2] + min(walls, key=walls.__getitem__)
    return wrap_angle(nearest - math.copysign(math.pi / 2, 1 if side is Side.LEFT else -1))


def _turned_to(heading: float, clause: Face, situation: Situation) -> ReachGoal:
    accepted = situation.rules.success
    return ReachGoal(
        (*situation.begin[:2], heading),
        accepted.turn_distance,
        accepted.turn_heading,
        told(clause),
    )


def _way(clause: Follow | Face, situation: Situation) -> Way:
    if situation.way is None:
        raise GroundingError(Told(NO_WAY_TOLD, what=clause))
    return situation.way
