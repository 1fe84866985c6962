"""Grounding: what a clause refers to in a scene, and how far the robot is in following it."""

from semnav_env.grounding.errors import GroundingError, UnclearError
from semnav_env.grounding.goal import Goal, GoalKind, PassGoal, ReachGoal, SeekGoal, StopGoal
from semnav_env.grounding.ground import ground

__all__ = [
    "Goal",
    "GoalKind",
    "GroundingError",
    "PassGoal",
    "ReachGoal",
    "SeekGoal",
    "StopGoal",
    "UnclearError",
    "ground",
]
