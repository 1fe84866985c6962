"""A task gives the request of the next episode."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol, TypeVar, cast, runtime_checkable

import numpy as np

from semnav_env.judge.tasks.request import EpisodeRequest
from semnav_env.language import Command
from semnav_env.world.maps import FloorPlan

_T = TypeVar("_T")


@runtime_checkable
class Task(Protocol):
    """Gives the request of the next episode, if `reset` has no options."""

    def request(self, rng: np.random.Generator) -> EpisodeRequest:
        """The request of the next episode.

        Args:
            rng: random generator of the environment; the only source of randomness.
        """
        ...


@runtime_checkable
class AdaptiveTask(Task, Protocol):
    """A task that is told how its episodes end, such as a curriculum."""

    def note(self, success: bool) -> None:
        """Note that an episode of this task has ended."""


@dataclass(frozen=True)
class CommandTask:
    """Draws a command and a floor plan from lists.

    Attributes:
        commands: texts or `Command`s to draw from; if empty, any that can be carried out.
        floor_plans: names, paths or plans to draw from; if empty, the environment's plan.
        language: language of the texts; None to recognise it.
    """

    commands: Sequence[str | Command] = ()
    floor_plans: Sequence[str | Path | FloorPlan] = ()
    language: str | None = None

    def request(self, rng: np.random.Generator) -> EpisodeRequest:
        """A command and a floor plan, each drawn where there is a choice."""
        command, plan = _drawn(self.commands, rng), _drawn(self.floor_plans, rng)
        return EpisodeRequest(command, self.language, floor_plan=plan)


@dataclass(frozen=True)
class SampledTask:
    """Calls a function for each episode.

    Attributes:
        sample: function from the random generator of the environment to a request.
    """

    sample: Callable[[np.random.Generator], EpisodeRequest]

    def request(self, rng: np.random.Generator) -> EpisodeRequest:
        """The result of the function."""
        return self.sample(rng)


def as_task(value: object) -> Task:
    """Make a task from an argument `task=`.

    Args:
        value: a task; a command, or a list of commands; a function from a generator to an
            `EpisodeRequest`; or None for any command.

    Raises:
        ValueError: something else.
    """
    if value is None:
        return CommandTask()
    if isinstance(value, str | Command):
        return CommandTask((value,))
    if isinstance(value, list | tuple) and value:
        if all(isinstance(each, str | Command) for each in value):
            return CommandTask(tuple(value))
    elif isinstance(value, type):
        pass  # a class is callable, but makes no request
    elif isinstance(value, Task):
        return value
    elif callable(value):
        return SampledTask(cast(Any, value))
    raise ValueError(
        f"task is {value!r:.80}; it must be a command, a list of commands, a function from a "
        "generator to an EpisodeRequest, or an object with request(rng)"
    )


def _drawn(choices: Sequence[_T], rng: np.random.Generator) -> _T | None:
    if len(choices) < 2:
        return choices[0] if choices else None
    return choices[int(rng.integers(len(choices)))]
