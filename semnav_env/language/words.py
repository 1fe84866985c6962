"""Cuts a normalised text into words."""

from __future__ import annotations

import re
from typing import NamedTuple

_PIECE = re.compile(r"\"[^\"]*\"|[^\W\d_]+(?:'[^\W\d_]+)*|\d+(?:[.,]\d+)*|\S")
_HYPHEN = re.compile(r"(?<=[^\W\d_])-(?=[^\W\d_])")


class TextPiece(NamedTuple):
    """A word, a number, a name in quotation marks or a sign.

    Attributes:
        text: its characters.
        start: index of the first one in the text.
        stop: index behind the last one.
    """

    text: str
    start: int
    stop: int


def fold(text: str, same_as: dict[str, str]) -> str:
    """The text with each character replaced by the one that it is read as."""
    return "".join(same_as.get(character, character) for character in text)


def pieces(text: str) -> list[TextPiece]:
    """The words of a text; "T-junction" is two words, and "3m" is a number and a word."""
    found = _PIECE.finditer(text)
    hyphens = {match.start() for match in _HYPHEN.finditer(text)}
    return [TextPiece(m.group(), m.start(), m.end()) for m in found if m.start() not in hyphens]
