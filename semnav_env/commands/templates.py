"""The canonical wordings of all clauses, and which of them a text is most like."""

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

from semnav_env.commands.clauses import (
    Approach,
    Clause,
    Follow,
    GoBack,
    GoToDoor,
    Leave,
    Stop,
    Turn,
    Turning,
)
from semnav_env.commands.command import Command
from semnav_env.commands.language import Language
from semnav_env.commands.references import (
    MAX_FROM_END,
    MAX_ORDINAL,
    OTHER,
    DoorReference,
    Place,
    PlaceReference,
    Side,
)
from semnav_env.commands.words import Lexicon, pieces
from semnav_env.features.frames import FloatArray

Embedding: TypeAlias = Callable[[Sequence[str]], FloatArray]
Decisive: TypeAlias = tuple[str, ...]

DECISIVE = (
    *("NTH", "FROM_END", "OTHER", "NUMBER", "LEFT", "RIGHT", "AROUND", "AHEAD", "BEHIND"),
    *("OPPOSITE", "INTERSECTION", "CORNER", "T_JUNCTION", "TURNING", "END", "_DOOR", "_ROOM"),
)
"""The terminals whose words decide what is meant; "_ROOM" counts as "_DOOR"."""

DIMENSIONS = 512


def trigrams(texts: Sequence[str]) -> FloatArray:
    """Counts of letter trigrams, hashed into `DIMENSIONS` columns, shape (n, `DIMENSIONS`)."""
    vectors = np.zeros((len(texts), DIMENSIONS))
    for vector, text in zip(vectors, texts, strict=True):
        padded = f"  {text} "
        for start in range(len(padded) - 2):
            vector[zlib.crc32(padded[start : start + 3].encode()) % DIMENSIONS] += 1.0
    return vectors


@dataclass(frozen=True, eq=False)
class Templates:
    """The clauses of a language by the words that decide between them.

    Attributes:
        language: whose words.
        clauses: for each set of decisive words, the clauses and how their other words are.
    """

    language: Language
    lexicon: Lexicon
    clauses: dict[Decisive, list[tuple[Clause, str]]]

    @staticmethod
    @lru_cache(maxsize=8)
    def of(language: Language) -> Templates:
        """The templates of a language, made once."""
        phrases = [
            (terminal, language.folded(phrase.casefold()))
            for terminal in DECISIVE
            for phrase in language.terminals.get(terminal, ())
        ]
        templates = Templates(language, Lexicon(phrases), {})
        for clause in _clauses():
            said = language.folded(clause.say(language).casefold())
            decisive, rest = templates.split(said)
            templates.clauses.setdefault(decisive, []).append((clause, rest))
        return templates

    def split(self, text: str) -> tuple[Decisive, str]:
        """The decisive words of a normalised text, sorted, and the rest of it."""
        words = pieces(text)
        decisive, rest, first = [], [], 0
        while first < len(words):
            word = self.lexicon.find(words, first, DECISIVE)
            if word.terminal in DECISIVE:
                decisive.append(self._meaning(word.terminal, word.text))
            else:
                rest.append(word.text)
            first = word.stop
        return tuple(sorted(decisive)), " ".join(rest)

    def nearest(
        self, text: str, embed: Embedding, enough: float, margin: float
    ) -> tuple[tuple[Command, ...], float] | None:
        """The commands of one clause that are worded most like a normalised text.

        A text of several clauses is like none, for one of them could be lost.

        Args:
            text: normalised.
            embed: from texts to vectors.
            enough: least cosine similarity.
            margin: how far behind the nearest others may be.

        Returns:
            The nearest first, and the similarity of it; None if there is none.
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
        """Whether something of a text would be lost if it were taken for one of these clauses.

        That is so if a word joins clauses, is one that the language says is not understood, or may
        be a slip in a word that decides: then the template would lack that.
        """
        joints = {*self.language.punctuation, '"', *self._words("_AND"), *self._words("_THEN")}
        said = {word for phrase in self.language.phrases.values() for word in self._read(phrase)}
        known = {word for terminal in self.language.terminals for word in self._words(terminal)}
        phrases = [phrase for t in DECISIVE for phrase in self.language.terminals.get(t, ())]
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
        """The single words of a phrase, as the grammar reads them."""
        return [piece.text for piece in pieces(self.language.folded(phrase.casefold()))]

    def _meaning(self, terminal: str, words: str) -> str:
        if terminal in ("NTH", "FROM_END"):
            return str(self.language.counts[words])
        if terminal == "NUMBER":
            return f"#{self.language.number(words):g}"
        return terminal.replace("_ROOM", "_DOOR")


def _may_be_one_of(word: str, known: Iterable[str], slips: int) -> bool:
    """Whether a word holds a known one, or is at most so many slips away from it."""
    return any(
        (len(each) > 3 and each in word) or OSA.distance(word, each) <= slips for each in known
    )


def _clauses() -> Iterator[Clause]:
    counts = [n for n in range(-MAX_FROM_END, MAX_ORDINAL + 1) if n != OTHER]
    doors = [DoorReference(*each) for each in product((*counts, OTHER), (None, *Side))]
    kinds = [place for place in Place if place is not Place.END]
    junctions = [PlaceReference(*each) for each in product(kinds, counts)]
    end = PlaceReference(Place.END)
    yield from (Follow(), Stop(), Leave(), GoBack(), Follow(end))
    yield from (Turn(turning) for turning in Turning)
    yield from (Turn(*each) for each in product(Turning, (*junctions, end)))
    yield from (GoToDoor(*each) for each in product(doors, Approach))
    for past in (False, True):
        yield from (Follow(door, past) for door in doors)
        yield from (Follow(junction, past) for junction in junctions)
