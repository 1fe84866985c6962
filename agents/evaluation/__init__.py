"""Measuring agents: suites of episodes, a runner and a table."""

from semnav_env.agents.evaluation.results import Result, Summary, summarise
from semnav_env.agents.evaluation.runner import run_suite
from semnav_env.agents.evaluation.suites import SUITES, Trial, suite

__all__ = ["SUITES", "Result", "Summary", "Trial", "run_suite", "suite", "summarise"]
