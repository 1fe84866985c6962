"""Sets of sentences with their meanings, from which the reader learns or on which it is measured.

A file is one author in one language: `07_german.jsonl`.
"""

from __future__ import annotations

from pathlib import Path

FOLDER = Path(__file__).parent


def learned_corpora() -> tuple[Path, ...]:
    """The files of the authors from whom the translator learns."""
    return _files("learned")


def tuned_corpora() -> tuple[Path, ...]:
    """The files of authors on whom the limits for acting and asking were chosen."""
    return _files("tuned")


def held_out_corpora() -> tuple[Path, ...]:
    """The files of authors on whom nothing is tuned."""
    return _files("held_out")


def author_of(corpus: Path) -> int:
    """The number of the author of a file."""
    return int(corpus.stem.partition("_")[0])


def _files(role: str) -> tuple[Path, ...]:
    return tuple(sorted((FOLDER / role).glob("*.jsonl")))
