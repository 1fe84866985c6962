"""Phrases with places for other words: "until you <reach>", where "<reach>" is "get to", "see", ...

A table of words has such sets beside its phrases: `"<reach>": "reach|get to|see"`. A set may stand
for a word of a phrase, or for a part of a word: "<walk>ing". It may hold phrases with sets.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import chain, product
from typing import TypeAlias

from semnav_env.language.language import Language
from semnav_env.language.words import pieces

_SET = re.compile(r"<[^>]+>")


@dataclass(frozen=True, eq=False)
class PhraseSet:
    """Phrases of which one stands at a place of another phrase.

    Attributes:
        by_first: the phrases by their first word.
    """

    by_first: dict[str, list[Phrase]] = field(default_factory=dict)

    def add(self, phrase: Phrase) -> None:
        """Put a phrase under each word with which it can begin."""
        for first in first_words(phrase):
            self.by_first.setdefault(first, []).append(phrase)


Phrase: TypeAlias = tuple["str | PhraseSet", ...]
"""The words of a phrase, with sets in the places of some."""


def first_words(phrase: Phrase) -> tuple[str, ...]:
    """The words with which a phrase can begin."""
    first = phrase[0]
    return (first,) if isinstance(first, str) else tuple(first.by_first)


def words_of(phrase: Phrase) -> Iterator[str]:
    """The words of a phrase that belong to no set."""
    return (part for part in phrase if isinstance(part, str))


def ends_of(phrase: Phrase, words: Sequence[str], at: int) -> Iterator[int]:
    """The number of the word behind each way to read a phrase at a word."""
    if not phrase:
        yield at
        return
    if at >= len(words):
        return
    first, rest = phrase[0], phrase[1:]
    if isinstance(first, str):
        if words[at] == first:
            yield from ends_of(rest, words, at + 1)
        return
    behind = {end for each in first.by_first.get(words[at], ()) for end in ends_of(each, words, at)}
    for end in behind:
        yield from ends_of(rest, words, end)


class PhraseCompiler:
    """Makes phrases of the text of a table.

    Args:
        table: rows of phrases; those whose keys are in angle brackets are sets.
        language: folds characters.
    """

    def __init__(self, table: Mapping[str, str], language: Language) -> None:
        self._rows = {key: row.split("|") for key, row in table.items() if key.startswith("<")}
        self._sets: dict[str, PhraseSet] = {}
        self._tokens: dict[str, list[Phrase]] = {}
        self._language = language

    def compiled(self, text: str) -> Iterator[Phrase]:
        """The phrases of a text; several if a set stands for a part of a word."""
        tokens = text.split(" ")
        for token in tokens:
            if token not in self._tokens:  # most words stand in many phrases
                self._tokens[token] = self._token(token)
        for choice in product(*map(self._tokens.__getitem__, tokens)):
            yield tuple(chain.from_iterable(choice))

    def words(self) -> Iterator[str]:
        """The words of the sets that phrases have used."""
        for found in self._sets.values():
            for phrases in found.by_first.values():
                for phrase in phrases:
                    yield from words_of(phrase)

    def _token(self, token: str) -> list[Phrase]:
        if _SET.fullmatch(token):
            return [(self._set(token),)]
        if found := _SET.search(token):
            texts = (token.replace(found[0], each, 1) for each in self._rows[found[0]])
            return [phrase for text in texts for phrase in self.compiled(text)]
        return [plain_words(token, self._language)]

    def _set(self, name: str) -> PhraseSet:
        if name not in self._sets:
            self._sets[name] = made = PhraseSet()
            for text in self._rows[name]:
                for phrase in self.compiled(text):
                    made.add(phrase)
        return self._sets[name]


def plain_words(phrase: str, language: Language) -> tuple[str, ...]:
    """The words of a phrase as they stand in a normalised text."""
    folded = language.folded(phrase.casefold()).replace("ß", "ss")
    return (folded,) if folded.isalpha() else tuple(piece.text for piece in pieces(folded))
