"""From text to a `Command`, or to an error that says what would have been right."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import accumulate
from typing import TYPE_CHECKING

from semnav_env.commands.clauses import GoToRoom
from semnav_env.commands.command import MAX_CLAUSES, Command
from semnav_env.commands.errors import AmbiguousCommandError, CommandError, some_of
from semnav_env.commands.language import NAME, Language, language_of, languages
from semnav_env.commands.normalise import NormalisedText, normalise
from semnav_env.commands.rooms import plain_name, spoken_names
from semnav_env.commands.suggest import nearest

if TYPE_CHECKING:
    from lark import UnexpectedToken

    from semnav_env.commands.parts import Found


def parse(text: str, language: str | Language = "en", rooms: Sequence[str] = ()) -> Command:
    """Understand a command.

    Args:
        text: for example "go down the hallway, turn left and go in the first door on the right";
            docs/language.md lists what is understood.
        language: "en", "de" or a loaded one.
        rooms: the names of rooms that there are; none if that is not known. Only these are
            understood then, and they need no quotation marks.

    Returns:
        The command; `parse(command.say(language), language) == command`.

    Raises:
        CommandError: any of it is not understood; nothing is guessed or left out.
        AmbiguousCommandError: it can mean several things; `error.readings` are all of them.
        ValueError: there is no such language.
    """
    spoken = language_of(language)
    found = readings(text, spoken, rooms)
    if len(found) > 1:
        raise AmbiguousCommandError(_beginning(text), found, differences(found, spoken))
    return found[0]


def correct(command: Command, text: str, language: str | Language = "en") -> Command:
    """The command that another one becomes by a correction of its end: "no, the left one".

    Raises:
        CommandError: it is no correction of that.
    """
    return parse(f"{command.say(language)}, {text}", language)


def readings(
    text: str, language: str | Language = "en", rooms: Sequence[str] = ()
) -> tuple[Command, ...]:
    """Everything that a text can mean; as `parse`, but more than one reading is no error."""
    spoken = language_of(language)
    try:
        return _readings(text, spoken, rooms)
    except CommandError as error:
        others = (each for each in languages().values() if each is not spoken)
        understood = next((each for each in others if _is_understood(text, each, rooms)), None)
        if understood is None:
            raise
        raise _in_another(error, understood) from None


def _is_understood(text: str, language: Language, rooms: Sequence[str]) -> bool:
    try:
        return bool(_readings(text, language, rooms))
    except CommandError:
        return False


def _in_another(error: CommandError, language: Language) -> CommandError:
    """The error of a text that a command of another language is."""
    name = language.name
    hint = f'this is {name.capitalize()}: say language="{name}", or --language {name}'
    return CommandError(error.problem, error.text, error.position, error.length, hint=hint)


def _readings(text: str, language: Language, rooms: Sequence[str]) -> tuple[Command, ...]:
    from lark import UnexpectedToken  # here, because Lark is slow to import

    from semnav_env.commands.combine import OutOfPlaceError, TooAmbiguousError, commands_of
    from semnav_env.commands.grammar import MeaninglessError, find_clauses

    normalised = normalise(text, language)
    try:
        found = find_clauses(language, normalised.text, tuple(rooms))
        _check_length(found, normalised)
        commands = commands_of(found)
    except UnexpectedToken as unexpected:
        raise _explained(unexpected, normalised, language, rooms) from None
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
    """What each of these commands says where they differ."""
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
    """The clauses from `start` to `stop`, with the one before where counting hangs on it."""
    return Command(command.clauses[max(0, start - 1) if start == stop - 1 else start : stop])


def _check_length(found: Sequence[Found], normalised: NormalisedText) -> None:
    """Refuse commands that have too many clauses in their longest reading."""
    counted = list(accumulate(each.longest for each in found))
    if counted[-1] > MAX_CLAUSES:
        first = next(
            each for each, count in zip(found, counted, strict=True) if count > MAX_CLAUSES
        )
        problem = f"the command has {counted[-1]} clauses; at most {MAX_CLAUSES} are carried out"
        raise _pointed(problem, normalised, first.start, first.stop)


def check_rooms(command: Command, text: str, rooms: Sequence[str]) -> None:
    """Refuse a command that names a room which is not among `rooms`, if any are given.

    Raises:
        CommandError: it does; says which there are.
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


def _explained(
    unexpected: UnexpectedToken,
    normalised: NormalisedText,
    language: Language,
    rooms: Sequence[str],
) -> CommandError:
    expected = _expected(unexpected, language)
    names = tuple(language.call(terminal) for terminal in expected)
    start, stop = unexpected.token.start_pos or 0, unexpected.token.end_pos or 0
    place = normalised.span(start, stop)
    if start == stop:
        return CommandError("the command ends too early", normalised.original, *place, names)
    word = normalised.text[start:stop]
    problem = f'"{word}" is not understood here'
    hint, named = language.hint(word), spoken_names(rooms) if NAME in expected else {}
    suggestion = None if hint else _suggestion(word, expected, language, named)
    if named and not (hint or suggestion):
        hint = f"the rooms here are: {some_of(tuple(rooms))}"
    return CommandError(problem, normalised.original, *place, names, suggestion, hint)


def _expected(unexpected: UnexpectedToken, language: Language) -> list[str]:
    """The terminals that could have followed, in the order of the language's table."""
    accepted: set[str] = unexpected.interactive_parser.accepts()  # type: ignore[no-untyped-call]
    if "$END" not in accepted:
        accepted.discard("_PUNCTUATION")  # allowed there, but of no help
    order = [*language.terminals, *language.names]
    return sorted(accepted, key=order.index)


def _suggestion(
    word: str, expected: list[str], language: Language, rooms: Iterable[str]
) -> str | None:
    """The nearest word or room that could have stood here, or else the nearest known word."""
    written = {
        language.folded(each.casefold()): each
        for terminal in language.terminals
        for each in language.vocabulary(terminal)
    }
    if word in written or not word.isalpha():
        return None
    words = (each for terminal in expected for each in language.vocabulary(terminal))
    fitting = [*(language.folded(each.casefold()) for each in words), *rooms]
    found = nearest(word, fitting) or nearest(word, sorted(written))
    return None if found is None else written.get(found, found)
