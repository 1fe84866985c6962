"""Explains why a text does not fit the grammar, and what would."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from semnav_env.commands.errors import CommandError, listed
from semnav_env.commands.language import NAME, Language
from semnav_env.commands.normalise import NormalisedText
from semnav_env.commands.rooms import spoken_names
from semnav_env.commands.suggest import nearest

if TYPE_CHECKING:
    from lark import UnexpectedToken


def explained(
    unexpected: UnexpectedToken,
    normalised: NormalisedText,
    language: Language,
    rooms: Sequence[str],
) -> CommandError:
    """The error that explains why a text does not fit the grammar.

    Args:
        unexpected: Lark's error.
        normalised: the text.
        language: of the text.
        rooms: names of rooms that could have stood there.
    """
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
        hint = f"the rooms here are: {listed(tuple(rooms))}"
    return CommandError(problem, normalised.original, *place, names, suggestion, hint)


def _expected(unexpected: UnexpectedToken, language: Language) -> list[str]:
    """The terminals that could stand there, in the order of the language's table."""
    accepted: set[str] = unexpected.interactive_parser.accepts()  # type: ignore[no-untyped-call]
    if "$END" not in accepted:
        accepted.discard("_PUNCTUATION")  # allowed, but no help to the reader
    order = [*language.terminals, *language.names]
    return sorted(accepted, key=order.index)


def _suggestion(
    word: str, expected: list[str], language: Language, rooms: Iterable[str]
) -> str | None:
    """The nearest word or room that could stand here, or else the nearest known word."""
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
