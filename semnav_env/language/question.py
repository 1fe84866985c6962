"""A question of the robot: what is open between the readings of a text, and what settles it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, TypeAlias

from semnav_env.language.answers import REJECTED, Choice, choice_of
from semnav_env.language.clauses import Approach, Clause, GoToRoom, IfThere, Stop, Turning
from semnav_env.language.command import Command
from semnav_env.language.declarations import Spoken, field_names, is_ordinal
from semnav_env.language.errors import CommandError
from semnav_env.language.language import Language
from semnav_env.language.phrase_table import plain_words
from semnav_env.language.references import ENTRY, RoomReference, Side
from semnav_env.language.stops import is_stop

Ask: TypeAlias = Callable[[str], str]
"""Asks a person a question and returns the answer, like `input`."""

Read: TypeAlias = Callable[[str], Command]
"""Reads a text as a command, or raises a `CommandError`."""

MOST_WORDS = 12
"""The longest question in which two choices are named, words."""

MOST_QUESTIONS = 5
"""How often a person is asked about one text."""

SAID_ALONE = (Approach, Side, Turning)
"""What is said without the clause or the door that it belongs to: "left, or right?"."""

SHOWN = 200
"""How much of a long text an error keeps, characters."""


@dataclass(frozen=True)
class Question:
    """What a robot asks about a text, in the language of the speaker.

    Attributes:
        readings: the commands that the text can mean, the likelier first. One alone is doubtful.
        language: of the speaker.
        read: reads an answer that is a whole command; without it such answers settle nothing.
        meant: the room for which an unknown word was taken; the question is whether it is meant.
    """

    readings: tuple[Command, ...]
    language: Language = field(repr=False)
    read: Read | None = field(default=None, repr=False, compare=False)
    meant: str | None = None

    @cached_property
    def text(self) -> str:
        """What is asked, such as "Through it, or only up to it?"."""
        if self.meant is not None:
            asked = self.language.say("did_you_mean", word=self.meant)
        elif self.names_both:
            asked = self._of_two
        else:
            asked = self.language.say("question_one", choice=self.choices[0].name)
        return asked[0].upper() + asked[1:]

    @cached_property
    def names_both(self) -> bool:
        """Whether both choices are named; where that takes long, only the likelier one is."""
        return len(self.choices) == 2 and len(self._of_two.split()) <= MOST_WORDS

    @property
    def _of_two(self) -> str:
        first, second = self.choices
        return self.language.say("question_two", first=first.name, second=second.name)

    @cached_property
    def choices(self) -> tuple[Choice, ...]:
        """The likeliest two readings by what they differ in, or the only one."""
        tails = unlike(self.readings[:2])
        parts: tuple[Any, ...] = tails
        if len(tails) == 2 and all(len(tail.clauses) == 1 for tail in tails):
            parts = _open_parts(*(tail.clauses[0] for tail in tails))
        names = [self._said(part) for part in parts]
        if len(set(names)) < len(names):
            names = [tail.say(self.language) for tail in tails]
        full = [reading.say(self.language) for reading in self.readings]
        return tuple(map(Choice, names, full, parts))

    def _said(self, part: Any) -> str:
        """A part in the words of the speaker's language."""
        if isinstance(part, Command) and any(isinstance(c, IfThere) for c in part.clauses):
            return part.say(self.language)
        if isinstance(part, Command):
            return self.language.say("and").join(self._said(clause) for clause in part.clauses)
        if isinstance(part, Approach):
            return self.language.say(f"choice_{part}")
        if is_ordinal(part):
            return self.language.say("choice_ordinal", ordinal=self.language.ordinal(part))
        if isinstance(part, Clause):
            return part.say(self.language, "short")
        said: str = part.say(self.language) if isinstance(part, Spoken) else self.language.say(part)
        return said

    def answer(self, text: str) -> Command:
        """The command that a text means, given an answer such as "the left one" or a whole command.

        Raises:
            AmbiguousCommandError: it is still open; the question is that of the error.
            CommandError: no reading is meant: "no" to the only one, or to both.
        """
        if is_stop(text):
            return Command((Stop(),))
        choice = choice_of(
            plain_words(text), self.choices, self.language, both_named=self.names_both
        )
        if choice is None:
            return self._by_command(text)
        if choice != REJECTED:
            return self.readings[choice]
        if others := self.readings[2 if self.names_both else 1 :]:
            raise AmbiguousCommandError(text, replace(self, readings=others))
        raise CommandError(self.language.say("none_meant"), text)

    def _by_command(self, text: str) -> Command:
        """The reading whose clauses a whole command names, or else that command.

        Raises:
            AmbiguousCommandError: it is none, or leaves the same open.
        """
        if self.read is None:
            raise AmbiguousCommandError(text, self)
        try:
            command = self.read(self._without_reply(text))
        except CommandError:
            raise AmbiguousCommandError(text, self) from None
        matching = [each for each in self.readings if _holds(each, command)]
        return matching[0] if len(matching) == 1 else command

    def _without_reply(self, text: str) -> str:
        """The text without "yes", "no" and the like at its beginning."""
        replies = {*self.language.answers["yes"], *self.language.answers["no"]}
        first, _, rest = text.strip().partition(" ")
        if rest and " ".join(plain_words(first)) in replies:
            return self._without_reply(rest)
        return text


class AmbiguousCommandError(CommandError):
    """A text that can mean several commands, or one that is doubtful.

    Attributes:
        question: what is open, and how it is settled.
    """

    question: Question

    def __init__(self, text: str, question: Question) -> None:
        apart = differences(question.readings, question.language)
        shown = " / ".join(f"'{each}'" if '"' in each else f'"{each}"' for each in apart)
        super().__init__(f"{question.text} ({shown})", text[:SHOWN])
        self.args = (text, question)
        self.question = question

    @property
    def summary(self) -> str:
        """The question, with its choices in canonical words."""
        return self.problem

    @property
    def readings(self) -> tuple[Command, ...]:
        """The commands that the text can mean, the likelier first."""
        return self.question.readings

    @property
    def differences(self) -> tuple[str, ...]:
        """For each reading the clauses in which it differs, in the speaker's language."""
        return differences(self.question.readings, self.question.language)


def ask_until_clear(error: AmbiguousCommandError, ask: Ask) -> Command:
    """The command that a person means who is asked, at most `MOST_QUESTIONS` times.

    Raises:
        AmbiguousCommandError: it is still open then.
        CommandError: no reading is meant.
    """
    for _ in range(MOST_QUESTIONS):
        try:
            return error.question.answer(ask(error.question.text))
        except AmbiguousCommandError as still_open:
            error = still_open
    raise error


def differences(commands: Sequence[Command], language: Language) -> tuple[str, ...]:
    """For each command, in words, the clauses in which it differs from the others."""
    return tuple(tail.say(language) for tail in unlike(commands))


def unlike(commands: Sequence[Command]) -> tuple[Command, ...]:
    """For each command the clauses in which it differs from the others; a single one as it is.

    Clauses that stand for nothing without their neighbours, such as a condition, come with these.
    """
    if len(commands) < 2:
        return tuple(commands)
    told = [command.clauses for command in commands]
    shortest = min(map(len, told))
    head = next((i for i in range(shortest) if len({each[i] for each in told}) > 1), shortest - 1)
    tails = [each[head:] for each in told]
    alike = 0
    while min(map(len, tails)) > alike + 1 and len({tail[-1 - alike] for tail in tails}) == 1:
        alike += 1
    return tuple(_part(command, head, len(command.clauses) - alike) for command in commands)


def _part(command: Command, start: int, stop: int) -> Command:
    """The clauses from `start` to `stop`, or the whole command where these alone are none."""
    try:
        return Command(command.clauses[start:stop])
    except ValueError:
        return command


def _holds(reading: Command, command: Command) -> bool:
    """Whether the clauses of a command stand in a reading, one behind the other."""
    length = len(command.clauses)
    starts = range(len(reading.clauses) - length + 1)
    return any(reading.clauses[at : at + length] == command.clauses for at in starts)


def _open_parts(first: Any, second: Any) -> tuple[Any, Any]:
    """The parts in which two values differ: their only different field, or they themselves."""
    if type(first) is not type(second):
        return first, second
    names = field_names(type(first))
    apart = [name for name in names if getattr(first, name) != getattr(second, name)]
    if len(apart) != 1 or ENTRY in (getattr(each, apart[0]) for each in (first, second)):
        return first, second  # "the door you came in by" is no ordinal
    parts = getattr(first, apart[0]), getattr(second, apart[0])
    if isinstance(first, GoToRoom) and apart[0] == "name":
        return RoomReference(parts[0]), RoomReference(parts[1])
    if all(isinstance(part, Spoken) for part in parts):
        return _open_parts(*parts)
    by_itself = apart[0] == "ordinal" or all(isinstance(p, SAID_ALONE) for p in parts)
    return parts if by_itself else (first, second)
