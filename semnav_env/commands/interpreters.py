"""Ways to understand a text: by the grammar, by the nearest template, or by a user's own model.

Each gives the same typed program, so what it understood is grounded by the same rules and refused
for the same reasons. Each says what it understood, for somebody to look at.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Protocol

from semnav_env.commands.command import Command
from semnav_env.commands.errors import AmbiguousCommandError, CommandError
from semnav_env.commands.language import Language, language_of
from semnav_env.commands.normalise import normalise
from semnav_env.commands.parser import check_rooms, differences, readings
from semnav_env.commands.program import from_program
from semnav_env.commands.templates import Embedding, Templates, trigrams


@dataclass(frozen=True)
class Interpretation:
    """What a text was taken for.

    Attributes:
        text: as it was given.
        readings: all that it can mean, at least one.
        language: its language.
        by: who understood it: "grammar", "template" or "model".
        likeness: to what is understood for certain, 0 to 1; 1 for the grammar.
    """

    text: str
    readings: tuple[Command, ...]
    language: Language = field(repr=False)
    by: str
    likeness: float = 1.0

    @property
    def command(self) -> Command:
        """The one reading.

        Raises:
            AmbiguousCommandError: there are several.
        """
        if len(self.readings) > 1:
            apart = differences(self.readings, self.language)
            raise AmbiguousCommandError(self.text, self.readings, apart)
        return self.readings[0]

    @property
    def echo(self) -> str:
        """Each reading in canonical words of the text's language, one a line."""
        return "\n".join(command.say(self.language) for command in self.readings)


class Interpreter(Protocol):
    """Understands texts."""

    def interpret(self, text: str) -> Interpretation:
        """What a text means.

        Raises:
            CommandError: it is not understood.
        """
        ...


@dataclass(frozen=True)
class GrammarInterpreter:
    """Understands what the grammar of a language allows, and nothing else.

    Attributes:
        language: code, or a loaded language.
        rooms: names of rooms that there are.
    """

    language: str | Language = "en"
    rooms: Sequence[str] = ()

    def interpret(self, text: str) -> Interpretation:
        """What a text means, all readings; see `readings`."""
        found = readings(text, self.language, self.rooms)
        return Interpretation(text, found, language_of(self.language), "grammar")


@dataclass(frozen=True)
class TemplateInterpreter:
    """Takes what the grammar refuses for the canonical clause that is worded most alike.

    The words that decide (numbers, sides, kinds of places and doors) must be the same ones; only
    the others may differ. A text with a word of negation, choice or condition is refused. Where
    several templates are nearly as near, all of them are readings.

    Attributes:
        language: code, or a loaded language.
        rooms: names of rooms that there are.
        embed: from texts to vectors, shape (n, d); by default counts of letter trigrams.
        enough: least cosine similarity of the words that do not decide.
        margin: templates less than this behind the nearest are readings too.
    """

    language: str | Language = "en"
    rooms: Sequence[str] = ()
    embed: Embedding = trigrams
    enough: float = 0.5
    margin: float = 0.05

    def interpret(self, text: str) -> Interpretation:
        """What a text means; by the grammar if that understands it.

        Raises:
            CommandError: nothing is near enough; what the grammar says of it.
        """
        spoken = language_of(self.language)
        try:
            return GrammarInterpreter(spoken, self.rooms).interpret(text)
        except CommandError as error:
            plain = normalise(text, spoken).text
            near = Templates.of(spoken).nearest(plain, self.embed, self.enough, self.margin)
            if near is None:
                raise error from None
            commands, likeness = near
            return Interpretation(text, commands, spoken, "template", likeness)


@dataclass(frozen=True)
class ModelInterpreter:
    """Asks a language model of the user's own.

    It may answer with a program only: a `Command`, plain lists and dictionaries as `to_program`
    makes them, or those as JSON. Anything else is refused. Whether there is such a door and where
    it leads is decided by `ground`, as for every other command.

    Attributes:
        ask: from a text to an answer.
        language: of the texts and of the echo.
        rooms: names of rooms that there are.
    """

    ask: Callable[[str], object]
    language: str | Language = "en"
    rooms: Sequence[str] = ()

    def interpret(self, text: str) -> Interpretation:
        """What the model makes of a text.

        Raises:
            CommandError: the text has characters that no command has, or the answer is no program.
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
