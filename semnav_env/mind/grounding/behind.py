"""The doors behind a robot, and the door by which it came; few commands name them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from semnav_env.language.references import DoorReference, Side
from semnav_env.language.told import Told
from semnav_env.mind.grounding.counted_doors import CountedDoor, doors_along
from semnav_env.mind.grounding.door_geometry import bearing, heading_through
from semnav_env.mind.grounding.errors import UnclearError
from semnav_env.mind.grounding.search import Known, Searching
from semnav_env.mind.grounding.situation import Situation, turned
from semnav_env.mind.grounding.visible_doors import doors_around, own_doorway
from semnav_env.rules import GroundingRules
from semnav_features.corridor import doorway_at
from semnav_features.frames import Pose, compose, heading_between, to_local, wrap_angle
from semnav_features.scene import Scene


def doors_behind(situation: Situation) -> tuple[Sequence[CountedDoor], bool]:
    """The doors behind a robot, in order, and whether there may be more farther along.

    Behind a robot that stands in a doorway is only that door. In a room, which is wider than any
    corridor, those in view are meant that lie more behind than beside, the one most nearly straight
    behind first; elsewhere those that the robot would come by on turning around, if there are any.

    Args:
        situation: of a robot that is turned around, see `Situation.towards`.
    """
    scene, begin, corridor = situation.scene, situation.begin, situation.corridor
    rules = situation.rules.grounding
    doorway = own_doorway(scene, turned(begin), rules)
    if doorway is not None:
        outward = heading_through(doorway, begin[2])
        return [CountedDoor(doorway, 0.0, Side.BEHIND, outward)], False
    if corridor.half_width <= rules.corridor_width / 2:
        doors = doors_along(scene, corridor, rules=rules)
        if doors or not situation.seen_to_end:
            return doors, True
    elif not situation.complete and not situation.looks_along(begin[2]):
        return [], True
    straight = doors_straight_ahead(scene, (*begin[:2], corridor.frame[2]), rules)
    return straight, not straight


def doors_straight_ahead(scene: Scene, pose: Pose, rules: GroundingRules) -> list[CountedDoor]:
    """The doors in view that lie more ahead of a turned pose than beside it.

    They are the doors behind the robot, ordered by their angle from straight ahead.
    """
    seen = ((bearing(pose, door), door) for door in doors_around(scene, pose, rules=rules))
    return [
        CountedDoor(door, ahead, Side.BEHIND, heading_through(door, heading), off)
        for off, door in sorted(seen, key=lambda each: each[0])
        if off < math.pi / 4
        for heading in [heading_between(pose[:2], door.midpoint)]
        for ahead in [to_local(pose, door.midpoint)[0]]
    ]


def find_entry(reference: DoorReference, situation: Situation) -> CountedDoor:
    """The door of "the door we came in by": the one through which the robot came last.

    It is the seen door nearest to where that door was passed; where none is near, as it was then.

    Raises:
        UnclearError: no clause before led through a door, and the robot stands in no doorway.
    """
    scene, begin, rules = situation.scene, situation.begin, situation.rules.grounding
    passed = situation.entry
    door = doorway_at(scene, begin) if passed is None else passed.door
    if door is None:
        raise UnclearError(
            Told("{what}: the robot has come through no door; say which", what=reference)
        )
    outward = (begin if passed is None else passed.pose)[2] + math.pi
    off = [(math.dist(door.midpoint, seen.midpoint), seen) for seen in scene.doors]
    near = [each for each in off if each[0] <= rules.way_door_offset]
    seen = min(near, key=lambda each: each[0])[1] if near else door
    return CountedDoor(seen, 0.0, Side.BEHIND, heading_through(seen, outward))


def find_exit(situation: Situation) -> Known[CountedDoor] | Searching:
    """The door of "leave the room": the doorway by which the robot has just come.

    A robot that has not come through a door leaves by the only door in view. Where not everything
    has been seen, it takes the most open door, and searches for one if none is open. A room that it
    has searched it leaves as if it had not moved since then: furniture may hide the door from it.

    Raises:
        UnclearError: there is no door, or there are several.
    """
    if situation.searched_from is not None:
        situation = replace(situation, begin=situation.searched_from, searched_from=None)
    scene, begin, rules = situation.scene, situation.begin, situation.rules.grounding
    inward = begin
    door = doorway_at(scene, inward)
    if door is None:  # the robot may have turned around behind it
        inward = compose(begin, (rules.doorway_exit, 0.0, math.pi))
        door = doorway_at(scene, inward)
    if door is None:
        if situation.complete:
            exits = doors_around(scene, begin, rules=rules)
        else:
            from semnav_env.mind.grounding.lookouts import exits_in_view  # few commands need it

            found = exits_in_view(situation)
            if isinstance(found, Searching):
                return found
            exits = found
        if len(exits) != 1:
            raise UnclearError(
                Told("leave the room: by which door? say which, or enter the room first")
            )
        door = exits[0]
        away = heading_through(door, heading_between(begin[:2], door.midpoint))
        inward = (*door.midpoint, wrap_angle(away + math.pi))
    return Known(CountedDoor(door, 0.0, Side.BEHIND, wrap_angle(inward[2] + math.pi)))
