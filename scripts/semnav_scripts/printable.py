"""Makes text from files safe to print: control sequences are printed as codes."""

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
"""Control characters that tables of this package use."""


def printable(text: str) -> str:
    """A text in which each character that controls a terminal is printed as its code.

    Names, sources and quotations come from files. Their authors must not be able to move the
    cursor, colour the following text, or hide a part of it.
    """
    if text.isascii() and text.replace("\n", "").isprintable():
        return text  # nearly always
    return "".join(map(_written, text))


def _written(character: str) -> str:
    """A character unchanged, or its code as JSON writes it, where JSON can."""
    if character in LAYOUT or unicodedata.category(character) not in UNPRINTABLE:
        return character
    number = ord(character)
    if number < ord(" "):
        return f"\\x{number:02x}"
    return f"\\u{number:04x}" if number < 0x10000 else f"\\U{number:08x}"


class PrintableStream:
    """A stream that makes all text printable before it writes it.

    It reports that it is no terminal, because escape sequences would be printed as codes, too.

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
        """False: colours and other escape sequences have no effect."""
        return False

    def __getattr__(self, name: str) -> Any:
        """All other attributes of the stream."""
        return getattr(self._stream, name)


@contextmanager
def printing_text() -> Iterator[None]:
    """Make the standard output of a command printable while it runs."""
    usual = sys.stdout
    sys.stdout = PrintableStream(usual)
    try:
        yield
    finally:
        sys.stdout = usual
