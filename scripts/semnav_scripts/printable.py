"""Makes text from files safe to print: what a terminal would act on is written out."""

from __future__ import annotations

import sys
import unicodedata
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, TextIO

UNPRINTABLE = frozenset(("Cc", "Cf", "Cs", "Zl", "Zp"))
"""Categories of characters that are written out: control characters, among them those that begin
escape sequences, invisible ones, among them those that turn the direction of writing, halves of
characters, and separators of lines."""

LAYOUT = frozenset("\n\t")
"""Control characters that our own tables are made of."""


def printable(text: str) -> str:
    """A text with every character that a terminal would act on written out by its number.

    Names, sources and quotations come from files, and whoever wrote those must not move the
    cursor, colour what follows, or hide a part of it.
    """
    if text.isascii() and text.replace("\n", "").isprintable():
        return text  # nearly always
    return "".join(map(_written, text))


def _written(character: str) -> str:
    """A character as it is, or by its number as JSON would write it, where JSON can."""
    if character in LAYOUT or unicodedata.category(character) not in UNPRINTABLE:
        return character
    number = ord(character)
    if number < ord(" "):
        return f"\\x{number:02x}"
    return f"\\u{number:04x}" if number < 0x10000 else f"\\U{number:08x}"


class PrintableStream:
    """A stream that makes all text printable before it writes it.

    It is no terminal for those who ask, because escape sequences of theirs are written out, too.

    Args:
        stream: to write to.
    """

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream

    def write(self, text: str) -> int:
        """Write a text, made printable."""
        self._stream.write(printable(text))
        return len(text)

    def isatty(self) -> bool:
        """Whether colours and the like are of use: no."""
        return False

    def __getattr__(self, name: str) -> Any:
        """Everything else of the stream."""
        return getattr(self._stream, name)


@contextmanager
def printing_text() -> Iterator[None]:
    """While a command runs, what it prints on the standard output is printable."""
    usual = sys.stdout
    sys.stdout = PrintableStream(usual)
    try:
        yield
    finally:
        sys.stdout = usual
