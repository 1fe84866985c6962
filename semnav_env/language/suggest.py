"""Suggests the known word that was probably meant."""

from __future__ import annotations

from collections.abc import Iterable

from rapidfuzz import fuzz

MIN_LIKENESS = 85.0
"""Least likeness at which a word is suggested: Indel ratio, 0 to 100. Lower values suggest words
that nobody meant."""

MAX_WORD_LENGTH = 80
"""Only so many characters of a word are compared; no known word is longer."""


def nearest(word: str, known: Iterable[str]) -> str | None:
    """The known word that is most like `word`; None if none is like it, or if it is known itself.

    "left" and "right" are far less alike than `MIN_LIKENESS`, so neither is ever suggested for
    a misspelling of the other.
    """
    likeness = {candidate: _likeness(word, candidate) for candidate in known}
    if not likeness or word in likeness:
        return None
    best = max(likeness, key=likeness.__getitem__)
    return best if likeness[best] >= MIN_LIKENESS else None


def did_you_mean(word: str, known: Iterable[str]) -> str:
    """What an error adds to its list of known words: "; did you mean 'left'?", or ""."""
    found = nearest(word[:MAX_WORD_LENGTH], known)
    return f"; did you mean {found!r}?" if found else ""


def _likeness(word: str, candidate: str) -> float:
    """The Indel ratio; two neighbouring letters that changed places count as nearly alike."""
    return 90.0 if _swapped(word, candidate) else fuzz.ratio(word, candidate)


def _swapped(word: str, candidate: str) -> bool:
    differ = [i for i, (a, b) in enumerate(zip(word, candidate, strict=False)) if a != b]
    if len(word) != len(candidate) or len(differ) != 2 or differ[1] != differ[0] + 1:
        return False
    i = differ[0]
    return word[i] == candidate[i + 1] and word[i + 1] == candidate[i]
