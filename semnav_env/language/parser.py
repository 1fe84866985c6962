"""Reads a text by the grammar: a `Command`, or an error that says what would have been right."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import partial

from semnav_env.language.clauses import Stop
from semnav_env.language.command import Command, room_of
from semnav_env.language.defaults import decided
from semnav_env.language.errors import CommandError
from semnav_env.language.language import Language
from semnav_env.language.languages import language_of
from semnav_env.language.question import (
    AmbiguousCommandError,
    Ask,
    Question,
    Read,
    ask_until_clear,
)
from semnav_env.language.rooms import plain_name
from semnav_env.language.stops import begins_or_ends_with_stop, is_stop

STOP_AT_ONCE = (Command((Stop(),)),)
"""The one reading of a call to stop."""


def read(
    text: str,
    language: str | Language | None = None,
    rooms: Sequence[str] = (),
    ask: Ask | None = None,
) -> Command:
    """The command that a text means by the grammar alone.

    The arguments are those of `semnav_env.language.parse`; `read(command.say(language), language)`
    is the command again.

    Raises:
        CommandError: some of the text is not understood; nothing is guessed or left out.
        AmbiguousCommandError: it can mean several commands, which are `error.readings`.
        ValueError: there is no such language.
    """
    try:
        return only_one(readings(text, language, rooms), text, language, rooms)
    except AmbiguousCommandError as error:
        if ask is None:
            raise
        return ask_until_clear(error, ask)


def only_one(
    found: Sequence[Command], text: str, language: str | Language | None, rooms: Sequence[str]
) -> Command:
    """The one reading of a text, with what goes without saying; see `defaults`.

    Raises:
        AmbiguousCommandError: there are several.
    """
    found = decided(found)
    if len(found) == 1:
        return found[0]
    if begins_or_ends_with_stop(text):
        return STOP_AT_ONCE[0]
    from semnav_env.language.speech.recognition import language_of_text  # large, too

    spoken = language_of_text(text, language)
    raise AmbiguousCommandError(text, Question(found, spoken, _reading(language, rooms)))


def correct(command: Command, text: str, language: str | Language = "en") -> Command:
    """A command with its end corrected by a text such as "no, the left one".

    Raises:
        CommandError: the text does not correct that command.
    """
    return read(f"{command.say(language)}, {text}", language)


def readings(
    text: str, language: str | Language | None = None, rooms: Sequence[str] = ()
) -> tuple[Command, ...]:
    """Every command that a text can mean by the grammar; several readings are no error.

    What goes without saying (`defaults`) is not decided here.
    """
    spoken = None if language is None else language_of(language)
    if isinstance(text, str) and is_stop(text):
        return STOP_AT_ONCE
    from semnav_env.language.spoken_text import readings_of_text  # here, as it is large

    try:
        found = readings_of_text(text, spoken, rooms)
        check_rooms(found[0], text, rooms)
    except CommandError as error:
        if isinstance(text, str) and begins_or_ends_with_stop(text):
            return STOP_AT_ONCE
        if isinstance(error, AmbiguousCommandError):
            answerable = replace(error.question, read=_reading(language, rooms))
            raise AmbiguousCommandError(text, answerable) from None
        raise
    return found


def _reading(language: str | Language | None, rooms: Sequence[str]) -> Read:
    return partial(read, language=language, rooms=rooms)


def check_rooms(command: Command, text: str, rooms: Sequence[str]) -> None:
    """Refuse a command with a room that is not among `rooms`; without `rooms` take any.

    Raises:
        CommandError: there is no such room; the message lists the rooms.
    """
    names = [plain_name(room) for room in rooms]
    for clause in command.clauses:
        name = room_of(clause)
        if name is not None and rooms and name not in names:
            problem = f'there is no room "{name}"'
            raise CommandError(f"{problem}; there are: {', '.join(rooms)}", _beginning(text))


def _beginning(text: str) -> str:
    return text[:200]
