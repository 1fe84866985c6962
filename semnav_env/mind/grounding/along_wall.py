"""Keeping along the wall of one side: the lane there, as the known way to a goal."""

from __future__ import annotations

import math
from dataclasses import replace

from semnav_env.language.references import Side
from semnav_env.mind.grounding.goal import Goal, PassGoal, ReachGoal, SeekGoal, StopGoal
from semnav_env.mind.grounding.goals import is_search
from semnav_env.mind.grounding.situation import Situation
from semnav_env.mind.grounding.ways import paced
from semnav_env.rules import GroundingRules
from semnav_features.corridor import Corridor
from semnav_features.frames import Point, to_local

HALF_BODY = 0.6
"""A wall counts beside a place over this distance before and behind it, metres: half a body."""

PROBE_STEP = 0.2
"""Distance of the places at which the wall is measured there, metres."""

LEAVES_LANE = 1.0
"""Distance before a door or a junction at which the lane to it ends, metres: room to turn."""


def kept_along(goal: Goal, wall: Side, situation: Situation) -> Goal:
    """A goal to which the robot drives along the wall of one side of the hallway.

    Where the goal lies in the hallway, it is moved to the lane, and is reached anywhere across the
    hallway. A goal on a told way, or on the spot, stays as it is.
    """
    corridor = goal.corridor
    on_the_spot = is_search(goal) and not isinstance(goal, SeekGoal)
    if corridor is None or goal.places or isinstance(goal, StopGoal) or on_the_spot:
        return goal
    rules = situation.rules.grounding
    begin = max(0.0, corridor.along(situation.begin[:2]))
    end, offset = to_local(corridor.frame, goal.pose[:2])
    turns = isinstance(goal, ReachGoal) and goal.fixes_heading
    if isinstance(goal, PassGoal) or turns or abs(offset) > corridor.half_width:
        lane = _lane(corridor, wall, begin, max(begin, end - LEAVES_LANE), rules)
        return replace(goal, wall=wall, places=(*lane, goal.pose[:2]))
    lane = _lane(corridor, wall, begin, end, rules)
    pose = (*lane[-1], goal.pose[2])
    if isinstance(goal, SeekGoal):
        return replace(goal, wall=wall, places=lane, pose=pose)
    across = corridor.half_width + abs(to_local(corridor.frame, pose[:2])[1])
    return replace(
        goal,
        wall=wall,
        places=lane,
        pose=pose,
        onward=goal.next_begin,
        offset_tolerance=max(across, goal.distance_tolerance),
    )


def lane_offset(corridor: Corridor, wall: Side, along: float, rules: GroundingRules) -> float:
    """Offset of the lane from the middle of a hallway, to the left, metres.

    It is 0, the middle, where something stands before the wall.
    """
    left = wall is Side.LEFT
    steps = round(HALF_BODY / PROBE_STEP)
    sides = (corridor.side_at(left, along + PROBE_STEP * k) for k in range(-steps, steps + 1))
    nearest = min(filter(math.isfinite, sides), default=corridor.half_width)
    offset = max(0.0, min(nearest, corridor.half_width) - rules.wall_distance)
    return offset if left else -offset


def lane_end(corridor: Corridor, places: tuple[Point, ...]) -> float:
    """Position along a hallway at which the lane of a goal ends, metres.

    Args:
        corridor: of the goal.
        places: of the goal; those outside the hallway do not belong to the lane.
    """
    lane = [to_local(corridor.frame, place) for place in places]
    return max(along for along, offset in lane if abs(offset) < corridor.half_width)


def _lane(
    corridor: Corridor, wall: Side, begin: float, end: float, rules: GroundingRules
) -> tuple[Point, ...]:
    """Places along a wall, two at least."""
    middle = paced([corridor.place(along)[:2] for along in (begin, end)])
    stops = [corridor.along(place) for place in middle]
    return tuple(
        corridor.place(along, lane_offset(corridor, wall, along, rules))[:2] for along in stops
    )
