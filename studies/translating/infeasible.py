"""Makes commands that no robot can carry out: with things that it cannot see, or mere words."""

from __future__ import annotations

import numpy as np

from semnav_env.language.languages import english, language_of
from semnav_env.language.normalise import normalise
from semnav_env.language.vocabulary.lexicon import Lexicon, lexicon_of
from semnav_env.language.words import pieces

SYLLABLES = ("ba", "del", "ko", "mun", "ti", "gra", "sel", "po", "nig", "tur", "fle", "zan", "lok")
"""Of which unknown words are made."""

FINDABLE = {
    *("person", "people", "man", "woman", "child", "somebody", "someone", "anybody", "anyone"),
    *("name", "ask", "call", "shout", "search", "scan", "personen", "leute", "mensch", "menschen"),
    *("mann", "frau", "kind", "jemand", "jemanden", "frag", "frage", "fragen", "ruf", "rufe"),
    *("rufen", "hör"),
}
"""Words of the lexicon for what a robot cannot see or do, which those who have it search use."""


def infeasible(text: str, code: str, rng: np.random.Generator) -> str | None:
    """A text with a thing in the place of a noun or before it, or with its words shuffled.

    Args:
        text: that a robot can carry out.
        code: of its language.
        rng: draws what is changed.

    Returns:
        The text; None if it has no noun.
    """
    lexicon = lexicon_of(language_of(code))
    words = [piece.text for piece in pieces(normalise(text, english()).text)]
    if rng.random() < 0.1 and len(words) > 4:
        return " ".join(rng.permutation(words))
    nouns = [
        (at, found[1])
        for at in range(len(words))
        if (found := lexicon.find(words, at, "noun")) and found[1] == at + 1
    ]
    if not nouns:
        return None
    at, stop = nouns[int(rng.integers(len(nouns)))]
    thing = _thing(lexicon, rng)
    described = rng.random() < 0.3
    return " ".join([*words[:at], thing, *words[at if described else stop :]])


def _thing(lexicon: Lexicon, rng: np.random.Generator) -> str:
    """A word for something that the robot cannot see, or one that nobody knows."""
    if rng.random() < 0.15:
        return "".join(SYLLABLES[int(k)] for k in rng.integers(len(SYLLABLES), size=3))
    known = sorted(lexicon.of_class("beyond") - lexicon.words - FINDABLE)
    return known[int(rng.integers(len(known)))]
