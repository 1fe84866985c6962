"""The hallway at a named room, in which the doors beside or before that room are counted."""

from __future__ import annotations

import math
from dataclasses import replace

from semnav_env.language.references import DoorReference, RoomReference, Side
from semnav_env.language.told import Told, told
from semnav_env.mind.grounding.door_geometry import heading_through
from semnav_env.mind.grounding.errors import NO_WAY_TOLD, GroundingError
from semnav_env.mind.grounding.goal import Goal, PassGoal, SeekGoal
from semnav_env.mind.grounding.related_doors import HallSpan
from semnav_env.mind.grounding.search import Searching
from semnav_env.mind.grounding.situation import Situation
from semnav_env.mind.grounding.ways import Way, door_near, paced
from semnav_features.frames import Point, Pose, heading_between, to_local, wrap_angle

ALONG = math.pi / 4
"""A stretch of a way leads along a hallway if their directions differ by less, radians."""


def hallway_of(reference: DoorReference, situation: Situation) -> Situation | Searching:
    """The situation of a robot in the hallway in which the doors of a reference are counted.

    That is the one of the clause, unless the doors are beside or before a named room to which the
    way leads through another hallway. Then it is that other hallway, from where the way enters it
    on; until the robot is there, it follows the way.

    Raises:
        GroundingError: the robot has not been told the way, or is in the room already.
    """
    if not isinstance(reference.to, RoomReference):
        return situation
    way = _way(reference, situation)
    last, axis = _end_in_hallway(way, situation)
    first = _first_along(way, last, axis)
    there: Pose = (*way.places[first], axis)
    turned = abs(wrap_angle(situation.begin[2] - axis)) >= ALONG
    if situation.begin == there or (first == 0 and not turned):
        return situation
    if not situation.complete and first > 0 and _index_on(way, situation.pose) < first:
        return Searching(told(reference), there, places=way.places[: first + 1])
    return replace(situation, begin=there)


def room_span(reference: DoorReference, situation: Situation) -> HallSpan:
    """Where the door of a room lies along the hallway; a room without one, where the way ends."""
    way, rules = _way(reference, situation), situation.rules.grounding
    door = door_near(situation.scene, way, situation.pose, rules)
    middle = way.places[-1] if way.door is None else (door or way.door).midpoint
    along, offset = to_local(situation.corridor.frame, middle)
    is_beside = abs(offset) > situation.corridor.half_width / 2
    side = (Side.LEFT if offset > 0.0 else Side.RIGHT) if is_beside else None
    return HallSpan(along, along, door or way.door, side)


def led_along(goal: Goal, way: Way, situation: Situation) -> Goal:
    """A goal in the hallway at a room, with the way that leads there from where the robot began."""
    if isinstance(goal, SeekGoal):
        return goal
    entered = way.places.index(situation.begin[:2])
    ends = [goal.pose[:2]]
    if isinstance(goal, PassGoal):  # along the hallway up to its door
        middle = goal.door.midpoint
        ends = [situation.corridor.place(situation.corridor.along(middle))[:2], middle]
    return replace(goal, corridor=None, places=paced([*way.places[: entered + 1], *ends]))


def _way(reference: DoorReference, situation: Situation) -> Way:
    way = situation.way
    if way is None:
        raise GroundingError(Told(NO_WAY_TOLD, what=reference))
    if len(set(way.places)) == 1:
        raise GroundingError(
            Told("{what}: the robot is in that room; leave it first", what=reference)
        )
    return way


def _end_in_hallway(way: Way, situation: Situation) -> tuple[int, float]:
    """Index of the last place of a way before it turns to the door, and the hallway's direction."""
    places, off = way.places, situation.rules.grounding.stand_off
    middle = places[-1] if way.door is None else way.door.midpoint
    far = [k for k, place in enumerate(places[:-1]) if math.dist(place, middle) >= off]
    last = far[-1] if far else 0
    came = _heading(places[max(0, last - 2)], places[max(1, last)], situation)
    if way.door is None:
        return last, came
    through = heading_through(way.door, way.heading)
    return last, min(
        (wrap_angle(through + quarter * math.pi / 2) for quarter in (-1, 0, 1)),
        key=lambda heading: abs(wrap_angle(heading - came)),
    )


def _heading(begin: Point, end: Point, situation: Situation) -> float:
    return heading_between(begin, end) if begin != end else situation.begin[2]


def _first_along(way: Way, last: int, axis: float) -> int:
    """Index of the place at which a way enters the hallway that leads to its last places."""
    first = last
    while first > 0:
        stretch = heading_between(way.places[first - 1], way.places[first])
        if abs(wrap_angle(stretch - axis)) >= ALONG:
            break
        first -= 1
    return first


def _index_on(way: Way, pose: Pose) -> int:
    """Index of the place of a way that is nearest to a pose."""
    apart = [math.dist(place, pose[:2]) for place in way.places]
    return apart.index(min(apart))
