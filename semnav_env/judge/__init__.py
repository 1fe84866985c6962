"""The judge's side: what episodes are about, and whether the command was carried out.

`Judge` says clause by clause whether it was, each in one word, a `Verdict`; it alone knows the
floor plan. What it counts stands in its `JudgeRecord`, for compiled code.
"""

from semnav_env.judge.goals import place, plan_goals
from semnav_env.judge.judge import Judge
from semnav_env.judge.judge_state import Period
from semnav_env.judge.mission import Mission, plan_mission
from semnav_env.judge.verdict import FAILURES, Verdict
from semnav_env.world.simulator.sensed import Motion

__all__ = [
    "FAILURES",
    "Judge",
    "Mission",
    "Motion",
    "Period",
    "Verdict",
    "place",
    "plan_goals",
    "plan_mission",
]
