"""Agents by name."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from semnav_env.agents.base import Agent
from semnav_env.agents.learned import LearnedAgent, pretrained_names
from semnav_env.agents.oracle import OracleAgent
from semnav_env.agents.scripted import ScriptedAgent

_WRITTEN: dict[str, Callable[[], Agent]] = {"scripted": ScriptedAgent, "oracle": OracleAgent}


def make_agent(name: str) -> Agent:
    """The agent of that name, or the trained one at that path.

    Raises:
        ValueError: neither; says what there is.
    """
    if name in _WRITTEN:
        return _WRITTEN[name]()
    if name in pretrained_names() or Path(name).exists():
        return LearnedAgent.load(name)
    names = ", ".join((*_WRITTEN, *pretrained_names()))
    raise ValueError(f"no agent {name!r}; there are: {names}, or the path of a trained one")
