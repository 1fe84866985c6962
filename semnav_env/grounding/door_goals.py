"""The goals of clauses that lead to a door, through one, or out of the room."""

from __future__ import annotations

import math

from semnav_env.commands.clauses import Approach, GoToDoor
from semnav_env.commands.references import Side
from semnav_env.features.corridor import doorway_at
from semnav_env.features.frames import compose, wrap_angle
from semnav_env.grounding.doors import OUT_OF_DOORWAY, STAND_OFF, CountedDoor, find_door
from semnav_env.grounding.goal import Goal, PassGoal, ReachGoal
from semnav_env.grounding.situation import Situation, UnclearError, turned
from semnav_env.grounding.surroundings import (
    doors_around,
    doors_of_the_room,
    heading_between,
    heading_through,
)


def ground_door(clause: GoToDoor, situation: Situation) -> Goal:
    """The goal of "go through the second door on the right"."""
    found = find_door(clause.door, situation)
    if not isinstance(found, CountedDoor):
        return found
    across = found.side in (Side.BEHIND, Side.OPPOSITE)  # not along the corridor
    corridor, because = None if across else situation.corridor, str(clause.door)
    if clause.approach is Approach.TO:
        there = found.pose(-STAND_OFF)
        return ReachGoal(there, 0.7, 0.6, because, found.door, corridor=corridor)
    line = found.pose(0.0)
    return PassGoal(found.pose(STAND_OFF), found.door, because, corridor=corridor, onward=line)


def ground_leave(situation: Situation) -> Goal:
    """The goal of "leave the room": back through the doorway that the robot has just come by.

    Who has not come by one leaves by the only door in view.

    Raises:
        UnclearError: there is none, or there are several.
    """
    inward = situation.begin
    door = doorway_at(situation.scene, inward)
    if door is None:  # it has turned around behind it
        inward = compose(situation.begin, (OUT_OF_DOORWAY, 0.0, math.pi))
        door = doorway_at(situation.scene, inward)
    if door is None:
        around = doors_around(situation.scene, situation.begin)
        if not situation.complete:
            around = doors_of_the_room(around, situation.scene, situation.begin)
        if not around and not situation.complete:
            return situation.turn_to(turned(situation.begin)[2], "the door of the room")
        if len(around) != 1:
            raise UnclearError("leave the room: by which door? say which, or enter the room first")
        door = around[0]
        away = heading_through(door, heading_between(situation.begin[:2], door.midpoint))
        inward = (*door.midpoint, wrap_angle(away + math.pi))
    outward = wrap_angle(inward[2] + math.pi)
    line = CountedDoor(door, 0.0, Side.BEHIND, outward)
    because = "leave the room"
    return PassGoal(line.pose(STAND_OFF), door, because, onward=line.pose(0.0))
