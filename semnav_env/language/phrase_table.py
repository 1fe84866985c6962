"""Finds the phrases of a fixed list in the words of a text."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from typing import Generic, TypeAlias, TypeVar

Words: TypeAlias = tuple[str, ...]
Label = TypeVar("Label")

_WORD = re.compile(r"[^\W_]+(?:['-][^\W_]+)*")


def plain_words(text: str) -> Words:
    """The words of a text in small letters, without signs; "e-stop" is one word."""
    return tuple(_WORD.findall(text.casefold().replace("’", "'")))


class PhraseTable(Generic[Label]):
    """Phrases, each with a label.

    Args:
        phrases: for each label its phrases. Of a phrase under two labels the last one counts.
    """

    def __init__(self, phrases: Mapping[Label, Iterable[str]]) -> None:
        self._by_first: dict[str, dict[Words, Label]] = {}
        for label, texts in phrases.items():
            for words in filter(None, map(plain_words, texts)):
                self._by_first.setdefault(words[0], {})[words] = label

    def longest(self, words: Sequence[str], at: int) -> tuple[int, Label] | None:
        """How many words from `at` on are the longest phrase there, and its label."""
        found = self._by_first.get(words[at], {}) if at < len(words) else {}
        fitting = [p for p in found if tuple(words[at : at + len(p)]) == p]
        best = max(fitting, key=len, default=None)
        return None if best is None else (len(best), found[best])

    def labels(self, words: Sequence[str]) -> list[Label] | None:
        """The labels of the phrases that words consist of; None if some word is of no phrase."""
        labels: list[Label] = []
        at = 0
        while at < len(words):
            found = self.longest(words, at)
            if found is None:
                return None
            at, labels = at + found[0], [*labels, found[1]]
        return labels
