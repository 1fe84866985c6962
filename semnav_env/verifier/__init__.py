"""Says, clause by clause, whether a command was carried out. It alone knows the floor plan."""

from semnav_env.verifier.goals import place, plan_goals
from semnav_env.verifier.verdict import FAILURES, Verdict
from semnav_env.verifier.verifier import Motion, Verifier

__all__ = ["FAILURES", "Motion", "Verdict", "Verifier", "place", "plan_goals"]
