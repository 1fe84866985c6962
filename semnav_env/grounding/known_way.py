"""Driving along a way that is known: the next place on it to head for."""

from __future__ import annotations

import math
from collections.abc import Sequence

from semnav_env.features.frames import Point, Pose, to_local, to_parent, wrap_angle
from semnav_env.grounding.goal import BESIDE, Goal, PassGoal, SeekGoal

PLACES_AHEAD = 2
"""A robot on a way that it knows heads for so many places farther on."""

STRAIGHT = 0.6
"""A way that turns by less leads straight on, radians."""


def next_on_way(goal: Goal, pose: Pose) -> Goal:
    """What a robot at a pose should head for: the goal, or the next place on a long known way."""
    if not goal.places:
        return goal
    apart = [math.dist(place, pose[:2]) for place in goal.places]
    here = apart.index(min(apart))
    ahead = here + PLACES_AHEAD
    there = _along(goal.places, ahead)
    if ahead >= len(goal.places) - 1:
        if isinstance(goal, PassGoal):
            return goal
        there = goal.pose
    if abs(wrap_angle(_along(goal.places, here)[2] - there[2])) < STRAIGHT:
        there = _as_far_beside(there, to_local(_along(goal.places, here), pose[:2])[1])
    return SeekGoal(there, "the way")


def _along(places: Sequence[Point], index: int) -> Pose:
    """A place of a way, or the one before the last, and the direction of the way there."""
    index = min(index, len(places) - 2)
    (x, y), (bx, by) = places[index : index + 2]
    return x, y, math.atan2(by - y, bx - x)


def _as_far_beside(there: Pose, beside: float) -> Pose:
    """The place as far beside one on a straight way as the robot is beside the way here.

    So a corridor is driven down where it is, however far odometry has drifted to a side.
    """
    x, y = to_parent(there, (0.0, beside if abs(beside) < BESIDE else 0.0))
    return x, y, there[2]
