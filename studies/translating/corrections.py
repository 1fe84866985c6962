"""Corrects a value of a text as speakers do: "the second, no, the third door"."""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import cache

import numpy as np

from semnav_env.language.languages import language_of
from studies.translating.synonyms import drawn_phrase

CORRECTED = "no"
"""The class of phrases that take a word back."""

SIDES = {"en": (("left", "right"),), "de": (("links", "rechts"), ("linke", "rechte"))}
"""Words that can take each other's place."""

_WORD = re.compile(r"\w+")


def with_correction(text: str, code: str, rng: np.random.Generator) -> str | None:
    """A text in which another value stands before one of its ordinals or sides, and is taken back.

    Args:
        text: as it was written.
        code: of its language.
        rng: draws what is corrected and how.

    Returns:
        The text; None if it has no such word.
    """
    known = _others(code)
    places = [found for found in _WORD.finditer(text) if found[0].casefold() in known]
    if not places:
        return None
    place = places[int(rng.integers(len(places)))]
    others = known[place[0].casefold()]
    wrong = others[int(rng.integers(len(others)))]
    phrase = drawn_phrase(CORRECTED, code, rng)
    return f"{text[: place.start()]}{wrong}, {phrase}, {text[place.start() :]}"


@cache
def _others(code: str) -> dict[str, Sequence[str]]:
    """For each ordinal and side in one word the words that may be said by mistake."""
    ordinals = [[w for w in row if " " not in w] for row in language_of(code).ordinals[:6]]
    columns = [[row[k] for row in ordinals if k < len(row)] for k in range(max(map(len, ordinals)))]
    return {
        word: [other for other in words if other != word]
        for words in (*columns, *SIDES[code])
        for word in words
        if len(words) > 1
    }
