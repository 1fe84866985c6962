"""Replaces the values of a text: numbers, ordinals, sides and rooms become placeholders.

The network reads and writes only "value A", "side A" and "room A", each the first of its kind in
the text. Therefore it cannot invent a number, a side or a room that was not said.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TypeVar

from semnav_env.language.errors import CommandError
from semnav_env.language.languages import english, languages
from semnav_env.language.normalise import normalise
from semnav_env.language.references import Side
from semnav_env.language.speech.lexicon import SpeechLexicon, lexicon_of
from semnav_env.language.speech.numerals import read_number
from semnav_env.language.speech.recognition import recognised
from semnav_env.language.speech.room_words import name_phrases
from semnav_env.language.words import pieces

_Key = TypeVar("_Key")

MAX_VALUES, MAX_ROOMS = 4, 3
"""The most different values and rooms of a text; texts with more are refused."""

LONGEST_NUMBER = 5
"""The most words of a number or an ordinal."""

NO_MARK, FIRST_VALUE, FIRST_SIDE = 0, 1, 1 + MAX_VALUES
FIRST_ROOM = FIRST_SIDE + 2
MARKS = FIRST_ROOM + MAX_ROOMS
"""Marks of words: none, the values, the two sides, the rooms."""

VALUE_SYMBOLS = tuple(f"value {n}" for n in range(MAX_VALUES))
SIDE_SYMBOLS = ("side 0", "side 1")
ROOM_SYMBOLS = tuple(f"room {n}" for n in range(MAX_ROOMS))
MARK_SYMBOLS = ("", *VALUE_SYMBOLS, *SIDE_SYMBOLS, *ROOM_SYMBOLS)
"""The symbol of the network for each mark."""

_LEFT = re.compile(
    r"left(wards?|most|hand(ed)?)?|links(rum|herum)?|linke[nrsm]?|linker(hand|seits)"
)
_RIGHT = re.compile(
    r"right(wards?|most|hand(ed)?)?|rechts(rum|herum)?|rechte[nrsm]?|rechter(hand|seits)"
)


@dataclass(frozen=True)
class MaskedText:
    """The words of a text, with the values that were replaced.

    Attributes:
        words: in small letters; a phrase that is one value or room is one of them.
        marks: of each word, below `MARKS`.
        values: the numbers and ordinals other than one, in order of their first mention.
        sides: the sides in that order.
        rooms: the plain names of the rooms in that order.
    """

    words: tuple[str, ...]
    marks: tuple[int, ...]
    values: tuple[float, ...]
    sides: tuple[Side, ...]
    rooms: tuple[str, ...]


def masked(text: str, rooms: Sequence[str]) -> MaskedText:
    """Take the values out of a text.

    Args:
        text: in any language.
        rooms: the names of the rooms that there are.

    Raises:
        CommandError: it has characters that no command has, is too long, or has too many values.
    """
    found = pieces(normalise(text, english()).text)
    words = [piece.text for piece in found if piece.text != "'"]
    first = recognised(words)
    lexica = [lexicon_of(each) for each in sorted(languages().values(), key=lambda x: x != first)]
    masking = _Masking(words, lexica, name_phrases(rooms))
    at = 0
    while at < len(words):
        at = masking.take(at)
    if len(masking.values) > MAX_VALUES or len(masking.rooms) > MAX_ROOMS:
        problem = f"more than {MAX_VALUES} different numbers or {MAX_ROOMS} rooms"
        raise CommandError(problem, text)
    said = tuple(word for word, _ in masking.found)
    marks = tuple(mark for _, mark in masking.found)
    return MaskedText(
        said, marks, tuple(masking.values), tuple(masking.sides), tuple(masking.rooms)
    )


class _Masking:
    """The words of a text that are masked so far."""

    def __init__(
        self,
        words: Sequence[str],
        lexica: Sequence[SpeechLexicon],
        names: Mapping[tuple[str, ...], str],
    ) -> None:
        self.words, self.lexica, self.names = words, lexica, names
        self.found: list[tuple[str, int]] = []
        self.values: dict[float, None] = {}
        self.sides: dict[Side, None] = {}
        self.rooms: dict[str, None] = {}

    def take(self, at: int) -> int:
        """Mask the word, or the phrase, at a place; the place behind it."""
        stop, mark = self._room(at) or self._value(at) or self._side(at) or (at + 1, NO_MARK)
        self.found.append((" ".join(self.words[at:stop]), mark))
        return stop

    def _room(self, at: int) -> tuple[int, int] | None:
        for stop in range(min(len(self.words), at + 6), at, -1):
            name = self.names.get(tuple(self.words[at:stop]))
            if name is not None:
                return stop, FIRST_ROOM + _place(self.rooms, name)
        word = self.words[at]
        if word.startswith('"') and len(word) > 2:
            return at + 1, FIRST_ROOM + _place(self.rooms, word.strip('"'))
        return None

    def _value(self, at: int) -> tuple[int, int] | None:
        ahead = self.words[at : at + LONGEST_NUMBER]
        for lexicon in self.lexica:
            found = lexicon.find(ahead, 0, "ordinal") or read_number(ahead, 0, lexicon)
            if found is not None:
                value, length = float(found[0]), found[1]
                mark = NO_MARK if value == 1.0 else FIRST_VALUE + _place(self.values, value)
                return at + length, mark
        return None

    def _side(self, at: int) -> tuple[int, int] | None:
        for side, pattern in ((Side.LEFT, _LEFT), (Side.RIGHT, _RIGHT)):
            if pattern.fullmatch(self.words[at]):
                return at + 1, FIRST_SIDE + _place(self.sides, side)
        return None


def _place(known: dict[_Key, None], value: _Key) -> int:
    known.setdefault(value)
    return list(known).index(value)
