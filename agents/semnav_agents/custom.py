"""Agents of the user, found by module and class: `my_package.my_module:MyAgent`."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from importlib import import_module
from types import ModuleType
from typing import Any

from semnav_agents.base import Agent
from semnav_env.language.vocabulary.typos import did_you_mean

METHODS = {"reset": "reset(info)", "act": "act(observation)"}
"""Methods of an agent, and how they are called."""


def agent_factory(location: str) -> Callable[[], Any]:
    """The class or function at "module:name"; the current directory is searched last.

    Raises:
        ValueError: there is no such module, it cannot be imported, or it has no such name.
    """
    module_name, _, name = location.partition(":")
    if not module_name or not name:
        raise ValueError(f"{location!r} names no agent; give package.module:Class")
    module = _module(module_name)
    factory = getattr(module, name, None)
    if factory is None:
        there = [word for word, value in vars(module).items() if isinstance(value, type)]
        classes = ", ".join(there) or "none"
        hint = did_you_mean(name, there)
        raise ValueError(f"module {module_name!r} has no {name!r}; its classes: {classes}{hint}")
    if not callable(factory):
        right = "a class, or a function that makes an agent"
        raise ValueError(f"{location} is {factory!r:.80}; give {right}")
    made: Callable[[], Any] = factory
    return made


def _module(name: str) -> ModuleType:
    folder = os.getcwd()
    if folder not in sys.path:
        sys.path.append(folder)
    try:
        return import_module(name)
    except (Exception, SystemExit) as error:
        missing = error.name if isinstance(error, ModuleNotFoundError) else None
        if missing is None or not f"{name}.".startswith(f"{missing}."):
            why = f"{type(error).__name__}: {error}"
            raise ValueError(f"module {name!r} cannot be imported: {why}") from error
        hint = "; leave out .py" if name.endswith(".py") else ""
        where = f"neither installed nor in {folder!r}{hint}"
        raise ValueError(f"there is no module {name!r}: {where}") from None


def checked_agent(agent: Any) -> Agent:
    """The object itself, if it is an agent.

    Raises:
        ValueError: it lacks a part of the `Agent` protocol; says which.
    """
    missing = [call for name, call in METHODS.items() if not callable(getattr(agent, name, None))]
    if getattr(agent, "observation", None) is None:
        missing.insert(0, "the attribute observation")
    if missing:
        raise ValueError(f"{type(agent).__name__} is no agent: it lacks {' and '.join(missing)}")
    checked: Agent = agent
    return checked
