"""Agents: scripted, oracle, learned, and floors of benchmarks, behind one interface."""

from typing import TYPE_CHECKING

from semnav_features.lazy_names import lazy_names

if TYPE_CHECKING:
    from semnav_agents.base import Agent
    from semnav_agents.registry import make_agent, make_team

__all__ = ["Agent", "make_agent", "make_team"]

__getattr__ = lazy_names(__name__, {".base": ("Agent",), ".registry": ("make_agent", "make_team")})
