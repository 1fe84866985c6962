"""Parses a text into a `Command`, or into an error that says what would have been right."""

from __future__ import annotations

from collections.abc import Sequence

from semnav_env.language.command import Command, room_of
from semnav_env.language.defaults import decided
from semnav_env.language.errors import AmbiguousCommandError, CommandError
from semnav_env.language.language import Language
from semnav_env.language.languages import english, language_of
from semnav_env.language.rooms import plain_name


def parse(text: str, language: str | Language | None = None, rooms: Sequence[str] = ()) -> Command:
    """The command that a text means.

    Args:
        text: for example "go down the hallway, turn left and go in the first door on the right";
            docs/language.md lists what is understood.
        language: "en", "de" or a `Language`; by default it is recognised.
        rooms: the names of the rooms that there are; empty if they are not known. If given, only
            these are understood, and they need no quotation marks.

    Returns:
        The command; `parse(command.say(language), language) == command`.

    Raises:
        CommandError: some of the text is not understood; nothing is guessed or left out.
        AmbiguousCommandError: it can mean several commands, which are `error.readings`.
        ValueError: there is no such language.
    """
    found = decided(readings(text, language, rooms))
    command, *others = found
    if others:
        spoken = english() if language is None else language_of(language)
        apart = differences(found, spoken)
        later = not command.say(spoken).startswith(apart[0])
        raise AmbiguousCommandError(_beginning(text), found, apart, later=later)
    return command


def correct(command: Command, text: str, language: str | Language = "en") -> Command:
    """A command with its end corrected by a text such as "no, the left one".

    Raises:
        CommandError: the text does not correct that command.
    """
    return parse(f"{command.say(language)}, {text}", language)


def readings(
    text: str, language: str | Language | None = None, rooms: Sequence[str] = ()
) -> tuple[Command, ...]:
    """Every command that a text can mean; like `parse`, but several readings are no error.

    What goes without saying (`defaults`) is not decided here.
    """
    from semnav_env.language.spoken_text import readings_of_text  # here, as it is large

    found = readings_of_text(text, None if language is None else language_of(language), rooms)
    check_rooms(found[0], text, rooms)
    return found


def differences(commands: Sequence[Command], language: Language) -> tuple[str, ...]:
    """For each command, in words, the clauses in which it differs from the others."""
    texts = [[clause.say(language) for clause in command.clauses] for command in commands]
    shortest = min(map(len, texts))
    same = next((i for i in range(shortest) if len({t[i] for t in texts}) > 1), shortest - 1)
    tails = [command.clauses[same:] for command in commands]
    alike = 0
    while min(map(len, tails)) > alike + 1 and len({tail[-1 - alike] for tail in tails}) == 1:
        alike += 1
    return tuple(
        _distinct(command, same, len(command.clauses) - alike).say(language) for command in commands
    )


def _distinct(command: Command, start: int, stop: int) -> Command:
    """The clauses from `start` to `stop`; a single one with the clause from which it counts.

    The whole command where these alone are none, such as a condition without what depends on it.
    """
    try:
        return Command(command.clauses[max(0, start - 1) if start == stop - 1 else start : stop])
    except ValueError:
        return command


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
