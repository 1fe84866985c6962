"""The goals of clauses that lead where the robot has been told the way, or has come from."""

from __future__ import annotations

import math

from semnav_env.commands.clauses import GoBack, GoToRoom
from semnav_env.commands.references import Side
from semnav_env.grounding.doors import STAND_OFF, CountedDoor
from semnav_env.grounding.goal import Goal, PassGoal, ReachGoal
from semnav_env.grounding.situation import GroundingError, Situation
from semnav_env.grounding.surroundings import heading_through
from semnav_env.grounding.ways import door_near


def ground_way(clause: GoToRoom | GoBack, situation: Situation) -> Goal:
    """The goal of "go to the kitchen" and of "go back to the start".

    The door that is seen where one was pointed out is the one to pass; until it is seen, the one
    that was pointed out.

    Raises:
        GroundingError: the robot has not been told the way.
    """
    way = situation.way
    if way is None:
        raise GroundingError(f"{clause}: the robot has not been told the way there")
    if way.door is None:
        (ax, ay), (bx, by) = way.places[-2:]
        arriving = math.atan2(by - ay, bx - ax)
        return ReachGoal(
            (bx, by, arriving),
            distance_tolerance=1.0,
            because=str(clause),
            onward=(bx, by, way.heading),
            places=way.places,
        )
    door = door_near(situation.scene, way, situation.pose) or way.door
    line = CountedDoor(door, 0.0, Side.AHEAD, heading_through(door, way.heading))
    return PassGoal(
        line.pose(STAND_OFF),
        door,
        because=str(clause),
        onward=line.pose(0.0),
        places=way.places,
    )
