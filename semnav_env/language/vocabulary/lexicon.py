"""The words of a language for its speech parser: which phrases may mean what.

A phrase may have several meanings; `semnav_env.language.vocabulary.phrases` decides by what stands
around it.
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
from semnav_env.language.words import TextPiece

Match: TypeAlias = tuple[str, int]
"""The value of a phrase, and the number of the first word behind it."""

LONGEST_PHRASE = 12
"""The most words of a phrase."""

MIN_COMPOUND = 6
"""The fewest letters of a word that is taken apart."""


@dataclass(frozen=True, eq=False)
class SpeechLexicon:
    """The phrases of a language.

    Attributes:
        by_first: the phrases with their class and value, by the words with which they can begin.
        words: every word of every phrase.
        language: of the phrases.
    """

    by_first: dict[str, list[tuple[Phrase, str, str]]]
    words: frozenset[str]
    language: Language

    def matches(self, words: Sequence[str], at: int) -> Iterator[tuple[str, str, int]]:
        """Class, value and end of every phrase that begins at a word, longest first."""
        window = tuple(words[at : at + LONGEST_PHRASE])
        return ((kind, value, at + length) for kind, value, length in self._matches(window))

    @cache  # noqa: B019 - as below
    def of_class(self, kind: str) -> frozenset[str]:
        """The single words of a class."""
        return frozenset(
            first
            for first, phrases in self.by_first.items()
            for phrase, each, _ in phrases
            if each == kind and phrase == (first,)
        )

    @lru_cache(maxsize=20_000)  # noqa: B019 - the few lexicons live as long as the process
    def _matches(self, window: tuple[str, ...]) -> tuple[tuple[str, str, int], ...]:
        """Class, value and length of every phrase with which some words begin, longest first."""
        found = {
            (kind, value, length): None
            for phrase, kind, value in (self.by_first.get(window[0], ()) if window else ())
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
def lexicon_of(language: Language) -> SpeechLexicon:
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
) -> SpeechLexicon:
    by_first: defaultdict[str, list[tuple[Phrase, str, str]]] = defaultdict(list)
    known: set[str] = set()
    for text, kind, value in texts:
        for phrase in compiler.compiled(text):
            known.update(() if kind == "beyond" else words_of(phrase))
            entry = phrase, kind, value
            for first in first_words(phrase):
                by_first[first].append(entry)
    return SpeechLexicon(dict(by_first), frozenset(known.union(compiler.words())), language)


@cache
def mixed(main: SpeechLexicon, other: SpeechLexicon) -> SpeechLexicon:
    """A lexicon with the phrases of another language that begin with a word that it has not."""
    borrowed = {
        first: found for first, found in other.by_first.items() if first not in main.by_first
    }
    return SpeechLexicon({**borrowed, **main.by_first}, main.words | other.words, main.language)


def spoken_pieces(
    found: Sequence[TextPiece], lexicon: SpeechLexicon, names: Iterable[tuple[str, ...]] = ()
) -> list[TextPiece]:
    """The words of a text without hesitations, as the lexicon knows them.

    "The door's" is read as "the door is", but not a word of a room's name ("the daughter's
    bedroom"); and unknown words are taken apart ("reinfahren").
    """
    own = {word for name in names for word in name}
    spoken: list[TextPiece] = []
    for index, piece in enumerate(found):
        if [each.text for each in found[index : index + 2]] == [".", "."]:
            continue
        if piece.text == "." and index and found[index - 1].text == ".":
            spoken.append(piece._replace(text=","))  # "the third... wait, the second"
            continue
        base = piece.text.removesuffix("'s")
        is_known = piece.text in lexicon.words or piece.text in own
        if base != piece.text and not is_known and base in lexicon.words:
            spoken += [piece._replace(text=base), piece._replace(text="is")]
        elif piece.text != "'":
            spoken += [piece._replace(text=part) for part in parts_of(piece.text, lexicon)]
    return without(spoken, lexicon, "hesitation")


def without(found: Sequence[TextPiece], lexicon: SpeechLexicon, kind: str) -> list[TextPiece]:
    """The words of a text without those of a class, unless nothing would be left.

    Words of a longer phrase stay ("just past"), and so does a verb that begins a clause ("halt").
    """
    words = [piece.text for piece in found]
    kept: list[TextPiece] = []
    at = 0
    while at < len(words):
        match = lexicon.find(words, at, kind)
        longest = max((stop for _, _, stop in lexicon.matches(words, at)), default=at + 1)
        longest = at + 1 if kind == "hesitation" else longest
        begins = not kept or any(lexicon.find((kept[-1].text,), 0, c) for c in ("and", "then"))
        is_verb = (begins or not kept[-1].text.isalnum()) and lexicon.find(words, at, "verb")
        if match is not None and match[1] >= longest and not is_verb:
            at = match[1]
        else:
            kept += found[at:longest]
            at = longest
    return kept or list(found)


def parts_of(word: str, lexicon: SpeechLexicon) -> tuple[str, ...]:
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


def with_room_names(
    found: Sequence[TextPiece], lexicon: SpeechLexicon, names: Iterable[tuple[str, ...]]
) -> list[TextPiece]:
    """The words of a text with the name of a room apart from its door ("Kuechentuer")."""
    rooms = sorted((name[0] for name in names if len(name) == 1), key=len, reverse=True)
    doors = lexicon.of_class("noun")
    spoken: list[TextPiece] = []
    for piece in found:
        word = piece.text
        parts = next(((room, end) for room in rooms if (end := _door_of(word, room, doors))), None)
        known = word in lexicon.words or parts is None
        spoken += [piece] if known or parts is None else [piece._replace(text=t) for t in parts]
    return spoken


def _door_of(word: str, room: str, doors: frozenset[str]) -> str:
    """The end of a compound of a room's name and a noun, which an "n" or "s" may join."""
    rest = word.removeprefix(room)
    ends = (rest, rest[1:] if rest[:1] in ("n", "s") else "")
    return next((end for end in ends if rest != word and end in doors), "")
