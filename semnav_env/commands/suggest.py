"""The known word that was probably meant."""

from __future__ import annotations

from collections.abc import Iterable

from rapidfuzz import fuzz

ENOUGH_ALIKE = 85.0
"""Smallest likeness (Indel ratio, 0 to 100) at which a word is suggested."""

LONGEST = 80
"""No known word is longer, characters."""


def nearest(word: str, known: Iterable[str]) -> str | None:
    """The known word most like `word`, or None where none is like it or it is itself known.

    "left" and "right" are far less alike than `ENOUGH_ALIKE`, so neither is ever suggested for
    a slip in the other.
    """
    likeness = {candidate: _likeness(word, candidate) for candidate in known}
    if not likeness or word in likeness:
        return None
    best = max(likeness, key=likeness.__getitem__)
    return best if likeness[best] >= ENOUGH_ALIKE else None


def did_you_mean(word: str, known: Iterable[str]) -> str:
    """The end of an error that lists the known words: "; did you mean 'left'?", or nothing."""
    found = nearest(word[:LONGEST], known)
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
