"""Says, clause by clause, whether a command was carried out; it alone knows the floor plan."""

from semnav_env.simulator.sensed import Motion
from semnav_env.verifier.goals import place, plan_goals
from semnav_env.verifier.mission import Mission, plan_mission
from semnav_env.verifier.verdict import FAILURES, Verdict
from semnav_env.verifier.verifier import Verifier

__all__ = [
    "FAILURES",
    "Mission",
    "Motion",
    "Verdict",
    "Verifier",
    "place",
    "plan_goals",
    "plan_mission",
]
