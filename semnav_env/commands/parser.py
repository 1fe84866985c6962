"""From text to a `Command`, or to an error that says what would have been right."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from semnav_env.commands.command import MAX_CLAUSES, Command
from semnav_env.commands.errors import CommandError
from semnav_env.commands.language import Language, english
from semnav_env.commands.normalise import NormalisedText, normalise
from semnav_env.commands.suggest import nearest

if TYPE_CHECKING:
    from lark import UnexpectedInput

_WORD = re.compile(r"[\w'-]+|.")


def parse(text: str) -> Command:
    """Understand a command in English.

    Args:
        text: for example "go down the hallway, turn left and go in the first door on the right";
            docs/language.md lists what is understood.

    Returns:
        The command; `parse(str(command)) == command`.

    Raises:
        CommandError: any of it is not understood; nothing is guessed or left out.
    """
    return parse_in(english(), text)


def parse_in(language: Language, text: str) -> Command:
    """Understand a command in a language; as `parse`."""
    from lark import UnexpectedInput  # here, because Lark is slow to import

    from semnav_env.commands.grammar import find_clauses

    normalised = normalise(text, language)
    try:
        found = find_clauses(language, normalised.text)
    except UnexpectedInput as unexpected:
        raise _explained(unexpected, normalised, language) from None
    if len(found) > MAX_CLAUSES:
        problem = f"the command has {len(found)} clauses; at most {MAX_CLAUSES} are carried out"
        too_many = found[MAX_CLAUSES]
        raise CommandError(problem, text, *normalised.span(too_many.start, too_many.stop))
    return Command(tuple(each.clause for each in found))


def _explained(
    unexpected: UnexpectedInput, normalised: NormalisedText, language: Language
) -> CommandError:
    expected = _expected(unexpected, language)
    names = tuple(language.call(terminal) for terminal in expected)
    start, stop = _fault(unexpected, normalised.text)
    place = normalised.span(start, stop)
    if start == stop:
        return CommandError("the command ends too early", normalised.original, *place, names)
    word = normalised.text[start:stop]
    problem = f'"{word}" is not understood here'
    suggestion = _suggestion(word, expected, language)
    hint = None if suggestion else language.hint(word)
    return CommandError(problem, normalised.original, *place, names, suggestion, hint)


def _fault(unexpected: UnexpectedInput, text: str) -> tuple[int, int]:
    """Start and end of the word that was not understood; both the end of the text if none."""
    from lark import UnexpectedToken

    if isinstance(unexpected, UnexpectedToken) and unexpected.token.type == "$END":
        return len(text), len(text)
    start = unexpected.pos_in_stream or 0
    word = _WORD.match(text, start)
    return start, word.end() if word else start


def _expected(unexpected: UnexpectedInput, language: Language) -> list[str]:
    """The terminals that could have followed, in the order of the language's table."""
    accepted: set[str] = unexpected.interactive_parser.accepts()  # type: ignore[no-untyped-call]
    if "$END" not in accepted:
        accepted.discard("_PUNCTUATION")  # allowed there, but of no help
    order = [*language.terminals, *language.names]
    return sorted(accepted, key=order.index)


def _suggestion(word: str, expected: list[str], language: Language) -> str | None:
    """The nearest word that could have stood here, or else the nearest known word."""
    known = {each for terminal in language.terminals for each in language.vocabulary(terminal)}
    if word in known or not word.isalpha():
        return None
    fitting = [each for terminal in expected for each in language.vocabulary(terminal)]
    return nearest(word, fitting) or nearest(word, sorted(known))
