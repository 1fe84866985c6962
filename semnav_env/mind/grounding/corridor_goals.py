"""The goals of turns and of following a corridor."""

from __future__ import annotations

import math

from semnav_env.language.clauses import Follow, Turn, Turning
from semnav_env.language.references import (
    Distance,
    DoorReference,
    Place,
    PlaceOffset,
    PlaceReference,
    RoomReference,
    Side,
    Unit,
)
from semnav_env.language.told import Told, told
from semnav_env.mind.grounding.counted_doors import doors_along
from semnav_env.mind.grounding.errors import NOT_BEHIND, GroundingError, UnclearError
from semnav_env.mind.grounding.find import find_door, find_junction, junction_name
from semnav_env.mind.grounding.goal import Goal, ReachGoal, SeekGoal
from semnav_env.mind.grounding.goals import search_goal
from semnav_env.mind.grounding.junctions import QUARTER_TURNS, mouth_of
from semnav_env.mind.grounding.search import Searching
from semnav_env.mind.grounding.situation import Situation, turned
from semnav_features.corridor import Junction, doorway_at
from semnav_features.frames import compose
from semnav_features.scene import Door

IN_DOORWAY = "{what}: one stands in that doorway; say to go through it"
SOME_TOLD = "a bit of {metres} metres, as it was not said how far"
"""Messages of clauses along a corridor."""

END_OF_HALLWAY = PlaceReference(Place.END)


def turn_goal(clause: Turn, situation: Situation) -> Goal:
    """The goal of "turn left at the intersection"."""
    if clause.degrees is not None:
        return _turn_by(clause.turning, clause.degrees, situation)
    if clause.at is None and not situation.after_corridor:
        return _turn_here(clause.turning, situation)
    if clause.turning is Turning.AROUND:
        return _turn_around(clause, situation)
    found = find_junction(clause.at, clause.turning, situation)
    if isinstance(found, Searching):
        return search_goal(found)
    because = Told(
        "turn {turning} at {place:at}", turning=clause.turning, place=junction_name(clause.at)
    )
    return _into_arm(found.value, clause.turning, because, situation)


def _into_arm(
    junction: Junction, turning: Turning, because: str, situation: Situation
) -> ReachGoal:
    """The goal in the mouth of a junction's arm, facing out along it.

    It is reached anywhere across the arm.
    """
    corridor = situation.corridor
    rules, accepted = situation.rules.grounding, situation.rules.success
    mouth = mouth_of(junction, turning, corridor, situation.scene, rules)
    arm = junction.left if turning is Turning.LEFT else junction.right
    half_width = 0.0 if arm is None else (arm.far - arm.near) / 2
    return ReachGoal(
        compose(mouth, (rules.arm_depth, 0.0, 0.0)),
        accepted.junction_distance,
        accepted.turn_heading,
        because,
        corridor=corridor,
        junction=junction,
        onward=mouth,
        offset_tolerance=max(accepted.junction_distance, half_width),
    )


def follow_goal(clause: Follow, situation: Situation) -> Goal:
    """The goal of "follow the hallway until the next intersection"."""
    until, last_stop = clause.until, situation.last_stop
    if isinstance(until, Distance):
        return _go_on(situation, _distance_along(until, situation), _told(until, situation))
    if isinstance(until, DoorReference):
        return _follow_to_door(clause, until, situation)
    if isinstance(until, RoomReference | PlaceOffset):
        raise TypeError(f"{clause!r} is grounded by goal_of")
    if until is None or until.place is Place.END:
        if math.isinf(last_stop):
            return search_goal(situation.go_on(END_OF_HALLWAY))
        return _go_on(situation, last_stop, END_OF_HALLWAY)
    found = find_junction(until, None, situation)
    if isinstance(found, Searching):
        return search_goal(found)
    junction = found.value
    if clause.past and until.place is Place.CORNER:
        way = Turning.RIGHT if junction.left is None else Turning.LEFT
        return _into_arm(junction, way, Told("go on behind {place}", place=until), situation)
    if clause.past and not junction.ahead and situation.complete:
        raise GroundingError(Told(NOT_BEHIND, place=until))
    behind = junction.far + situation.rules.grounding.behind_referent
    along = min(behind, last_stop) if clause.past else junction.centre
    return _go_on(situation, along, _where(clause))


def _follow_to_door(clause: Follow, until: DoorReference, situation: Situation) -> Goal:
    """The goal of following a corridor up to a door or past it.

    Raises:
        UnclearError: the door is opposite, across the corridor and not along it; or it is the
            doorway that the robot stands in.
    """
    if until.side is Side.OPPOSITE:
        raise UnclearError(
            Told("{what}: it lies across; say to go to it, or through it", what=clause)
        )
    found = find_door(until, situation)
    if isinstance(found, Searching):
        return search_goal(found)
    door, rules = found.value, situation.rules.grounding
    if situation.back:
        from semnav_env.mind.grounding.visible_doors import own_doorway  # few commands need it

        if door.door == own_doorway(situation.scene, turned(situation.begin), rules):
            raise UnclearError(Told(IN_DOORWAY, what=clause))
    shift = rules.behind_referent if clause.past else -rules.before_door
    along = min(door.along + shift, situation.last_stop)
    return _go_on(situation, along, _where(clause), door.door)


def _where(clause: Follow) -> Told:
    return Told("behind {place}", place=clause.until) if clause.past else told(clause.until)


def _told(distance: Distance, situation: Situation) -> Told:
    """A distance in words; of "a bit" also how long that is."""
    if distance.unit is not Unit.SOME:
        return told(distance)
    return Told(SOME_TOLD, metres=situation.metres(distance))


def _distance_along(distance: Distance, situation: Situation) -> float:
    """Distance to go along the corridor, metres; not beyond its end.

    Raises:
        GroundingError: the corridor is known, and shorter than a distance in numbers.
    """
    most = situation.corridor.end - situation.rules.grounding.end_margin / 2
    if distance.unit is Unit.SOME:
        return max(0.0, min(situation.metres(distance), most))
    if distance.metres > most and situation.complete:
        raise GroundingError(
            Told(
                "{distance} ahead: the hallway ends after {end:.1f} m",
                distance=distance,
                end=situation.corridor.end,
            )
        )
    return min(distance.metres, most)


def _go_on(
    situation: Situation, along: float, where: object, beside: Door | None = None
) -> ReachGoal:
    """The goal at a distance along the corridor, beside a door if one ends the distance."""
    return ReachGoal(
        situation.corridor.place(along),
        situation.rules.success.corridor_distance,
        because=Told("go on to {place:to}", place=where),
        beside=beside,
        corridor=situation.corridor,
    )


def _turn_here(turning: Turning, situation: Situation) -> ReachGoal:
    """The goal of a turn where the clause began, or outside the doorway if it began in one."""
    rules, accepted = situation.rules.grounding, situation.rules.success
    doorway = doorway_at(situation.scene, situation.begin)
    out = 0.0 if doorway is None else min(rules.doorway_exit, situation.corridor.end / 2)
    pose = compose(situation.begin, (out, 0.0, QUARTER_TURNS[turning] * math.pi / 2))
    leaves_door = doorway is not None or _faces_a_door(situation)
    past = rules.beside_doorway if leaves_door and turning is not Turning.AROUND else 0.0
    return ReachGoal(
        pose,
        accepted.turn_distance,
        accepted.turn_heading,
        Told("{turn} here", turn=Turn(turning)),
        onward=compose(pose, (past, 0.0, 0.0)),
    )


def _faces_a_door(situation: Situation) -> bool:
    """Whether the robot stands directly before a door and faces it."""
    rules = situation.rules.grounding
    facing = doors_along(situation.scene, situation.corridor, Side.AHEAD, rules)
    return any(door.along <= rules.faced_door_distance for door in facing)


def _turn_by(turning: Turning, degrees: int, situation: Situation) -> ReachGoal:
    """The goal of a turn by an angle where the clause began; only the final heading counts."""
    angle, accepted = math.radians(degrees), situation.rules.success
    return ReachGoal(
        compose(situation.begin, (0.0, 0.0, math.copysign(angle, QUARTER_TURNS[turning]))),
        accepted.turn_distance,
        min(accepted.turn_heading, max(accepted.turn_heading_min, angle / 2)),
        told(Turn(turning, degrees=degrees)),
    )


def _turn_around(clause: Turn, situation: Situation) -> Goal:
    there = follow_goal(Follow(clause.at), situation)
    if isinstance(there, SeekGoal):
        return there
    accepted = situation.rules.success
    return ReachGoal(
        compose(there.pose, (0.0, 0.0, math.pi)),
        accepted.turn_distance,
        accepted.turn_heading,
        Told("turn around at {place:at}", place=clause.at or END_OF_HALLWAY),
        corridor=situation.corridor,
    )
