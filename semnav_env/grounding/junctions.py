"""Which intersections and corners count, and the goals of turns and of following a hallway."""

from __future__ import annotations

import math

from semnav_env.commands.clauses import DoorReference, Follow, Place, PlaceReference, Turn, Turning
from semnav_env.features.frames import Pose, wrap_angle
from semnav_env.features.hallway import Hallway, Junction, hallway
from semnav_env.grounding.doors import find_door
from semnav_env.grounding.goal import Goal, GoalKind
from semnav_env.grounding.situation import END_MARGIN, GroundingError, Situation
from semnav_env.grounding.words import ordinal_word

ARM_DEPTH = 1.0
"""How far inside the arm of a junction a turn ends, metres."""

QUARTERS = {Turning.LEFT: 1, Turning.RIGHT: -1, Turning.AROUND: 2}


def ground_turn(clause: Turn, situation: Situation) -> Goal:
    """The goal of "turn left at the intersection"."""
    if clause.at is None and not situation.after_hallway:
        return _turn_here(clause.turning, situation.begin)
    if clause.turning is Turning.AROUND:
        return _turn_around_at(clause, situation)
    junction = _find(clause.at, clause.turning, situation)
    if isinstance(junction, Goal):
        return junction
    arm = _arm(junction, clause.turning, situation)
    goal = Goal(GoalKind.REACH, arm, None, 1.6, 0.5, f"turn {clause.turning} {_name(clause.at)}")
    return goal.within(situation.hallway, junction)


def ground_follow(clause: Follow, situation: Situation) -> Goal:
    """The goal of "follow the hallway until the next intersection"."""
    if isinstance(clause.until, DoorReference):
        door = find_door(clause.until, situation)
        if isinstance(door, Goal):
            return door
        return _stand(situation, min(door.along, situation.hallway.end - END_MARGIN), "as far as the door")
    if clause.until is None or clause.until.place is Place.END:
        if math.isinf(situation.hallway.end):
            return situation.seek("looking for the end of the hallway")
        return _stand(situation, situation.hallway.end - END_MARGIN, "to the end of the hallway")
    junction = _find(clause.until, None, situation)
    if isinstance(junction, Goal):
        return junction
    return _stand(situation, junction.centre, f"to {_name(clause.until)[3:]}")


def _stand(situation: Situation, along: float, name: str) -> Goal:
    goal = Goal(GoalKind.REACH, situation.hallway.place(along), None, 1.0, math.pi, f"go on {name}")
    return goal.within(situation.hallway)


def _turn_here(turning: Turning, begin: Pose) -> Goal:
    pose = (*begin[:2], wrap_angle(begin[2] + QUARTERS[turning] * math.pi / 2))
    return Goal(GoalKind.REACH, pose, None, 1.5, 0.5, f"turn {turning} here")


def _turn_around_at(clause: Turn, situation: Situation) -> Goal:
    there = ground_follow(Follow(clause.at), situation)
    if there.kind is GoalKind.SEEK:
        return there
    pose = (*there.pose[:2], wrap_angle(there.pose[2] + math.pi))
    goal = Goal(GoalKind.REACH, pose, None, 1.5, 0.5, f"turn around {_name(clause.at)}")
    return goal.within(situation.hallway)


def _find(
    reference: PlaceReference | None, turning: Turning | None, situation: Situation
) -> Junction | Goal:
    """The junction that a reference names, or the goal of looking for it.

    Only places that open to the side of the turn count. Without a reference it is the next one
    of any kind.

    Raises:
        GroundingError: there is no such place.
    """
    places = [j for j in situation.hallway.junctions if _counts(j, reference, turning, situation)]
    ordinal = 1 if reference is None else reference.ordinal
    if len(places) >= ordinal:
        return places[ordinal - 1]
    name = _name(reference) + ("" if turning is None else f" that leads {turning}")
    if situation.seen_to_end:
        raise GroundingError(f"no way {name}: the hallway ended after {len(places)} such places")
    return situation.seek(f"looking for a way {name}")


def _counts(
    junction: Junction,
    reference: PlaceReference | None,
    turning: Turning | None,
    situation: Situation,
) -> bool:
    kinds = {Place.CORNER: junction.is_corner, Place.INTERSECTION: not junction.is_corner}
    kinds[Place.END] = not junction.ahead
    sides = {Turning.LEFT: junction.left, Turning.RIGHT: junction.right, None: junction}
    ahead = max(opening.far for opening in junction.openings) > 0.5
    ends_in_reach = junction.centre < situation.hallway.end
    fits = reference is None or kinds[reference.place]
    return ahead and ends_in_reach and fits and sides[turning] is not None


def _arm(junction: Junction, turning: Turning, situation: Situation) -> Pose:
    """The pose `ARM_DEPTH` inside an arm, on its centre line, looking out along it."""
    opening = junction.left if turning is Turning.LEFT else junction.right
    assert opening is not None
    side = QUARTERS[turning]
    guess = situation.hallway.place(
        opening.centre, side * (opening.offset + ARM_DEPTH), side * math.pi / 2
    )
    arm: Hallway = hallway(situation.scene, guess)
    moved = math.hypot(arm.frame[0] - guess[0], arm.frame[1] - guess[1])
    return arm.frame if moved < (opening.far - opening.near) / 2 else guess


def _name(reference: PlaceReference | None) -> str:
    if reference is None:
        return "at the next junction"
    if reference.place is Place.END:
        return "at the end of the hallway"
    return f"at the {ordinal_word(reference.ordinal)} {reference.place}"
