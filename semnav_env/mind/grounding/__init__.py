"""Grounding: the referent of a clause in a scene, and the robot's progress in the clause.

Calls go one way: a `Follower` has the active clause grounded (`ground`, `conditions`), goals are
made (`goals`, `corridor_goals`) of what is found (`find`), and finding asks what there is in a
situation (`counted_doors`, `behind`, `junctions`, `opposite`, `visible_doors`, `room_exits`).
"""

from semnav_env.mind.grounding.errors import GroundingError, UnclearError
from semnav_env.mind.grounding.goal import Goal, GoalKind, PassGoal, ReachGoal, SeekGoal, StopGoal
from semnav_env.mind.grounding.ground import ground
from semnav_env.mind.grounding.own_clause import GroundedClause
from semnav_env.mind.grounding.situation import Situation

__all__ = [
    "Goal",
    "GoalKind",
    "GroundedClause",
    "GroundingError",
    "PassGoal",
    "ReachGoal",
    "SeekGoal",
    "Situation",
    "StopGoal",
    "UnclearError",
    "ground",
]
