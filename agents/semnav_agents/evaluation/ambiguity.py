"""Tests whether an interpreter asks about an ambiguous command, and about the right things."""

from __future__ import annotations

from collections.abc import Callable

from semnav_env.judge.episodes import Episode
from semnav_env.language import (
    AmbiguousCommandError,
    Command,
    CommandError,
    Interpreter,
    LearnedInterpreter,
)


def interpreter_of(episode: Episode) -> Interpreter:
    """The reader of the episode's language, in its building."""
    return LearnedInterpreter(episode.language, episode.plan().room_names)


def misreading(
    episode: Episode, interpreter: Callable[[Episode], Interpreter] = interpreter_of
) -> str:
    """What is wrong with what an interpreter does with an episode's command; empty if nothing is.

    It is right to act on one of the meanings, or to ask about nothing but them.
    """
    readings: tuple[Command, ...]
    try:
        readings = (interpreter(episode).interpret(episode.command).command,)
    except AmbiguousCommandError as error:
        readings = error.readings
    except CommandError as error:
        return f"not understood: {error.summary}"
    if set(readings) <= set(episode.meanings()):
        return ""
    return f"taken for {' / '.join(each.say(episode.language) for each in readings)!r}"
