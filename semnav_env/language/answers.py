"""Reads a short answer to a question: which choice its words speak for."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Any

from semnav_env.language.command import Command
from semnav_env.language.declarations import Spoken, field_names, is_ordinal
from semnav_env.language.language import Language
from semnav_env.language.phrase_table import PhraseTable, Words, plain_words

REJECTED = -1
"""Stands for "no" to what was named: the only choice, or both."""


@dataclass(frozen=True)
class Choice:
    """What an answer may choose.

    Attributes:
        name: as the question names it.
        full: the whole command in canonical words.
        part: in what it differs: a clause, a door, a side, an ordinal.
    """

    name: str
    full: str
    part: Any


def choice_of(
    words: Words, choices: Sequence[Choice], language: Language, *, both_named: bool
) -> int | None:
    """The number of the choice that a short answer means, or `REJECTED`.

    None if the answer is no such one, or leaves it open.

    Args:
        words: of the answer.
        choices: one or two.
        language: of the answer.
        both_named: whether the question names both choices, and not the first alone.
    """
    exact = [
        number
        for number, choice in enumerate(choices)
        if words in (plain_words(choice.name), plain_words(choice.full))
    ]
    if len(exact) == 1:
        return exact[0]
    table = PhraseTable(_phrases_by_label(choices, language))
    labels = table.labels(words) or table.labels([word.replace("'", "") for word in words])
    if not labels:
        return None
    first, second = _votes(labels)
    if first != second:
        return 0 if first > second else 1
    if "other" in labels and both_named:
        return 1
    if "other" in labels or "no" in labels:
        return REJECTED
    if not both_named:
        return 0 if "yes" in labels else None
    if "first" in labels or "second" in labels:
        return int("second" in labels)
    return None


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


def _phrases_by_label(choices: Sequence[Choice], language: Language) -> dict[object, Iterable[str]]:
    """The phrases of answers: those of the language, and those in which the choices differ."""
    answers = language.answers
    own = [set(_own_phrases(choice, language)) for choice in choices]
    found: dict[object, Iterable[str]] = {label: words for label, words in answers.items()}
    if any(is_ordinal(value) for choice in choices for value in _values(choice.part)):
        del found["first"], found["second"]  # "the second" is then the second door
    if len(own) == 2:
        first, second = own
        found |= {"beside": (*answers["beside"], *(first & second))}
        own = [first - second, second - first]
    return found | {number: sorted(phrases) for number, phrases in enumerate(own)}


def _own_phrases(choice: Choice, language: Language) -> Iterator[str]:
    """The words that name a choice, each alone, and what else its parts are called."""
    yield choice.name
    yield from plain_words(choice.name)
    yield from plain_words(choice.full)
    for value in _values(choice.part):
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
