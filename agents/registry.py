"""Agents by name."""

from __future__ import annotations

from pathlib import Path

from semnav_env.agents.base import Agent
from semnav_env.agents.oracle import OracleAgent
from semnav_env.agents.scripted import ScriptedAgent


def make_agent(name: str) -> Agent:
    """The agent of that name, or the trained one at that path.

    Raises:
        ValueError: neither; says what there is.
    """
    if name == "scripted":
        return ScriptedAgent()
    if name == "oracle":
        return OracleAgent()
    if Path(name).exists():
        from semnav_env.agents.learned import LearnedAgent

        return LearnedAgent.load(name)
    raise ValueError(
        f"no agent {name!r}; there are: scripted, oracle, or the path of a trained one"
    )
