"""Finds wrong ways: doors and arms that a clause does not name, and missed junctions."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np

from semnav_env.language.clauses import Clause, Turn
from semnav_env.mind.grounding.crossing import first_crossed
from semnav_env.mind.grounding.goal import Goal, PassGoal, ReachGoal, StopGoal
from semnav_env.rules import SuccessRules
from semnav_env.world.maps.floor_plan import PlanDoor
from semnav_features.corridor import SideOpening
from semnav_features.frames import FloatArray
from semnav_features.rules import DoorRules


def may_cross(goal: Goal, crossed: PlanDoor, rules: DoorRules) -> bool:
    """Whether a goal allows the robot to cross a door.

    The goal is to pass exactly this door, lies beyond it on the known way, or allows every door.
    An opening that is too wide to count as a door may always be crossed.
    """
    if crossed.is_opening(rules) or (isinstance(goal, StopGoal) and goal.roams):
        return True
    if isinstance(goal, PassGoal) and goal.door.name == crossed.name:
        return True
    line = np.array([(*crossed.start, *crossed.end)])
    return any(first_crossed(line, *a, *b) == 0 for a, b in pairwise(goal.places))


def wrong_arms(clause: Clause, goal: Goal, rules: SuccessRules) -> FloatArray:
    """The arms of the goal's corridor that a clause does not name, shape (k, 5).

    A row is 1 for the left side or -1 for the right, near and far edge along the corridor, distance
    of its side from the axis, and how far inside the arm a robot has gone astray; metres.

    Args:
        clause: the active clause.
        goal: the goal of that clause, on the true scene.
        rules: the limits of wrong turns.
    """
    named = goal.junction if isinstance(goal, ReachGoal) else None
    rows = [
        (1.0 if arm.left else -1.0, arm.near, arm.far, arm.offset, rules.wrong_arm_depth)
        for junction in (goal.corridor.junctions if goal.corridor is not None else ())
        for arm in junction.openings
        if arm.far > rules.passed_arm_distance and not (junction is named and _names(clause, arm))
    ]
    return np.array(rows, dtype=np.float64).reshape(-1, 5)


def missed_beyond(goal: Goal, rules: SuccessRules) -> float:
    """Distance along the goal's corridor beyond which its junction has been missed, metres.

    Infinite where there is none.
    """
    if goal.corridor is None or not isinstance(goal, ReachGoal) or goal.junction is None:
        return math.inf
    return goal.junction.far + rules.missed_turn_distance


def _names(clause: Clause, arm: SideOpening) -> bool:
    return isinstance(clause, Turn) and clause.turning.value == ("left" if arm.left else "right")
