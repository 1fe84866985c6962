"""The words of a language: which phrases belong to which class.

A phrase may have several classes; the translator decides by what stands around it.
"""

from __future__ import annotations

import json
from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cache, lru_cache
from importlib.resources import files
from typing import TypeAlias

from semnav_env.language.language import Language
from semnav_env.language.vocabulary.phrases import (
    Phrase,
    PhraseCompiler,
    ends_of,
    first_words,
    words_of,
)

Match: TypeAlias = tuple[str, int]
"""The value of a phrase, and the number of the first word behind it."""

Entry: TypeAlias = tuple[Phrase, str, str, frozenset[str]]
"""A phrase with its class, its value, and the words that it has in any case."""

LONGEST_PHRASE = 12
"""The most words of a phrase."""

MIN_COMPOUND = 6
"""The fewest letters of a word that is taken apart."""


@dataclass(frozen=True, eq=False)
class Lexicon:
    """The phrases of a language.

    Attributes:
        by_first: the phrases by the words with which they can begin.
        words: every word of every phrase.
        language: of the phrases.
    """

    by_first: dict[str, list[Entry]]
    words: frozenset[str]
    language: Language

    def matches(self, words: Sequence[str], at: int) -> Iterator[tuple[str, str, int]]:
        """Class, value and end of every phrase that begins at a word, longest first."""
        window = tuple(words[at : at + LONGEST_PHRASE])
        return ((kind, value, at + length) for kind, value, length in self._matches(window))

    @cache  # noqa: B019 - as below
    def of_class(self, kind: str) -> frozenset[str]:
        """The single words of a class, such as "noun" or "noun area"."""
        return frozenset(
            first
            for first, phrases in self.by_first.items()
            for phrase, each, value, _ in phrases
            if kind in (each, f"{each} {value}") and phrase == (first,)
        )

    @lru_cache(maxsize=20_000)  # noqa: B019 - the few lexicons live as long as the process
    def _matches(self, window: tuple[str, ...]) -> tuple[tuple[str, str, int], ...]:
        """Class, value and length of every phrase with which some words begin, longest first."""
        present = frozenset(window)
        found = {
            (kind, value, length): None
            for phrase, kind, value, needed in (self.by_first.get(window[0], ()) if window else ())
            if needed <= present  # most phrases end here, which is much faster than reading them
            for length in ends_of(phrase, window, 0)
        }
        return tuple(sorted(found, key=lambda match: -match[2]))

    def find(self, words: Sequence[str], at: int, kind: str) -> Match | None:
        """Value and end of the longest phrase of a class at a word; None if there is none."""
        if at >= len(words):
            return None
        found = ((value, stop) for k, value, stop in self.matches(words, at) if k == kind)
        return next(found, None)


@cache
def lexicon_of(language: Language) -> Lexicon:
    """The lexicon of a language, read at the first call."""
    file = files("semnav_env.language.vocabulary") / f"{language.name}.json"
    table: dict[str, str] = json.loads(file.read_text("utf-8"))
    rows = ((key, row) for key, row in table.items() if not key.startswith("<"))
    phrases = [(phrase, *_class_and_value(key)) for key, row in rows for phrase in row.split("|")]
    phrases += [(word, "ordinal", str(n)) for word, n in _ordinals(language)]
    phrases += [(word, "number", str(n)) for word, n in _numbers(language)]
    return _indexed(phrases, PhraseCompiler(table, language), language)


def _class_and_value(key: str) -> tuple[str, str]:
    kind, _, value = key.partition(" ")
    return (kind, value) if kind in VALUED else (key, "")


VALUED = ("number", "verb", "no", "prep", "adj", "noun", "side", "where", "particle", "angle")
"""Classes whose keys have a value behind them."""


def _ordinals(language: Language) -> Iterator[tuple[str, int]]:
    for n, words in enumerate(language.ordinals, 1):
        yield from ((word, n) for word in words)
    for n, words in enumerate(language.from_end, 1):
        yield from ((word, -n) for word in words)


def _numbers(language: Language) -> Iterator[tuple[str, float]]:
    yield from language.numbers.items()
    yield from compound_numbers(language)


def compound_numbers(language: Language) -> Iterator[tuple[str, float]]:
    """Number words from 21 to 99 that are made of a ten and a one."""
    pattern = language.phrases.get("tens_and_ones", "{tens}-{ones}")
    spoken = {v: w for w, v in reversed(language.numbers.items()) if v == int(v)}
    for tens in range(20, 100, 10):
        for ones in range(1, 10):
            if tens in spoken and ones in spoken:
                yield pattern.format(tens=spoken[tens], ones=spoken[ones]), tens + ones


def _indexed(
    texts: Iterable[tuple[str, str, str]], compiler: PhraseCompiler, language: Language
) -> Lexicon:
    by_first: defaultdict[str, list[Entry]] = defaultdict(list)
    known: set[str] = set()
    for text, kind, value in texts:
        for phrase in compiler.compiled(text):
            needed = frozenset(words_of(phrase))
            known.update(() if kind == "beyond" else needed)
            entry = phrase, kind, value, needed
            for first in first_words(phrase):
                by_first[first].append(entry)
    return Lexicon(dict(by_first), frozenset(known.union(compiler.words())), language)


@cache
def mixed(main: Lexicon, other: Lexicon) -> Lexicon:
    """A lexicon with the phrases of another language that begin with a word that it has not."""
    borrowed = {
        first: found for first, found in other.by_first.items() if first not in main.by_first
    }
    return Lexicon({**borrowed, **main.by_first}, main.words | other.words, main.language)


def parts_of(word: str, lexicon: Lexicon) -> tuple[str, ...]:
    """The known words of which an unknown one is made; the word itself if it is made of none.

    A separable verb is a particle and a verb, with "zu" between them or not ("hineinzufahren"). Of
    a compound the last part says what it is ("Flurkreuzung").
    """
    if word in lexicon.words or not word.isalpha():
        return (word,)
    if word.endswith("ste") and lexicon.find((word[:-1],), 0, "verb"):
        return word[:-1], "du"  # "kannste"
    if len(word) < MIN_COMPOUND:
        return (word,)
    for first in sorted(lexicon.of_class("separable"), key=len, reverse=True):
        rest = word.removeprefix(first)
        if rest != word:
            for verb in (rest, rest.removeprefix("zu")):
                if lexicon.find((verb,), 0, "verb"):
                    return verb, first
    for first in lexicon.of_class("compound"):
        rest = word.removeprefix(first)
        if rest != word and lexicon.find((rest,), 0, "noun"):
            return (rest,)
    return (word,)
