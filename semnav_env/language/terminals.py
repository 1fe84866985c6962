"""Finds the longest phrase of a list at some word of a text."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Sequence
from typing import NamedTuple

from semnav_env.language.words import TextPiece, pieces

FILLER = "_FILLER"
"""The terminal of words without meaning, such as "please"; they may stand anywhere."""

UNKNOWN = "UNKNOWN"
"""The terminal of words that no terminal of the grammar has."""

_DIGITS = re.compile(r"\d+(?:[.,]\d+)?")


class TerminalMatch(NamedTuple):
    """A terminal and the words that form it.

    Attributes:
        terminal: its name in the grammar.
        text: the words, parted by spaces.
        stop: number of the first word behind them.
    """

    terminal: str
    text: str
    stop: int


class Lexicon:
    """Finds the longest phrase at some word of a text.

    Args:
        phrases: pairs of a terminal and one of its phrases, spelt as in a normalised text.
    """

    def __init__(self, phrases: Iterable[tuple[str, str]]) -> None:
        self._by_first: dict[str, list[tuple[tuple[str, ...], str]]] = {}
        for terminal, phrase in phrases:
            words = tuple(piece.text for piece in pieces(phrase))
            self._by_first.setdefault(words[0], []).append((words, terminal))
        for entries in self._by_first.values():
            entries.sort(key=lambda entry: len(entry[0]), reverse=True)

    def find(
        self, words: Sequence[TextPiece], first: int, accepted: Collection[str]
    ) -> TerminalMatch:
        """The longest phrase that begins at word `first` and may stand there.

        Args:
            words: of the text.
            first: number of the word at which the phrase begins.
            accepted: the terminals that the parser can take next; fillers may always stand.

        Returns:
            If no phrase may stand there: the terminal of one that is known, or else `UNKNOWN`.
        """
        here = words[first].text
        known = UNKNOWN
        for phrase, terminal in self._by_first.get(here, ()):
            stop = first + len(phrase)
            if tuple(word.text for word in words[first:stop]) == phrase:
                if terminal in accepted or terminal == FILLER:
                    return TerminalMatch(terminal, " ".join(phrase), stop)
                known = terminal
        return self._open(words, first, accepted) or TerminalMatch(known, here, first + 1)

    def _open(
        self, words: Sequence[TextPiece], first: int, accepted: Collection[str]
    ) -> TerminalMatch | None:
        """A number in digits or the name of a room, if one is accepted; no list can hold these."""
        here = words[first].text
        if "NUMBER" in accepted and _DIGITS.fullmatch(here):
            return TerminalMatch("NUMBER", here, first + 1)
        if "NAME" in accepted and here[0] == '"' and len(here) > 2:
            return TerminalMatch("NAME", here[1:-1].strip(), first + 1)
        if "NAME" in accepted and here[0].isdigit():
            letter = words[first + 1] if first + 1 < len(words) else None
            if letter is not None and letter.start == words[first].stop and len(letter.text) == 1:
                joined = here + letter.text
                return TerminalMatch("NAME", joined, first + 2) if letter.text.isalpha() else None
            return TerminalMatch("NAME", here, first + 1)
        return None
