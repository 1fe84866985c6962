"""Reads the answer to a question: a choice in a few words, or a whole command."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from enum import StrEnum
from typing import Any

from semnav_env.language.clauses import Stop
from semnav_env.language.command import Command
from semnav_env.language.declarations import Spoken, field_names, is_ordinal
from semnav_env.language.errors import CommandError
from semnav_env.language.phrase_table import PhraseTable, Words, plain_words
from semnav_env.language.question import AmbiguousCommandError, Question
from semnav_env.language.stops import is_stop

REJECTED = -1
"""Stands for "no" to the only choice that was named."""


def answered(question: Question, text: str) -> Command:
    """The command that an answer means; see `Question.answer`."""
    if is_stop(text):
        return Command((Stop(),))
    words = plain_words(text)
    choice = _choice(question, words)
    if choice is None:
        return _by_command(question, text)
    if choice != REJECTED:
        return question.readings[choice]
    if len(question.readings) > 1:
        raise AmbiguousCommandError(text, replace(question, readings=question.readings[1:]))
    raise CommandError(question.language.say("none_meant"), text)


def _by_command(question: Question, text: str) -> Command:
    """The reading that a whole command names, or the command itself.

    Raises:
        AmbiguousCommandError: it is none, or leaves the same open.
    """
    from semnav_env.language.parser import parse

    said = text
    while (rest := _without_reply(question, said)) != said:
        said = rest
    try:
        command = parse(said, question.language, question.rooms)
    except CommandError:
        raise AmbiguousCommandError(text, question) from None
    matching = [each for each in question.readings if _holds(each, command)]
    return matching[0] if len(matching) == 1 else command


def _without_reply(question: Question, text: str) -> str:
    """The text without a "yes" or "no" at its beginning."""
    first, _, rest = text.strip().partition(" ")
    replies = {*question.language.answers["yes"], *question.language.answers["no"]}
    return rest.strip() if rest and " ".join(plain_words(first)) in replies else text


def _holds(reading: Command, command: Command) -> bool:
    """Whether the clauses of a command stand in a reading, one behind the other."""
    length = len(command.clauses)
    starts = range(len(reading.clauses) - length + 1)
    return any(reading.clauses[at : at + length] == command.clauses for at in starts)


def _choice(question: Question, words: Words) -> int | None:
    """The number of the reading that a short answer means, or `REJECTED`.

    None if the answer is no such one, or leaves it open.
    """
    said = [{_said(question, reading), choice} for reading, choice in _pairs(question)]
    exact = [number for number, texts in enumerate(said) if words in map(plain_words, texts)]
    if len(exact) == 1:
        return exact[0]
    labels = PhraseTable(_phrases_by_label(question)).labels(words)
    if not labels:
        return None
    first, second = _votes(labels)
    if first != second:
        return 0 if first > second else 1
    if "other" in labels or "no" in labels:
        return 1 if question.offers_choice else REJECTED
    if not question.offers_choice:
        return 0 if "yes" in labels else None
    if "first" in labels or "second" in labels:
        return int("second" in labels)
    return None


def _pairs(question: Question) -> Iterator[tuple[Command, str]]:
    return zip(question.readings, question.choices, strict=False)


def _said(question: Question, reading: Command) -> str:
    return reading.say(question.language)


def _votes(labels: Iterable[object]) -> tuple[int, int]:
    """How many phrases speak for each choice; behind "not" they speak for the other one."""
    votes = [0, 0]
    negated = False
    for label in labels:
        if label in ("not", "but"):
            negated = label == "not"
        elif isinstance(label, int):
            votes[1 - label if negated else label] += 1
    return votes[0], votes[1]


def _phrases_by_label(question: Question) -> dict[object, Iterable[str]]:
    """The phrases of answers: those of the language, and those in which the choices differ."""
    answers = question.language.answers
    own = [set(_own_phrases(question, number)) for number in range(len(question.choices))]
    found: dict[object, Iterable[str]] = {label: words for label, words in answers.items()}
    if any(is_ordinal(value) for part in question.open_parts for value in _values(part)):
        del found["first"], found["second"]  # "the second" is then the second door
    if len(own) == 2:
        first, second = own
        found |= {"beside": (*answers["beside"], *(first & second))}
        own = [first - second, second - first]
    return found | {number: sorted(phrases) for number, phrases in enumerate(own)}


def _own_phrases(question: Question, number: int) -> Iterator[str]:
    """The words that name a choice, each alone, and what else its parts are called."""
    language = question.language
    yield question.choices[number]
    yield from plain_words(question.choices[number])
    yield from plain_words(_said(question, question.readings[number]))
    for value in _values(question.open_parts[number]):
        if isinstance(value, StrEnum):
            yield from language.answers.get(value.value, ())
        elif 0 < value <= len(language.ordinals):
            yield from language.ordinals[value - 1]


def _values(part: Any) -> Iterator[StrEnum | int]:
    """The ordinals, sides, ways to turn and approaches in clauses and references."""
    if isinstance(part, Command):
        for clause in part.clauses:
            yield from _values(clause)
    elif isinstance(part, Spoken):
        for name in field_names(type(part)):
            value = getattr(part, name)
            if name == "ordinal" or not is_ordinal(value):
                yield from _values(value)
    elif isinstance(part, StrEnum) or is_ordinal(part):
        yield part
