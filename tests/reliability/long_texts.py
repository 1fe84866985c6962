"""Long runs of one character or one short token, as commands."""

from __future__ import annotations

import string
from collections.abc import Callable
from typing import TypeAlias

from hypothesis import strategies as st

from semnav_env.language import CommandError, parse

CHARACTERS = (
    *string.printable,
    *"äöüßéÅ°²½①𝟙ﷺ가\u00a0\u00ad\u0301\u0316\u200b\u202e\u3000\ufeff\ud800",
)
"""Every character of a keyboard, and others that normalisation treats apart."""

TOKENS = (
    *("twenty-", "twenty ", "a ", "a-", "-a", "a'", "'s", "the ", "door ", "and ", "no ", "not "),
    *("left,", "left ", "go ", "if ", "stop ", "stop,", "half ", "zwanzig", "und ", "die ", "Tür "),
    *("rein", "zu", "nein, ", "wenn ", "1.", "1,", "1 ", '"a"', '""', "()", "[{", "... ", "? "),
    *("e\u0301", "\r\n", "the door, ", "go back, ", "turn 45 degrees, ", "next "),
)
"""Short tokens of both languages, and of punctuation."""

MOST_CHARACTERS = 500
"""Longest refusal that is still one short line, characters."""

LENGTHS = (1, 9, 80, 81, 300, 3_999, 4_000, 10_000, 19_900)
"""Lengths of the runs, characters; some at the limits of the parser."""

Reader: TypeAlias = Callable[[str, str | None], object]

READERS: tuple[tuple[Reader, str | None], ...] = (
    (parse, "en"),
    (parse, "de"),
    (parse, None),
)
"""What reads them, and the language that it is told."""

RUNS = st.tuples(st.sampled_from(CHARACTERS + TOKENS), st.sampled_from(LENGTHS))


def run_of(token: str, length: int) -> str:
    """A token again and again, of so many characters."""
    return (token * length)[:length]


def read_run(run: tuple[str, int]) -> None:
    """A run is read or refused in one short line, by all readers.

    No time is measured: one collection of garbage in a large process takes seconds.
    """
    text = run_of(*run)
    for reader, language in READERS:
        said = refusal(reader, text, language)
        assert "\n" not in said, f"a run of {run[0]!r}: {said}"
        assert len(said) < MOST_CHARACTERS, f"a run of {run[0]!r}: {said}"


def refusal(reader: Reader, text: str, language: str | None) -> str:
    """What a reader says of a text that it refuses; nothing if it reads it."""
    try:
        reader(text, language)
    except CommandError as error:
        return error.summary
    return ""
