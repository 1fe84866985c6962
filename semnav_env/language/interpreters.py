"""Interpreters of a text: the grammar, or a model of the user's own.

Each gives commands of the same type. So what it understood is grounded by the same rules, is
refused for the same reasons, and can be said in canonical words for a person to check.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Protocol

from semnav_env.language.command import Command
from semnav_env.language.errors import CommandError
from semnav_env.language.language import Language
from semnav_env.language.languages import language_of
from semnav_env.language.normalise import normalise
from semnav_env.language.parser import check_rooms, only_one, readings
from semnav_env.language.program import from_program


@dataclass(frozen=True)
class Interpretation:
    """The commands that an interpreter took a text for.

    Attributes:
        text: as it was given.
        readings: every command that it can mean, at least one.
        language: its language.
        by: what found the command: "grammar", "translator" or "model".
        likeness: probability that the command is meant, 0 to 1; 1 where it is not estimated.
    """

    text: str
    readings: tuple[Command, ...]
    language: Language = field(repr=False)
    by: str
    likeness: float = 1.0

    @property
    def command(self) -> Command:
        """The one reading, with what goes without saying; see `defaults`.

        Raises:
            AmbiguousCommandError: there are several.
        """
        return only_one(self.readings, self.text, self.language, ())

    @property
    def echo(self) -> str:
        """Each reading in canonical words of the text's language, one a line."""
        return "\n".join(command.say(self.language) for command in self.readings)


class Interpreter(Protocol):
    """Anything that turns texts into commands."""

    def interpret(self, text: str) -> Interpretation:
        """What a text means.

        Raises:
            CommandError: it is not understood.
        """
        ...


@dataclass(frozen=True)
class GrammarInterpreter:
    """Understands exactly the texts that the grammar of a language allows.

    Attributes:
        language: code, or a loaded language.
        rooms: names of the rooms of the floor plan; none if they are not known.
    """

    language: str | Language = "en"
    rooms: Sequence[str] = ()

    def interpret(self, text: str) -> Interpretation:
        """Every reading of a text; see `semnav_env.language.readings`."""
        found = readings(text, self.language, self.rooms)
        return Interpretation(text, found, language_of(self.language), "grammar")


@dataclass(frozen=True)
class ModelInterpreter:
    """Asks a language model of the user's own.

    The model answers with a `Command`, with plain lists and dictionaries as `to_program` makes
    them, or with those as JSON. Anything else is refused. As for every other command, `ground`
    decides whether there is such a door and which one it is.

    Attributes:
        ask: from a text to an answer.
        language: of the texts and of the echo.
        rooms: names of the rooms of the floor plan; none if they are not known.
    """

    ask: Callable[[str], object]
    language: str | Language = "en"
    rooms: Sequence[str] = ()

    def interpret(self, text: str) -> Interpretation:
        """The command that the model gives for a text.

        Raises:
            CommandError: the text has characters that no command has, or the answer is no command.
        """
        spoken = language_of(self.language)
        normalise(text, spoken)
        command = _program(self.ask(text), text)
        check_rooms(command, text, self.rooms)
        return Interpretation(text, (command,), spoken, "model")


def _program(answer: object, text: str) -> Command:
    if isinstance(answer, Command):
        return answer
    try:
        plain = json.loads(answer) if isinstance(answer, str | bytes) else answer
        return from_program(plain)
    except (ValueError, RecursionError) as error:
        raise CommandError(f"the model's answer is no program: {error}", text) from None
