"""Measures how much of people's commands is understood, against meanings written beside them."""

from semnav_env.language.corpora.measure import (
    Count,
    ParseOutcome,
    SentenceVerdict,
    judge,
    verdicts,
)
from semnav_env.language.corpora.sentences import (
    Sentence,
    development_corpora,
    held_out_corpora,
    load_sentences,
)

__all__ = [
    "Count",
    "ParseOutcome",
    "Sentence",
    "SentenceVerdict",
    "development_corpora",
    "held_out_corpora",
    "judge",
    "load_sentences",
    "verdicts",
]
