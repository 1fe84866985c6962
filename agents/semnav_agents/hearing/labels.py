"""Labels for a learner of grounding, from the environment's grounding at one moment.

The label of a clause is its goal on the robot's memory, as `Belief.target` would be, and whether
the clause is done. Imagined clauses can be labelled at the same place, as if they had been said
there; this costs no driving.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from semnav_env.language.clauses import Clause, GoBack, GoToRoom, IfThere
from semnav_env.mind.grounding.clause_order import comes_after_corridor, in_context
from semnav_env.mind.grounding.conditions import is_met
from semnav_env.mind.grounding.errors import GroundingError
from semnav_env.mind.grounding.follower import Follower
from semnav_env.mind.grounding.goal import Goal, GoalKind, ReachGoal, door_of
from semnav_env.mind.grounding.goals import search_goal
from semnav_env.mind.grounding.ground import goal_of
from semnav_env.mind.grounding.known_way import next_on_way
from semnav_env.mind.grounding.search import Searching
from semnav_env.mind.grounding.situation import Situation
from semnav_features.frames import Pose, relative, to_local
from semnav_features.scene import Scene

NEVER_REACHED = 0.0
"""Distance tolerance of a goal that only says where to look."""


@dataclass(frozen=True)
class Label:
    """The label at a moment; poses in the odom frame.

    Attributes:
        goal: the target; None if the clause is over and its goal is not known.
        advance: number of clauses to advance; -1 if this is not known.
    """

    goal: Goal | None
    advance: int


LABEL = np.dtype(
    [
        *((name, "?") for name in ("has_goal", "has_door", "has_next")),
        *((name, "i1") for name in ("kind", "advance")),
        *((name, "f4", size) for name, size in (("pose", 3), ("next", 3), ("door", 4))),
    ]
)
"""A label as it is kept: poses and jambs in the frame of the description, `next` in that of the
goal; advance is -1 where it is not known."""


def as_record(label: Label, frame: Pose) -> NDArray[np.void]:
    """A label in the frame of a description, dtype `LABEL`, shape ()."""
    record = np.zeros((), LABEL)
    record["advance"] = label.advance
    goal = label.goal
    if goal is None:
        return record
    record["kind"], record["has_goal"] = goal.kind, True
    record["pose"] = relative(frame, goal.pose)
    if goal.kind is not GoalKind.SEEK:
        record["has_next"], record["next"] = True, relative(goal.pose, goal.next_begin)
    door = door_of(goal)
    if door is not None:
        record["has_door"] = True
        record["door"] = *to_local(frame, door.start), *to_local(frame, door.end)
    return record


def real_label(follower: Follower, pose: Pose) -> Label | None:
    """The label of the environment's active clause; None if it is impossible."""
    if follower.done or follower.impossible is not None:
        return None
    return Label(follower.target(pose), 0)


def imagined_label(
    clauses: Sequence[Clause], index: int, follower: Follower, scene: Scene, pose: Pose
) -> Label | None:
    """The label of another clause, as if it had been said where the active clause began.

    Args:
        clauses: of another command.
        index: of the clause in it.
        follower: of the environment.
        scene: what the robot remembers, odometry frame.
        pose: of the robot.

    Returns:
        None for a clause that needs a way, or that is impossible there.
    """
    clause = in_context(clauses, index)
    if isinstance(clause, GoToRoom | GoBack):
        return None
    x, y = follower.progress[0]["farthest"].tolist()
    corridor_before = comes_after_corridor(clauses, index)
    rules = follower.rules
    situation = Situation(
        scene, follower.begin, (x, y, pose[2]), False, corridor_before, rules=rules
    )
    try:
        if isinstance(clause, IfThere):
            found = is_met(clause, situation)
            if isinstance(found, Searching):
                return Label(search_goal(found), 0)
            return Label(None, 1 if found.value else 2)
        goal = goal_of(clause, situation)
    except GroundingError:
        return None
    return Label(
        next_on_way(goal, pose, rules.grounding),
        _imagined_advance(goal, pose, rules.grounding.care),
    )


def _imagined_advance(goal: Goal, pose: Pose, care: float) -> int:
    """0 if a goal is clearly not reached; -1 if this depends on how the robot came here."""
    if isinstance(goal, ReachGoal) and goal.distance_tolerance > NEVER_REACHED:
        return -1 if goal.reached_by(pose, care) else 0
    return 0 if goal.kind is GoalKind.SEEK or isinstance(goal, ReachGoal) else -1


def steps_on(clauses: Sequence[Clause], before: int, after: int) -> int:
    """Number of clauses that an index `before` must advance if the index `after` is right.

    Several clauses may be over at once; then each needs its own step.
    """
    condition = clauses[before - 1] if before else None
    if isinstance(clauses[before], IfThere):
        return 1 if after == before + 1 else 2
    return 2 if isinstance(condition, IfThere) and condition.otherwise else 1
