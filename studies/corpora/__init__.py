"""Sets of sentences with their meanings, on which the readers of language are measured."""

from __future__ import annotations

from itertools import product
from pathlib import Path

TUNED = ("first", "second", "third", "fourth", "fifth", "sixth")
"""Authors on whom the grammar was tuned; the translator learned from them, too."""

LEARNED = (
    *("eleventh", "twelfth", "thirteenth", "fourteenth"),
    *("fifteenth", "sixteenth", "seventeenth", "eighteenth"),
)
"""Authors from whom translator and ranker learned, and on whom the grammar was not tuned."""

HELD_OUT = ("seventh", "eighth", "ninth", "tenth")
"""Authors on whom nothing is tuned."""


def development_corpora() -> tuple[Path, ...]:
    """The files of the authors on whom the grammar was tuned."""
    return corpora_of(TUNED)


def learned_corpora() -> tuple[Path, ...]:
    """The files of the authors from whom only translator and ranker learned."""
    return corpora_of(LEARNED)


def held_out_corpora() -> tuple[Path, ...]:
    """The files of authors on whom nothing was tuned."""
    return corpora_of(HELD_OUT)


def corpora_of(authors: tuple[str, ...]) -> tuple[Path, ...]:
    """The two files of each author; the names of the first author's begin with the language."""
    sets = product(authors, ("english", "german"))
    names = (language if author == "first" else f"{author}_{language}" for author, language in sets)
    return tuple(Path(__file__).parent / f"{name}.jsonl" for name in names)
