"""Sets of sentences with their meanings, on which parser and translator are measured."""

from __future__ import annotations

from itertools import product
from pathlib import Path

AUTHORS = ("", "second_", "third_", "fourth_", "fifth_", "sixth_")
"""Beginnings of the names of the development sets; the first author's have none."""

HELD_OUT = ("seventh_", "eighth_")
"""Beginnings of the names of the held-out sets."""


def development_corpora() -> tuple[Path, ...]:
    """The files of six authors on which the parser was tuned."""
    return _files(AUTHORS)


def held_out_corpora() -> tuple[Path, ...]:
    """The files of authors on which nothing was tuned."""
    return _files(HELD_OUT)


def _files(authors: tuple[str, ...]) -> tuple[Path, ...]:
    sets = product(authors, ("english", "german"))
    return tuple(Path(__file__).parent / f"{author}{language}.jsonl" for author, language in sets)
