"""Finds the known word that a misspelt one was meant to be."""

from __future__ import annotations

from collections.abc import Iterable

from rapidfuzz.distance import OSA

from semnav_env.language.normalise import MAX_WORD_LENGTH

MIN_LENGTH, LONG = 3, 7
"""The shortest word that is corrected, and the shortest in which two slips are, letters."""

SHORT = 5
"""In words up to this length no letter is taken for another one: "late" is no "gate"."""


def _is_substituted(word: str, known: str) -> bool:
    return len(word) == len(known) and sorted(word) != sorted(known)


def nearest_word(word: str, known: Iterable[str]) -> str | None:
    """The known word that is fewest slips away; None if none is near, or several are."""
    if len(word) < MIN_LENGTH:
        return None
    most = 2 if len(word) >= LONG else 1
    near: dict[int, list[str]] = {}
    for each in known:
        if abs(len(each) - len(word)) <= most and len(each) >= MIN_LENGTH:
            slips = OSA.distance(word, each, score_cutoff=most)
            if slips <= most and (len(word) > SHORT or not _is_substituted(word, each)):
                near.setdefault(slips, []).append(each)
    if not near:
        return None
    best = near[min(near)]
    same_first = [each for each in best if each[0] == word[0]] or best
    return min(
        same_first,
        key=lambda each: (sorted(each) != sorted(word), set(each) != set(word), -len(each), each),
    )


def did_you_mean(word: str, known: Iterable[str]) -> str:
    """What an error adds to its list of known words: "; did you mean 'left'?", or ""."""
    found = nearest_word(word[:MAX_WORD_LENGTH], known)
    return f"; did you mean {found!r}?" if found else ""
