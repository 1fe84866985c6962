"""Says, clause by clause, whether a command was carried out; it alone knows the floor plan."""

from semnav_env.judge.verifier.goals import place, plan_goals
from semnav_env.judge.verifier.mission import Mission, plan_mission
from semnav_env.judge.verifier.verdict import FAILURES, Verdict
from semnav_env.judge.verifier.verifier import Verifier
from semnav_env.world.simulator.sensed import Motion

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
