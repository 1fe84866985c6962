"""Text of a terminal whose locale is ASCII only, such as LC_ALL=C: it is treated as UTF-8."""

from __future__ import annotations

import codecs
import io
import os
from typing import TextIO


def as_utf8(word: str) -> str:
    """A word of the command line with the characters that the locale could not decode.

    Python keeps such bytes as surrogates (PEP 383), which file names need but texts never have. A
    word that is not UTF-8 is left as it is.
    """
    if word.isascii():
        return word
    try:
        return os.fsencode(word).decode("utf-8")
    except UnicodeError:
        return word


def write_utf8(*streams: TextIO) -> None:
    """Let streams that can write only ASCII write UTF-8."""
    for stream in streams:
        encoding = getattr(stream, "encoding", None) or "utf-8"
        if isinstance(stream, io.TextIOWrapper) and codecs.lookup(encoding).name == "ascii":
            stream.reconfigure(encoding="utf-8")
