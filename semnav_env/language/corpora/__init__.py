"""Measures how much of people's commands is understood, against meanings written beside them."""

from semnav_env.language.corpora.measure import (
    Count,
    ParseOutcome,
    SentenceVerdict,
    judge,
    verdicts,
)
from semnav_env.language.corpora.sentences import Sentence, load_sentences

__all__ = [
    "Count",
    "ParseOutcome",
    "Sentence",
    "SentenceVerdict",
    "judge",
    "load_sentences",
    "verdicts",
]
