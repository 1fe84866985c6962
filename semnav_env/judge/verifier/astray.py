"""Wrong turns: arms of junctions that a clause does not name, and junctions left behind."""

from __future__ import annotations

import math

import numpy as np

from semnav_env.language.clauses import Clause, Turn
from semnav_env.mind.grounding.goal import Goal, ReachGoal
from semnav_env.rules import SuccessRules
from semnav_features.corridor import SideOpening
from semnav_features.frames import FloatArray


def wrong_arms(clause: Clause, goal: Goal, rules: SuccessRules) -> FloatArray:
    """The arms of the goal's corridor that a clause does not name, shape (k, 5).

    A row is 1 for the left side or -1 for the right, near and far edge along the corridor, distance
    of its side from the axis, and how far inside the arm a robot has gone astray; metres.

    Args:
        clause: under way.
        goal: of that clause, on the true scene.
        rules: how far is too far.
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
    """How far along the goal's corridor a junction to turn at has been missed, metres.

    Infinite where there is none.
    """
    if goal.corridor is None or not isinstance(goal, ReachGoal) or goal.junction is None:
        return math.inf
    return goal.junction.far + rules.missed_turn_distance


def _names(clause: Clause, arm: SideOpening) -> bool:
    return isinstance(clause, Turn) and clause.turning.value == ("left" if arm.left else "right")
