"""Judges what a corpus' sentences are taken for: understood, asked, refused or misread."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from typing import TypeAlias

from semnav_env.language.command import Command
from semnav_env.language.corpora.meanings import meaning_of, normal
from semnav_env.language.corpora.sentences import Sentence
from semnav_env.language.errors import CommandError
from semnav_env.language.question import AmbiguousCommandError

Understand: TypeAlias = Callable[[str, str | None, Sequence[str]], Command]
"""What takes a text for a command, given a language or None and the rooms; like `parse`."""


class ParseOutcome(StrEnum):
    """What became of a sentence.

    UNDERSTOOD: one reading, and it is right; of a plain sentence: one reading.
    ASKED: several readings or a doubtful one, and a right one is among them.
    ASKED_WRONGLY: a question without a right reading.
    REFUSED: an error.
    MISREAD: one reading, and it is wrong.
    """

    UNDERSTOOD = "understood"
    ASKED = "asked"
    ASKED_WRONGLY = "asked wrongly"
    REFUSED = "refused"
    MISREAD = "misread"


@dataclass(frozen=True)
class SentenceVerdict:
    """A sentence and what became of it.

    Attributes:
        sentence: which.
        outcome: what became of it.
        answer: the readings in canonical words, or the error's first line.
    """

    sentence: Sentence
    outcome: ParseOutcome
    answer: tuple[str, ...]


def verdicts(
    sentences: Sequence[Sentence], understand: Understand, language: str | None = None
) -> Iterator[SentenceVerdict]:
    """Judge sentences; the rooms that their meanings name are those of the building.

    Args:
        sentences: of one corpus.
        understand: takes texts for commands, such as `parse`.
        language: forces a language; by default each text is recognised.
    """
    rooms = tuple(dict.fromkeys(rooms_in(each.meanings for each in sentences)))
    return (judge(sentence, rooms, understand, language) for sentence in sentences)


def judge(
    sentence: Sentence, rooms: Sequence[str], understand: Understand, language: str | None = None
) -> SentenceVerdict:
    """What becomes of one sentence."""
    try:
        command = understand(sentence.text, language, rooms)
    except AmbiguousCommandError as error:
        outcome = _asked(sentence, error.readings)
        return SentenceVerdict(sentence, outcome, tuple(map(str, error.readings)))
    except CommandError as error:
        return SentenceVerdict(sentence, ParseOutcome.REFUSED, (error.summary,))
    outcome = ParseOutcome.UNDERSTOOD if _is_right(command, sentence) else ParseOutcome.MISREAD
    return SentenceVerdict(sentence, outcome, (str(command),))


def _asked(sentence: Sentence, readings: Sequence[Command]) -> ParseOutcome:
    right = any(_is_right(each, sentence) for each in readings)
    return ParseOutcome.ASKED if right else ParseOutcome.ASKED_WRONGLY


def _is_right(command: Command, sentence: Sentence) -> bool:
    plain = sentence.kind == "plain"
    return plain or normal(meaning_of(command)) in map(normal, sentence.meanings)


def rooms_in(value: object) -> Iterator[str]:
    """The names of rooms in meanings."""
    if isinstance(value, tuple) and len(value) == 2 and value[0] == "room":
        yield value[1]
    elif isinstance(value, Iterable) and not isinstance(value, str):
        for part in value:
            yield from rooms_in(part)


@dataclass
class Count:
    """How many sentences of a corpus and kind came to which outcome."""

    outcomes: Counter[ParseOutcome] = field(default_factory=Counter)

    @property
    def total(self) -> int:
        """All sentences."""
        return sum(self.outcomes.values())

    def share(self, *outcomes: ParseOutcome) -> float:
        """Share of the sentences with one of the outcomes; NaN of none."""
        found = sum(self.outcomes[each] for each in outcomes)
        return found / self.total if self.total else float("nan")
