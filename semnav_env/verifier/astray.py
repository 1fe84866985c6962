"""Wrong turns: arms of junctions that a clause does not name."""

from __future__ import annotations

from semnav_env.commands.clauses import Clause, Turn
from semnav_env.features.corridor import SideOpening
from semnav_env.features.frames import Pose, to_local
from semnav_env.grounding.goal import Goal, ReachGoal
from semnav_env.rules import SuccessRules


def went_astray(clause: Clause, goal: Goal, pose: Pose, rules: SuccessRules) -> bool:
    """Whether the robot left the corridor by an arm that the clause does not name.

    Args:
        clause: under way.
        goal: of that clause, on the true scene.
        pose: of the robot's centre, world frame.
        rules: how far is too far.
    """
    if goal.corridor is None:
        return False
    wanted = goal.junction if isinstance(goal, ReachGoal) else None
    along, offset = to_local(goal.corridor.frame, (pose[0], pose[1]))
    for junction in goal.corridor.junctions if abs(offset) > rules.wrong_arm_depth else ():
        for opening in (junction.left, junction.right):
            if opening is None or not opening.near < along < opening.far:
                continue
            depth = (offset if opening.left else -offset) - opening.offset
            named = wanted is junction and _names(clause, opening)
            ahead = opening.far > rules.passed_arm_distance
            if depth > rules.wrong_arm_depth and ahead and not named:
                return True
    return wanted is not None and along > wanted.far + rules.missed_turn_distance


def _names(clause: Clause, opening: SideOpening) -> bool:
    return isinstance(clause, Turn) and clause.turning.value == (
        "left" if opening.left else "right"
    )
