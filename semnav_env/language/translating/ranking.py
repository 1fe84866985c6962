"""How likely each translation is what a text means: a log-linear model of evidence about them.

The probability of a translation is proportional to the exponential of its weighted evidence, that
of "none of these" to 1 (a conditional logit, McFadden 1974). The weights were learned with
translators that had not learned from the author of the text, see docs/lab/language.md.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from functools import cache
from pathlib import Path

import numpy as np

from semnav_env.language.clauses import Stop
from semnav_env.language.translating.translator import TranslatedText, Translation
from semnav_env.language.translating.word_classes import UNKNOWN

RANKER_FILE = "ranker.json"
"""File of the weights in the folder of the translator."""

LEAST = 1e-5
"""Probabilities below it count as it."""


def ranked(text: TranslatedText, folder: Path) -> list[tuple[Translation, float]]:
    """The translations with their probabilities, the likeliest first; "none of these" has the rest.

    Args:
        text: with its translations.
        folder: of the weights.
    """
    weights = load_ranker(folder)
    scores = [
        sum(weights.get(name, 0.0) * value for name, value in evidence(each, text).items())
        for each in text.translations
    ]
    shares = np.exp(np.array([*scores, 0.0]) - max([*scores, 0.0]))
    shares /= shares.sum()
    found = zip(text.translations, shares.tolist(), strict=False)
    return sorted(found, key=lambda each: -each[1])


@cache
def load_ranker(folder: Path) -> Mapping[str, float]:
    """The weights of a folder by the name of the evidence; each folder is read once."""
    found: dict[str, float] = json.loads((folder / RANKER_FILE).read_text("utf-8"))
    return found


def evidence(each: Translation, text: TranslatedText) -> dict[str, float]:
    """What speaks for and against a translation; names without a weight do not count."""
    likeness = _log(each.likeness)
    others = [other.likeness for other in text.translations if other is not each]
    return {
        "any": 1.0,
        "log likeness": likeness,
        "likeness": each.likeness,
        "likelier than others": likeness - _log(max(others, default=0.0)),
        "likeliest": float(each is text.translations[0]),
        "refusal": _log(text.refusal) - _log(1.0 - text.refusal),
        "unsaid": min(len(each.unsaid), 2),
        "clauses": len(each.command.clauses) / 4,
        "log likeness of a clause": likeness / len(each.command.clauses),
        "words": len(text.plain.words) / 20,
        "unknown words": _unknown(text),
        "known words": float(_unknown(text) == 0.0),
        "idle": float(all(isinstance(clause, Stop) for clause in each.command.clauses)),
        "unspoken": float(not text.support.speaks_of(each.command)),
        "impossible": float(text.support.is_impossible),
        "forbidding": float(text.support.is_forbidding),
    }


def _log(share: float) -> float:
    return math.log(max(share, LEAST)) / 5


def _unknown(text: TranslatedText) -> float:
    """The share of three words that are unknown to the lexicon, at most 1."""
    known = zip(text.plain.words, text.plain.classes, strict=True)
    return min(sum(kinds == (UNKNOWN,) and word.isalpha() for word, kinds in known), 3) / 3
