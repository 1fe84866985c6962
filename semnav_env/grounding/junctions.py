"""Which intersections and corners count, and the goals of turns and of following a corridor."""

from __future__ import annotations

import math

from semnav_env.commands.clauses import Follow, Turn, Turning
from semnav_env.commands.references import Distance, DoorReference, Place, PlaceReference, Side
from semnav_env.features.corridor import Corridor, Junction, corridor_at, doorway_at
from semnav_env.features.frames import Pose, compose, to_parent
from semnav_env.features.scene import Door
from semnav_env.grounding.doors import OUT_OF_DOORWAY, CountedDoor, doors_along, find_door
from semnav_env.grounding.goal import Goal, ReachGoal, SeekGoal
from semnav_env.grounding.situation import (
    END_MARGIN,
    GroundingError,
    Situation,
    UnclearError,
    turned,
)
from semnav_env.grounding.surroundings import own_doorway

ARM_DEPTH = 1.0
"""How far inside the arm of a junction a turn ends, metres."""

STILL_AHEAD = 0.5
"""A junction counts while more than this of it is ahead, metres."""

JUST_BEFORE = 0.3
"""How far before the middle of a door "until the door" ends, so that it still counts, metres."""

JUST_BEHIND = 0.3
"""How far behind a junction, or the middle of a door, "past" it ends, so that it no longer counts,
metres."""

PAST_DOORWAY = 0.5
"""How far beside the doorway that one turns away from counting begins, so that it does not count
itself, metres."""

RIGHT_BEFORE = 2.0
"""A door so near ahead is the one that a robot turns away from, metres."""

QUARTERS = {Turning.LEFT: 1, Turning.RIGHT: -1, Turning.AROUND: 2}


def ground_turn(clause: Turn, situation: Situation) -> Goal:
    """The goal of "turn left at the intersection"."""
    if clause.degrees is not None:
        return _turn_by(clause.turning, clause.degrees, situation)
    if clause.at is None and not situation.after_corridor:
        return _turn_here(clause.turning, situation)
    if clause.turning is Turning.AROUND:
        return _turn_around(clause, situation)
    junction = _find_junction(clause.at, clause.turning, situation)
    if not isinstance(junction, Junction):
        return junction
    mouth = _mouth(junction, clause.turning, situation)
    return ReachGoal(
        compose(mouth, (ARM_DEPTH, 0.0, 0.0)),
        distance_tolerance=1.6,
        heading_tolerance=0.5,
        because=f"turn {clause.turning} at {_name(clause.at)}",
        corridor=situation.corridor,
        junction=junction,
        onward=mouth,
    )


def ground_follow(clause: Follow, situation: Situation) -> Goal:
    """The goal of "follow the hallway until the next intersection"."""
    until, end = clause.until, situation.corridor.end - END_MARGIN
    if isinstance(until, Distance):
        return _go_on(situation, _distance_along(until, situation), str(until))
    if isinstance(until, DoorReference):
        return _follow_to_door(clause, until, situation)
    if until is None or until.place is Place.END:
        if math.isinf(end):
            return situation.seek("the end of the hallway")
        return _go_on(situation, end, "the end of the hallway")
    junction = _find_junction(until, None, situation)
    if not isinstance(junction, Junction):
        return junction
    if clause.past and not junction.ahead and situation.complete:
        raise GroundingError(f"the hallway does not go on behind {until}")
    along = min(junction.far + JUST_BEHIND, end) if clause.past else junction.centre
    return _go_on(situation, along, _past(clause))


def _follow_to_door(clause: Follow, until: DoorReference, situation: Situation) -> Goal:
    """Up to a door or past it.

    Raises:
        UnclearError: it is opposite, across the corridor and not along it; or the doorway that one
            stands in.
    """
    if until.side is Side.OPPOSITE:
        raise UnclearError(f"{clause}: it lies across; say to go to it, or through it")
    door = find_door(until, situation)
    if not isinstance(door, CountedDoor):
        return door
    if situation.back and door.door == own_doorway(situation.scene, turned(situation.begin)):
        raise UnclearError(f"{clause}: one stands in that doorway; say to go through it")
    beside = JUST_BEHIND if clause.past else -JUST_BEFORE
    along = min(door.along + beside, situation.corridor.end - END_MARGIN)
    return _go_on(situation, along, _past(clause), door.door)


def _past(clause: Follow) -> str:
    return f"behind {clause.until}" if clause.past else str(clause.until)


def _distance_along(distance: Distance, situation: Situation) -> float:
    """How far to go; not beyond the end of the corridor.

    Raises:
        GroundingError: the corridor is known, and shorter.
    """
    most = situation.corridor.end - END_MARGIN / 2
    if distance.metres > most and situation.complete:
        raise GroundingError(
            f"{distance} ahead: the hallway ends after {situation.corridor.end:.1f} m"
        )
    return min(distance.metres, most)


def _go_on(situation: Situation, along: float, where: str, beside: Door | None = None) -> Goal:
    return ReachGoal(
        situation.corridor.place(along),
        distance_tolerance=1.0,
        because=f"go on to {where}",
        beside=beside,
        corridor=situation.corridor,
    )


def _turn_here(turning: Turning, situation: Situation) -> Goal:
    """Turn where the clause began, or where there is room for it before the doorway there."""
    doorway = doorway_at(situation.scene, situation.begin)
    out = 0.0 if doorway is None else min(OUT_OF_DOORWAY, situation.corridor.end / 2)
    pose = compose(situation.begin, (out, 0.0, QUARTERS[turning] * math.pi / 2))
    leaves_door = doorway is not None or _faces_a_door(situation)
    past = PAST_DOORWAY if leaves_door and turning is not Turning.AROUND else 0.0
    return ReachGoal(
        pose,
        distance_tolerance=1.5,
        heading_tolerance=0.5,
        because=f"turn {turning} here",
        onward=compose(pose, (past, 0.0, 0.0)),
    )


def _faces_a_door(situation: Situation) -> bool:
    """Whether the robot stands right before a door and looks at it."""
    facing = doors_along(situation.scene, situation.corridor, Side.AHEAD)
    return any(door.along <= RIGHT_BEFORE for door in facing)


def _turn_by(turning: Turning, degrees: int, situation: Situation) -> Goal:
    """Turn by an angle where the clause began; what counts is where one looks in the end."""
    angle = math.radians(degrees)
    return ReachGoal(
        compose(situation.begin, (0.0, 0.0, math.copysign(angle, QUARTERS[turning]))),
        distance_tolerance=1.5,
        heading_tolerance=min(0.5, max(0.2, angle / 2)),
        because=f"turn {turning} by {degrees} degrees",
    )


def _turn_around(clause: Turn, situation: Situation) -> Goal:
    there = ground_follow(Follow(clause.at), situation)
    if isinstance(there, SeekGoal):
        return there
    return ReachGoal(
        compose(there.pose, (0.0, 0.0, math.pi)),
        distance_tolerance=1.5,
        heading_tolerance=0.5,
        because=f"turn around at {clause.at or 'the end of the hallway'}",
        corridor=situation.corridor,
    )


def _find_junction(
    reference: PlaceReference | None, turning: Turning | None, situation: Situation
) -> Junction | Goal:
    """The junction that a reference names, or the goal of looking for it.

    Only junctions that open to the side of the turn count. Without a reference it is the next
    one of any kind. Whether a junction is a corner can hang on an opening that is hard to see; so
    at the end of a corridor that has none of the kind a robot takes what else leads its way.

    Raises:
        GroundingError: there is no such place.
    """
    place = None if reference is None else reference.place
    ordinal = 1 if reference is None else reference.ordinal
    junctions = junctions_ahead(situation.corridor, place, turning)
    if not junctions and situation.seen_to_end and not situation.complete:
        junctions = junctions_ahead(situation.corridor, None, turning)
    counted = ordinal > 0 or situation.seen_to_end
    if counted and len(junctions) >= abs(ordinal):
        return junctions[ordinal - 1 if ordinal > 0 else ordinal]
    name = _name(reference) + ("" if turning is None else f" that leads {turning}")
    if situation.seen_to_end:
        raise situation.missing(name, len(junctions))
    return situation.seek(name)


def junctions_ahead(
    corridor: Corridor, place: Place | None = None, turning: Turning | None = None
) -> list[Junction]:
    """The junctions ahead that are such a place and open to the side of the turn, in order."""
    return [
        junction
        for junction in corridor.junctions
        if junction.far > STILL_AHEAD
        and junction.centre < corridor.end
        and _is_a(junction, place)
        and _opens_to(junction, turning)
    ]


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
    arms = {Turning.LEFT: junction.left, Turning.RIGHT: junction.right}
    return turning is None or arms[turning] is not None


def _mouth(junction: Junction, turning: Turning, situation: Situation) -> Pose:
    """The pose in the mouth of an arm, on its centre line, looking out along it."""
    opening = junction.left if turning is Turning.LEFT else junction.right
    assert opening is not None
    side = QUARTERS[turning]
    inside = situation.corridor.place(
        opening.centre, side * (opening.offset + ARM_DEPTH), side * math.pi / 2
    )
    arm = corridor_at(situation.scene, inside).frame
    moved = math.dist(arm[:2], inside[:2])
    fits = moved < (opening.far - opening.near) / 2
    inside = arm if fits else inside
    return (*to_parent(inside, (-ARM_DEPTH, 0.0)), inside[2])


def _name(reference: PlaceReference | None) -> str:
    return "the next junction" if reference is None else str(reference)
