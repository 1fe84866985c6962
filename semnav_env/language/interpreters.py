"""Interpreters of a text: what a user of the package may put in the place of `parse`.

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
from semnav_env.language.named_rooms import check_rooms
from semnav_env.language.normalise import normalise
from semnav_env.language.program import from_program


@dataclass(frozen=True)
class Interpretation:
    """The command that an interpreter took a text for.

    Attributes:
        text: as it was given.
        command: what it means.
        language: its language.
        by: what found the command: "stop", "canonical words", "translator" or "model".
        likeness: probability that the command is meant, 0 to 1; 1 where it is not estimated.
    """

    text: str
    command: Command
    language: Language = field(repr=False)
    by: str
    likeness: float = 1.0

    @property
    def echo(self) -> str:
        """The command in canonical words of the text's language."""
        return self.command.say(self.language)


class Interpreter(Protocol):
    """Anything that turns texts into commands."""

    def interpret(self, text: str) -> Interpretation:
        """What a text means.

        Raises:
            AmbiguousCommandError: it is open which of several commands is meant.
            CommandError: it is not understood.
        """
        ...


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
        check_rooms(command, text, self.rooms, spoken)
        return Interpretation(text, command, spoken, "model")


def _program(answer: object, text: str) -> Command:
    if isinstance(answer, Command):
        return answer
    try:
        plain = json.loads(answer) if isinstance(answer, str | bytes) else answer
        return from_program(plain)
    except (ValueError, RecursionError) as error:
        raise CommandError(f"the model's answer is no program: {error}", text) from None
