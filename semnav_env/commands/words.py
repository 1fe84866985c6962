"""From a normalised text to words, and from words to the terminals of a grammar."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Sequence
from typing import NamedTuple

FILLER = "_FILLER"
"""The terminal of words that say nothing; they may stand anywhere."""

UNKNOWN = "UNKNOWN"
"""The terminal of what no grammar knows."""

_PIECE = re.compile(r"\"[^\"]*\"|[^\W\d_]+(?:'[^\W\d_]+)*|\d+(?:[.,]\d+)*|\S")
_HYPHEN = re.compile(r"(?<=[^\W\d_])-(?=[^\W\d_])")
_DIGITS = re.compile(r"\d+(?:[.,]\d+)?")


class Piece(NamedTuple):
    """A word, a number, a name in quotation marks or a sign, and where it stands."""

    text: str
    start: int
    stop: int


class Word(NamedTuple):
    """A phrase of a terminal: words `first` to `stop` (exclusive) of a text."""

    terminal: str
    text: str
    stop: int


def fold(text: str, same_as: dict[str, str]) -> str:
    """Replace each character by what it is read as."""
    return "".join(same_as.get(character, character) for character in text)


def pieces(text: str) -> list[Piece]:
    """The words of a text. A hyphen between letters parts them; "3m" is a number and a word."""
    found = _PIECE.finditer(text)
    hyphens = {match.start() for match in _HYPHEN.finditer(text)}
    return [Piece(m.group(), m.start(), m.end()) for m in found if m.start() not in hyphens]


class Lexicon:
    """Finds the longest phrase that may stand at a place.

    Args:
        phrases: the phrases of each terminal, with the spelling of the normalised text.
    """

    def __init__(self, phrases: Iterable[tuple[str, str]]) -> None:
        self._by_first: dict[str, list[tuple[tuple[str, ...], str]]] = {}
        for terminal, phrase in phrases:
            words = tuple(piece.text for piece in pieces(phrase))
            self._by_first.setdefault(words[0], []).append((words, terminal))
        for entries in self._by_first.values():
            entries.sort(key=lambda entry: len(entry[0]), reverse=True)

    def find(self, words: Sequence[Piece], first: int, accepted: Collection[str]) -> Word:
        """The longest phrase at `first` whose terminal is accepted there, or a filler.

        Where none is, a phrase that is known but out of place, or else `UNKNOWN`.
        """
        here = words[first].text
        known = UNKNOWN
        for phrase, terminal in self._by_first.get(here, ()):
            stop = first + len(phrase)
            if tuple(word.text for word in words[first:stop]) == phrase:
                if terminal in accepted or terminal == FILLER:
                    return Word(terminal, " ".join(phrase), stop)
                known = terminal
        return self._open(words, first, accepted) or Word(known, here, first + 1)

    def _open(self, words: Sequence[Piece], first: int, accepted: Collection[str]) -> Word | None:
        """A number in digits or the name of a room, which no list holds."""
        here = words[first].text
        if "NUMBER" in accepted and _DIGITS.fullmatch(here):
            return Word("NUMBER", here, first + 1)
        if "NAME" in accepted and here[0] == '"' and len(here) > 2:
            return Word("NAME", here[1:-1].strip(), first + 1)
        if "NAME" in accepted and here[0].isdigit():
            letter = words[first + 1] if first + 1 < len(words) else None
            if letter is not None and letter.start == words[first].stop and len(letter.text) == 1:
                joined = here + letter.text
                return Word("NAME", joined, first + 2) if letter.text.isalpha() else None
            return Word("NAME", here, first + 1)
        return None
