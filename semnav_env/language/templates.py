"""Finds the canonical wording of a clause that is most like a text."""

from __future__ import annotations

import math
import zlib
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import product
from typing import TypeAlias

import numpy as np
from rapidfuzz.distance import OSA

from semnav_env.language.clauses import (
    Approach,
    Clause,
    Follow,
    GoBack,
    GoToDoor,
    Leave,
    SearchHouse,
    Stop,
    Turn,
    Turning,
)
from semnav_env.language.command import Command
from semnav_env.language.language import Language
from semnav_env.language.references import (
    MAX_FROM_END,
    MAX_ORDINAL,
    OTHER,
    DoorReference,
    Place,
    PlaceReference,
    Side,
)
from semnav_env.language.terminals import Lexicon
from semnav_env.language.words import pieces
from semnav_features.frames import FloatArray

Embedding: TypeAlias = Callable[[Sequence[str]], FloatArray]
Decisive: TypeAlias = tuple[str, ...]

DECISIVE_TERMINALS = (
    *("NTH", "FROM_END", "OTHER", "NUMBER", "LEFT", "RIGHT", "AROUND", "AHEAD", "BEHIND"),
    *("OPPOSITE", "INTERSECTION", "CORNER", "T_JUNCTION", "TURNING", "END", "_DOOR", "_ROOM"),
)
"""Terminals whose words decide what is meant, so that they must be the same in text and template.

"_ROOM" counts as "_DOOR", because people say "the second room" for its door."""

EMBEDDING_DIMENSIONS = 512
"""Columns of the hashed trigram counts; so few of the trigrams of a clause share a column."""


def trigrams(texts: Sequence[str]) -> FloatArray:
    """Counts of letter trigrams, hashed by CRC-32: shape (n, `EMBEDDING_DIMENSIONS`)."""
    vectors = np.zeros((len(texts), EMBEDDING_DIMENSIONS))
    for vector, text in zip(vectors, texts, strict=True):
        padded = f"  {text} "
        for start in range(len(padded) - 2):
            vector[zlib.crc32(padded[start : start + 3].encode()) % EMBEDDING_DIMENSIONS] += 1.0
    return vectors


@dataclass(frozen=True, eq=False)
class Templates:
    """The canonical wordings of a language, by their decisive words.

    Attributes:
        language: of the wordings.
        lexicon: finds the decisive words.
        clauses: for each set of decisive words, the clauses that have it with their other words.
    """

    language: Language
    lexicon: Lexicon
    clauses: dict[Decisive, list[tuple[Clause, str]]]

    @staticmethod
    @lru_cache(maxsize=8)
    def of(language: Language) -> Templates:
        """The templates of a language, made at the first call."""
        phrases = [
            (terminal, language.folded(phrase.casefold()))
            for terminal in DECISIVE_TERMINALS
            for phrase in language.terminals.get(terminal, ())
        ]
        templates = Templates(language, Lexicon(phrases), {})
        for clause in _clauses():
            said = language.folded(clause.say(language).casefold())
            decisive, rest = templates.split(said)
            templates.clauses.setdefault(decisive, []).append((clause, rest))
        return templates

    def split(self, text: str) -> tuple[Decisive, str]:
        """The decisive words of a normalised text, sorted, and its other words."""
        words = pieces(text)
        decisive, rest, first = [], [], 0
        while first < len(words):
            word = self.lexicon.find(words, first, DECISIVE_TERMINALS)
            if word.terminal in DECISIVE_TERMINALS:
                decisive.append(self._meaning(word.terminal, word.text))
            else:
                rest.append(word.text)
            first = word.stop
        return tuple(sorted(decisive)), " ".join(rest)

    def nearest(
        self, text: str, embed: Embedding, enough: float, margin: float
    ) -> tuple[tuple[Command, ...], float] | None:
        """The commands of one clause whose wordings are most like a normalised text.

        A text of several clauses has none, because a template would lose all but one of them.

        Args:
            text: from `normalise`.
            embed: from texts to vectors, shape (n, d).
            enough: least cosine similarity.
            margin: other clauses whose similarity is less by no more than this are taken, too.

        Returns:
            The commands, nearest first, and the similarity of the nearest; None if there is none.
        """
        decisive, rest = self.split(text)
        known = self.clauses.get(decisive)
        if not known or not rest or self._refuses(text.rstrip(self.language.punctuation)):
            return None
        vectors = embed([rest, *(each for _, each in known)])
        lengths = np.linalg.norm(vectors, axis=1)
        products = vectors[1:] @ vectors[0]
        likeness = products / np.maximum(lengths[1:] * lengths[0], math.ulp(1.0))
        best = float(likeness.max())
        if not best >= enough:
            return None
        order = [i for i in np.argsort(-likeness, kind="stable") if likeness[i] > best - margin]
        return tuple(Command((known[i][0],)) for i in order), best

    def _refuses(self, text: str) -> bool:
        """Whether a template would lose something that the text says.

        It would if a word joins clauses, if the language has a hint that the word is not
        understood, or if the word may be a misspelt decisive word.
        """
        joints = {*self.language.punctuation, '"', *self._words("_AND"), *self._words("_THEN")}
        said = {word for phrase in self.language.phrases.values() for word in self._read(phrase)}
        known = {word for terminal in self.language.terminals for word in self._words(terminal)}
        phrases = [
            phrase for t in DECISIVE_TERMINALS for phrase in self.language.terminals.get(t, ())
        ]
        decisive = {max(self._read(phrase), key=len) for phrase in phrases}
        for piece in pieces(self.split(text)[1]):
            word = piece.text
            slips = 1 if word in known or len(word) < 5 else 2
            slip = word not in said and _may_be_one_of(word, decisive, slips)
            if word in joints or self.language.hint(word) or slip:
                return True
        return False

    def _words(self, terminal: str) -> list[str]:
        return [word for each in self.language.terminals[terminal] for word in self._read(each)]

    def _read(self, phrase: str) -> list[str]:
        """The single words of a phrase, spelt as the grammar reads them."""
        return [piece.text for piece in pieces(self.language.folded(phrase.casefold()))]

    def _meaning(self, terminal: str, words: str) -> str:
        if terminal in ("NTH", "FROM_END"):
            return str(self.language.counts[words])
        if terminal == "NUMBER":
            return f"#{self.language.number(words):g}"
        return terminal.replace("_ROOM", "_DOOR")


def _may_be_one_of(word: str, known: Iterable[str], slips: int) -> bool:
    """Whether a word contains a known word, or is at most `slips` edits away from one."""
    return any(
        (len(each) > 3 and each in word) or OSA.distance(word, each) <= slips for each in known
    )


def _clauses() -> Iterator[Clause]:
    counts = [n for n in range(-MAX_FROM_END, MAX_ORDINAL + 1) if n != OTHER]
    doors = [DoorReference(*each) for each in product((*counts, OTHER), (None, *Side))]
    kinds = [place for place in Place if place is not Place.END]
    junctions = [PlaceReference(*each) for each in product(kinds, counts)]
    end = PlaceReference(Place.END)
    yield from (Follow(), Stop(), Leave(), GoBack(), SearchHouse(), Follow(end))
    yield from (Turn(turning) for turning in Turning)
    yield from (Turn(*each) for each in product(Turning, (*junctions, end)))
    yield from (GoToDoor(*each) for each in product(doors, Approach))
    for past in (False, True):
        yield from (Follow(door, past) for door in doors)
        yield from (Follow(junction, past) for junction in junctions)
