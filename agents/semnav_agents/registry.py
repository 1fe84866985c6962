"""Makes agents: by name, by the folder of a trained one, or from a class of the user's own."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TypeAlias

from semnav_agents.base import Agent
from semnav_agents.custom import agent_factory, checked_agent
from semnav_agents.floors import BlindAgent, RandomAgent
from semnav_agents.hearing.agent import HearingAgent, hearing_names, hears
from semnav_agents.learned import LearnedAgent, pretrained_names
from semnav_agents.oracle import OracleAgent
from semnav_agents.scripted import ScriptedAgent, ScriptedTeam
from semnav_agents.searching.agent import Explorer, PlanSearcher
from semnav_agents.searching.finder import Finder
from semnav_agents.team import AgentsOneByOne, AgentTeam

AgentSource: TypeAlias = str | Callable[[], Agent]
"""What an agent is made from, see `make_agent`."""


def listener_drives() -> Agent:
    """The agent without a planner: the grounding of "listener" with the policy of "drive"."""
    return HearingAgent.load("listener", LearnedAgent.load("drive"))


_BUILT_IN: dict[str, Callable[[], Agent]] = {
    "scripted": ScriptedAgent,
    "oracle": OracleAgent,
    "blind": BlindAgent,
    "random": RandomAgent,
    "searcher": PlanSearcher,
    "explorer": Explorer,
    "finder": Finder,
    "listener_drives": listener_drives,
}


def make_agent(source: AgentSource) -> Agent:
    """A new agent.

    Args:
        source: "scripted", "oracle", "blind", "random", "searcher", "explorer", "finder",
            "listener_drives" or a name of `pretrained_names` or `hearing_names`; the folder of a
            trained agent; "package.module:Class"; or a class or function that is called without
            arguments.

    Raises:
        ValueError: there is no such agent, or the object made is not an agent; names correct
            values.
    """
    if not isinstance(source, str):
        if not callable(source):
            raise ValueError(f"{source!r:.80} makes no agent; give its class, or a function")
        return checked_agent(source())
    if source in _BUILT_IN:
        return _BUILT_IN[source]()
    if hears(source):
        return HearingAgent.load(source)
    if source in pretrained_names() or Path(source).exists():
        return LearnedAgent.load(source)
    if ":" in source:
        return _imported_agent(source)
    names = ", ".join((*_BUILT_IN, *pretrained_names(), *hearing_names()))
    more = "the folder of a trained one, or package.module:Class"
    raise ValueError(f"no agent {source!r}; there are: {names}, {more}")


def make_team(source: AgentSource, robots: int) -> AgentTeam:
    """Agents for many robots at once.

    Args:
        source: as `make_agent` takes it.
        robots: how many there are.

    Raises:
        ValueError: as `make_agent`.
    """
    if source in ("scripted", ScriptedAgent):
        return ScriptedTeam(robots)
    return AgentsOneByOne([make_agent(source) for _ in range(robots)])


def _imported_agent(location: str) -> Agent:
    factory = agent_factory(location)
    try:
        agent = factory()
    except Exception as error:
        why = f"{type(error).__name__}: {error}"
        raise ValueError(f"{location}() failed: {why}") from error
    return checked_agent(agent)
