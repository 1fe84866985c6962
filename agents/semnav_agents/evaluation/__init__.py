"""Measures agents: suites of trials, a runner, results and summaries."""

from semnav_agents.evaluation.ambiguity import interpreter_of, misreading
from semnav_agents.evaluation.conclusion import Extras, conclude
from semnav_agents.evaluation.drive import Drive, drive
from semnav_agents.evaluation.results import (
    LeftOut,
    Result,
    Summary,
    common_causes,
    failure_line,
    summarise,
)
from semnav_agents.evaluation.runner import run_suite
from semnav_agents.evaluation.suites import SUITES, Trial, suite, usual_agent

__all__ = [
    "SUITES",
    "Drive",
    "Extras",
    "LeftOut",
    "Result",
    "Summary",
    "Trial",
    "common_causes",
    "conclude",
    "drive",
    "failure_line",
    "interpreter_of",
    "misreading",
    "run_suite",
    "suite",
    "summarise",
    "usual_agent",
]
