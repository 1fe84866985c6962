"""Parses a text into a `Command`, or into an error that says what would have been right."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import accumulate
from typing import TYPE_CHECKING

from semnav_env.commands.clauses import GoToRoom
from semnav_env.commands.command import MAX_CLAUSES, Command
from semnav_env.commands.errors import AmbiguousCommandError, CommandError
from semnav_env.commands.explain import explained
from semnav_env.commands.language import Language
from semnav_env.commands.languages import language_of, languages
from semnav_env.commands.normalise import NormalisedText, normalise
from semnav_env.commands.rooms import plain_name

if TYPE_CHECKING:
    from semnav_env.commands.clause_readings import ClauseReadings


def parse(text: str, language: str | Language = "en", rooms: Sequence[str] = ()) -> Command:
    """The command that a text means.

    Args:
        text: for example "go down the hallway, turn left and go in the first door on the right";
            docs/language.md lists what is understood.
        language: "en", "de" or a `Language`.
        rooms: the names of the rooms that there are; empty if they are not known. If given, only
            these are understood, and they need no quotation marks.

    Returns:
        The command; `parse(command.say(language), language) == command`.

    Raises:
        CommandError: some of the text is not understood; nothing is guessed or left out.
        AmbiguousCommandError: it can mean several commands, which are `error.readings`.
        ValueError: there is no such language.
    """
    spoken = language_of(language)
    found = readings(text, spoken, rooms)
    command, *others = found
    if others:
        raise AmbiguousCommandError(_beginning(text), found, differences(found, spoken))
    return command


def correct(command: Command, text: str, language: str | Language = "en") -> Command:
    """A command with its end corrected by a text such as "no, the left one".

    Raises:
        CommandError: the text does not correct that command.
    """
    return parse(f"{command.say(language)}, {text}", language)


def readings(
    text: str, language: str | Language = "en", rooms: Sequence[str] = ()
) -> tuple[Command, ...]:
    """Every command that a text can mean; like `parse`, but several readings are no error."""
    spoken = language_of(language)
    try:
        return _readings(text, spoken, rooms)
    except CommandError as error:
        others = (each for each in languages().values() if each is not spoken)
        understood = next((each for each in others if _is_understood(text, each, rooms)), None)
        if understood is None:
            raise
        raise _in_other_language(error, understood) from None


def _is_understood(text: str, language: Language, rooms: Sequence[str]) -> bool:
    try:
        return bool(_readings(text, language, rooms))
    except CommandError:
        return False


def _in_other_language(error: CommandError, language: Language) -> CommandError:
    """The error of a text that another language understands, with a hint to that language."""
    name = language.name
    hint = f'this is {name.capitalize()}: say language="{name}", or --language {name}'
    return CommandError(error.problem, error.text, error.position, error.length, hint=hint)


def _readings(text: str, language: Language, rooms: Sequence[str]) -> tuple[Command, ...]:
    from lark import UnexpectedToken  # here, because Lark is slow to import

    from semnav_env.commands.command_readings import TooAmbiguousError, commands_of
    from semnav_env.commands.grammar import MeaninglessError, find_clauses
    from semnav_env.commands.one_reading import OutOfPlaceError

    normalised = normalise(text, language)
    found: list[ClauseReadings] = []
    try:
        found = find_clauses(language, normalised.text, tuple(rooms))
        _check_length(found, normalised)
        commands = commands_of(found)
    except UnexpectedToken as unexpected:
        raise explained(unexpected, normalised, language, rooms) from None
    except MeaninglessError as error:
        raise _pointed(str(error), normalised, error.start, error.stop) from None
    except OutOfPlaceError as error:
        at = found[error.index]
        raise _pointed(str(error), normalised, at.start, at.stop) from None
    except TooAmbiguousError as error:
        raise CommandError(str(error), _beginning(text)) from None
    check_rooms(commands[0], text, rooms)
    return commands


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
    """The clauses from `start` to `stop`; a single one with the clause from which it counts."""
    return Command(command.clauses[max(0, start - 1) if start == stop - 1 else start : stop])


def _check_length(found: Sequence[ClauseReadings], normalised: NormalisedText) -> None:
    """Refuse a text whose longest reading has too many clauses."""
    counted = list(accumulate(each.longest for each in found))
    if counted[-1] > MAX_CLAUSES:
        first = next(
            each for each, count in zip(found, counted, strict=True) if count > MAX_CLAUSES
        )
        problem = f"the command has {counted[-1]} clauses; at most {MAX_CLAUSES} are carried out"
        raise _pointed(problem, normalised, first.start, first.stop)


def check_rooms(command: Command, text: str, rooms: Sequence[str]) -> None:
    """Refuse a command with a room that is not among `rooms`; without `rooms` take any.

    Raises:
        CommandError: there is no such room; the message lists the rooms.
    """
    names = [plain_name(room) for room in rooms]
    for clause in command.clauses:
        if isinstance(clause, GoToRoom) and rooms and clause.name not in names:
            problem = f'there is no room "{clause.name}"'
            raise CommandError(f"{problem}; there are: {', '.join(rooms)}", _beginning(text))


def _pointed(problem: str, normalised: NormalisedText, start: int, stop: int) -> CommandError:
    return CommandError(problem, normalised.original, *normalised.span(start, stop))


def _beginning(text: str) -> str:
    return text[:200]
