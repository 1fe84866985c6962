"""Finds the next target on a known way."""

from __future__ import annotations

import math
from collections.abc import Sequence

from semnav_env.language.told import Told
from semnav_env.mind.grounding.goal import Goal, PassGoal, ReachGoal, SeekGoal
from semnav_env.rules import GroundingRules
from semnav_features.frames import Point, Pose, to_local, to_parent, wrap_angle


def next_on_way(goal: Goal, pose: Pose, rules: GroundingRules) -> Goal:
    """The target of a robot at a pose: the goal, or the next place on a long known way."""
    if not goal.places or (isinstance(goal, ReachGoal) and goal.backwards):
        return goal
    apart = [math.dist(place, pose[:2]) for place in goal.places]
    here = apart.index(min(apart))
    ahead = here + rules.places_ahead
    there = _along(goal.places, ahead)
    if ahead >= len(goal.places) - 1:
        if isinstance(goal, PassGoal) or goal.wall is not None:
            return goal
        there = goal.pose
    stretch = _along(goal.places, here)
    if goal.wall is not None:  # the lane was measured from the wall, so that it has not drifted
        return SeekGoal(there, Told("the wall on the {side}", side=goal.wall))
    before = _along(goal.places, max(here - 1, 0))
    turned = max(abs(wrap_angle(each[2] - there[2])) for each in (before, stretch))
    if turned < rules.straight_way_angle:  # at a bend, an offset is no drift
        offset = to_local(stretch, pose[:2])[1]
        there = _beside(there, offset if abs(offset) < rules.way_drift else 0.0)
    return SeekGoal(there, Told("the way"))


def _along(places: Sequence[Point], index: int) -> Pose:
    """A place of a way, but not its last one, and the direction of the way there."""
    index = min(index, len(places) - 2)
    (x, y), (bx, by) = places[index : index + 2]
    return x, y, math.atan2(by - y, bx - x)


def _beside(there: Pose, offset: float) -> Pose:
    """A place of a straight way, moved sideways by the robot's present offset from the way.

    Therefore the robot stays in the corridor, even if odometry has drifted to a side.
    """
    x, y = to_parent(there, (0.0, offset))
    return x, y, there[2]
