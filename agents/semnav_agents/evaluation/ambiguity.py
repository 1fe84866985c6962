"""Tests whether an interpreter finds all readings of an ambiguous command."""

from __future__ import annotations

from collections.abc import Callable

from semnav_env.judge.episodes import Episode
from semnav_env.language import CommandError, GrammarInterpreter, Interpreter


def grammar_of(episode: Episode) -> Interpreter:
    """The grammar of the episode's language, in its building."""
    return GrammarInterpreter(episode.language, episode.plan().room_names)


def misreading(episode: Episode, interpreter: Callable[[Episode], Interpreter] = grammar_of) -> str:
    """The error in the readings that an interpreter finds; empty if they are right."""
    try:
        found = interpreter(episode).interpret(episode.command)
    except CommandError as error:
        return f"not understood: {error.summary}"
    if set(found.readings) == set(episode.meanings()):
        return ""
    return f"taken for {found.echo!r}"
