"""The judge: contents of episodes, and whether the command was carried out.

`Judge` gives one word for each clause, a `Verdict`; only the judge knows the floor plan. Its
counters are in its `JudgeRecord`, for compiled code.
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
