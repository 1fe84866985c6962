"""How likely each candidate is what a text means: a log-linear model of evidence about them.

The probability of a candidate is proportional to the exponential of its weighted evidence, that of
"none of these" to 1 (a conditional logit, McFadden 1974). The weights were learned with translators
that had not learned from the author of the text, see docs/lab/language.md.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from functools import cache
from pathlib import Path

import numpy as np

from semnav_env.language.clauses import Stop
from semnav_env.language.question import AmbiguousCommandError
from semnav_env.language.translating.candidates import Candidate, HeardText
from semnav_env.language.translating.word_classes import UNKNOWN

RANKER_FILE = "ranker.json"
"""File of the weights in the folder of the translator."""

LEAST = 1e-5
"""Probabilities below it count as it."""


def ranked(text: HeardText, folder: Path) -> list[tuple[Candidate, float]]:
    """The candidates with their probabilities, the likeliest first; "none of these" has the rest.

    Args:
        text: with its candidates.
        folder: of the weights.
    """
    weights = load_ranker(folder)
    scores = [
        sum(weights.get(name, 0.0) * value for name, value in evidence(each, text).items())
        for each in text.candidates
    ]
    shares = np.exp(np.array([*scores, 0.0]) - max([*scores, 0.0]))
    shares /= shares.sum()
    found = zip(text.candidates, shares.tolist(), strict=False)
    return sorted(found, key=lambda each: -each[1])


@cache
def load_ranker(folder: Path) -> Mapping[str, float]:
    """The weights of a folder by the name of the evidence; each folder is read once."""
    found: dict[str, float] = json.loads((folder / RANKER_FILE).read_text("utf-8"))
    return found


def evidence(each: Candidate, text: HeardText) -> dict[str, float]:
    """What speaks for and against a candidate; names without a weight do not count."""
    likeness = _log(each.likeness)
    others = [other.likeness or 0.0 for other in text.candidates if other is not each]
    refused = text.translated.refusal if text.translated else 0.5
    refusal = (_log(refused) - _log(1.0 - refused)) / 5
    found = {
        "any": 1.0,
        "log likeness": likeness,
        "likeness": each.likeness or 0.0,
        "likelier than others": likeness - _log(max(others, default=0.0)),
        "likeliest": float(each.place == 0),
        "refusal": refusal,
        "unsaid": min(each.unsaid, 2),
        "clauses": len(each.command.clauses) / 4,
        "log likeness of a clause": likeness / len(each.command.clauses),
        "words": len(text.translated.plain.words) / 20 if text.translated else 1.0,
        "unknown words": _unknown(text),
        "known words": float(_unknown(text) == 0.0),
        "unlikened": float(each.likeness is None),
        "untranslated": float(text.translated is None),
        "idle": float(all(isinstance(clause, Stop) for clause in each.command.clauses)),
        "unspoken": float(not text.support.speaks_of(each.command)),
        "impossible": float(text.support.is_impossible),
        "forbidding": float(text.support.is_forbidding),
    }
    role = _role(each, text)
    about = (
        *("any", "log likeness", "log likeness of a clause", "refusal", "unknown words"),
        *("known words", "clauses", "unspoken", "forbidding"),
    )
    return found | {f"{role}: {name}": found[name] for name in about}


def _role(each: Candidate, text: HeardText) -> str:
    """How the grammar took the text, and whether the candidate is its reading."""
    if each.read and text.refusal is None:
        return "only reading" if text.readings == 1 else "reading"
    if each.read:
        return "leaves words out" if text.leaves_out else "asked about"
    if isinstance(text.refusal, AmbiguousCommandError):
        return "beside a question"
    return "beside a reading" if text.refusal is None else "not read"


def _log(share: float | None) -> float:
    return math.log(max(share or 0.0, LEAST)) / 5


def _unknown(text: HeardText) -> float:
    """The share of three words that are unknown to the lexicon, at most 1."""
    if text.translated is None:
        return 0.0
    plain = text.translated.plain
    known = zip(plain.words, plain.classes, strict=True)
    return min(sum(kinds == (UNKNOWN,) and word.isalpha() for word, kinds in known), 3) / 3
