"""The goals of clauses to a door, through a door, out of a room, or along a known way."""

from __future__ import annotations

import math

from semnav_env.language.clauses import Approach, GoBack, GoToDoor, GoToRoom, Leave
from semnav_env.language.references import Side
from semnav_env.language.told import Told, told
from semnav_env.mind.grounding.counted_doors import CountedDoor
from semnav_env.mind.grounding.door_geometry import heading_through
from semnav_env.mind.grounding.errors import NO_WAY_TOLD, GroundingError
from semnav_env.mind.grounding.find import find_door
from semnav_env.mind.grounding.goal import LOOKING, Goal, PassGoal, ReachGoal, SeekGoal
from semnav_env.mind.grounding.goal_check import looks_along
from semnav_env.mind.grounding.niches import at_the_back
from semnav_env.mind.grounding.search import Searching
from semnav_env.mind.grounding.situation import Situation
from semnav_env.mind.grounding.ways import Way, door_near
from semnav_env.rules import GroundingRules
from semnav_features.frames import Pose


def search_goal(search: Searching) -> SeekGoal | ReachGoal:
    """The goal of a search.

    The goal of a search on the spot is never reached, because turning alone completes no clause.
    """
    if search.on_the_spot:
        return ReachGoal(search.lookout, 0.0, 0.0, Told(LOOKING, what=search.what))
    return SeekGoal(search.lookout, search.what, corridor=search.corridor, places=search.places)


def is_search(goal: Goal) -> bool:
    """Whether a goal is that of a search, see `search_goal`."""
    on_the_spot = isinstance(goal, ReachGoal) and goal.distance_tolerance == 0.0
    return on_the_spot or isinstance(goal, SeekGoal)


def has_looked(goal: Goal, pose: Pose, rules: GroundingRules) -> bool:
    """Whether a goal is that of a search, and the robot has reached its lookout point."""
    if isinstance(goal, SeekGoal):
        return math.dist(goal.pose[:2], pose[:2]) <= rules.lookout_distance
    return is_search(goal) and looks_along(pose, goal.pose[2], rules.inspection_angle)


def door_goal(clause: GoToDoor, situation: Situation) -> Goal:
    """The goal of "go through the second door on the right", or to it."""
    found = find_door(clause.door, situation)
    if isinstance(found, Searching):
        return search_goal(found)
    door, because = found.value, _because(clause)
    across = door.side in (Side.BEHIND, Side.OPPOSITE)  # not along the corridor
    corridor = None if across else situation.corridor
    stand_off = situation.rules.grounding.stand_off
    if clause.approach is Approach.THROUGH:
        if not situation.complete:
            door = at_the_back(door, situation.scene)
        behind, line = door.pose(stand_off), door.pose(0.0)
        return PassGoal(behind, door.door, because, corridor=corridor, onward=line)
    accepted, inside = situation.rules.success, clause.approach is Approach.IN
    return ReachGoal(
        door.pose(0.0 if inside else -stand_off),
        accepted.door_distance / 2 if inside else accepted.door_distance,
        accepted.door_heading,
        because,
        door.door,
        corridor=corridor,
    )


def _because(clause: GoToDoor) -> str:
    """The door in words, with a remark if the approach was not said."""
    by_default = "{door}, through it, as nothing else was said"
    return Told(by_default, door=clause.door) if clause.by_default else told(clause.door)


def leave_goal(situation: Situation) -> Goal:
    """The goal of told(Leave())."""
    from semnav_env.mind.grounding.behind import find_exit  # few commands need it

    found = find_exit(situation)
    if isinstance(found, Searching):
        return search_goal(found)
    door = found.value
    behind, line = door.pose(situation.rules.grounding.stand_off), door.pose(0.0)
    return PassGoal(behind, door.door, told(Leave()), onward=line)


def way_goal(clause: GoToRoom | GoBack, situation: Situation) -> Goal:
    """The goal of "go to the kitchen" and of "go back to the start".

    The door to pass is the one that is seen near the told door; until it is seen, the told door.

    Raises:
        GroundingError: the robot has not been told the way.
    """
    way, because = situation.way, told(clause)
    if way is None:
        raise GroundingError(Told(NO_WAY_TOLD, what=clause))
    if way.door is None:
        return _end_of_way(way, because, situation)
    rules = situation.rules.grounding
    door = door_near(situation.scene, way, situation.pose, rules) or way.door
    line = CountedDoor(door, 0.0, Side.AHEAD, heading_through(door, way.heading))
    if isinstance(clause, GoToRoom) and clause.approach is Approach.TO:
        return _before_room(line, because, way, situation)
    behind, onward = line.pose(rules.stand_off), line.pose(0.0)
    return PassGoal(behind, door, because, onward=onward, places=way.places)


def _before_room(line: CountedDoor, because: str, way: Way, situation: Situation) -> ReachGoal:
    """The goal in front of a room's door, facing it."""
    accepted = situation.rules.success
    before = line.pose(-situation.rules.grounding.stand_off)
    return ReachGoal(
        before,
        accepted.door_distance,
        accepted.door_heading,
        because,
        line.door,
        places=(*way.places[:-1], before[:2]),
    )


def _end_of_way(way: Way, because: str, situation: Situation) -> ReachGoal:
    """The goal at the end of a way, facing along its last part."""
    (ax, ay), (bx, by) = way.places[-2:]
    accepted = situation.rules.success
    return ReachGoal(
        (bx, by, math.atan2(by - ay, bx - ax)),
        accepted.way_distance,
        because=because,
        offset_tolerance=accepted.way_offset,
        onward=(bx, by, way.heading),
        places=way.places,
    )
