"""Replaces the values of a text: numbers, ordinals, sides and rooms become placeholders.

The network reads and writes only "value A", "side A" and "room A", each the first of its kind in
the text. Therefore it cannot invent a number, a side or a room that was not said.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeVar

from semnav_env.language.errors import CommandError
from semnav_env.language.languages import english, languages
from semnav_env.language.normalise import normalise
from semnav_env.language.references import Side
from semnav_env.language.translating.spoken_values import (
    SIDE_WORDS,
    misspelt_room,
    misspelt_side,
    number_at,
    room_at,
    side_at,
)
from semnav_env.language.translating.word_classes import classes_of
from semnav_env.language.vocabulary.lexicon import Lexicon, lexicon_of
from semnav_env.language.vocabulary.numerals import read_number
from semnav_env.language.vocabulary.recognition import lexicon_for, recognised
from semnav_env.language.vocabulary.room_words import name_phrases
from semnav_env.language.words import pieces

_Key = TypeVar("_Key")

MAX_VALUES, MAX_ROOMS = 6, 4
"""The most different values and rooms of a text; texts with more are refused."""

NO_MARK, FIRST_VALUE, FIRST_SIDE = 0, 1, 1 + MAX_VALUES
FIRST_ROOM = FIRST_SIDE + 2
MARKS = FIRST_ROOM + MAX_ROOMS
"""Marks of words: none, the values, the two sides, the rooms."""

VALUE_SYMBOLS = tuple(f"value {n}" for n in range(MAX_VALUES))
SIDE_SYMBOLS = ("side 0", "side 1")
ROOM_SYMBOLS = tuple(f"room {n}" for n in range(MAX_ROOMS))
"""Symbols of the network for values, sides and rooms."""

LONGEST_QUOTED = 3
"""The most words in quotation marks that are taken for a room where no names are known."""

_QUOTED = re.compile(r'"[^"]*"')


@dataclass(frozen=True)
class MaskedText:
    """The words of a text, with the values that were replaced.

    Attributes:
        words: in small letters; a phrase that is one value or room is one of them.
        marks: of each word, below `MARKS`.
        classes: of each word, those of the lexicon's phrases of which it is a part.
        values: the numbers and ordinals other than one, in order of their first mention.
        sides: the sides in that order.
        rooms: the plain names of the rooms in that order.
        corrections: of each misspelt word or name its words, and what it was taken for.
    """

    words: tuple[str, ...]
    marks: tuple[int, ...]
    classes: tuple[tuple[str, ...], ...]
    values: tuple[float, ...]
    sides: tuple[Side, ...]
    rooms: tuple[str, ...]
    corrections: tuple[tuple[str, str], ...] = ()


def masked(text: str, rooms: Sequence[str]) -> MaskedText:
    """Take the values out of a text.

    Args:
        text: in any language.
        rooms: the names of the rooms that there are.

    Raises:
        CommandError: it has characters that no command has, is too long, or has too many values.
    """
    names = name_phrases(rooms)
    plain = _QUOTED.sub(lambda found: _unquoted(found[0], names), normalise(text, english()).text)
    words = [piece.text for piece in pieces(plain) if piece.text != "'"]
    first = recognised(words)
    lexica = [lexicon_of(each) for each in sorted(languages().values(), key=lambda x: x != first)]
    masking = _Masking(words, lexica, names)
    at = 0
    while at < len(words):
        at = masking.take(at)
    if len(masking.values) > MAX_VALUES or len(masking.rooms) > MAX_ROOMS:
        problem = "more than {values} different numbers or {rooms} rooms"
        raise CommandError(first.tell(problem, values=MAX_VALUES, rooms=MAX_ROOMS), text)
    said = tuple(word for word, _ in masking.found)
    marks = tuple(mark for _, mark in masking.found)
    classes = tuple(masking.classes(lexicon_for(words, first)))
    values = tuple(masking.values), tuple(masking.sides), tuple(masking.rooms)
    return MaskedText(said, marks, classes, *values, tuple(masking.corrections))


def _unquoted(quoted: str, names: Mapping[tuple[str, ...], str]) -> str:
    """A name of a room in its quotation marks; other words without them, as they are only cited."""
    name = quoted.strip('"')
    is_room = name in names.values() if names else len(name.split()) <= LONGEST_QUOTED
    return quoted if is_room else name


class _Masking:
    """The words of a text that are masked so far."""

    def __init__(
        self, words: Sequence[str], lexica: Sequence[Lexicon], names: Mapping[tuple[str, ...], str]
    ) -> None:
        self.words, self.lexica, self.names = words, lexica, names
        self.found: list[tuple[str, int]] = []
        self.spans: list[range] = []
        self.values: dict[float, None] = {}
        self.sides: dict[Side, None] = {}
        self.rooms: dict[str, None] = {}
        self.corrections: list[tuple[str, str]] = []

    def take(self, at: int) -> int:
        """Mask the word, or the phrase, at a place; the place behind it."""
        stop, mark = self._room(at) or self._value(at) or self._side(at) or (at + 1, NO_MARK)
        self.found.append((" ".join(self.words[at:stop]), mark))
        self.spans.append(range(at, stop))
        return stop

    def classes(self, lexicon: Lexicon) -> Iterator[tuple[str, ...]]:
        """The classes of each masked word; of a room its being one."""
        known = classes_of(self.words, lexicon)
        for (_, mark), span in zip(self.found, self.spans, strict=True):
            named = mark >= FIRST_ROOM
            yield ("room",) if named else tuple(dict.fromkeys(c for k in span for c in known[k]))

    def _room(self, at: int) -> tuple[int, int] | None:
        found = room_at(self.words, at, self.names, self.lexica)
        found = found or self._corrected(at, misspelt_room(self.words, at, self.names, self.lexica))
        return found and (found[1], FIRST_ROOM + _place(self.rooms, found[0]))

    def _value(self, at: int) -> tuple[int, int] | None:
        if at and self._is_counted_unit(at):
            return None
        for lexicon in self.lexica:
            if found := number_at(self.words, at, lexicon):
                value, stop = found
                mark = NO_MARK if value == 1.0 else FIRST_VALUE + _place(self.values, value)
                return stop, mark
        return None

    def _is_counted_unit(self, at: int) -> bool:
        """Whether a word is the "second" of "1 second"."""
        return any(
            (self.words[at - 1] == "a" or read_number(self.words, at - 1, lexicon))
            and lexicon.find(self.words, at, "seconds")
            for lexicon in self.lexica
        )

    def _side(self, at: int) -> tuple[int, int] | None:
        found = side_at(self.words, at, self.lexica)
        if near := found is None and self._corrected(
            at, misspelt_side(self.words, at, self.lexica)
        ):
            found = SIDE_WORDS[near[0]], near[1]
        return found and (found[1], FIRST_SIDE + _place(self.sides, found[0]))

    def _corrected(self, at: int, found: tuple[str, int] | None) -> tuple[str, int] | None:
        """What misspelt words at a place were meant to be, which is noted."""
        if found is not None:
            self.corrections.append((" ".join(self.words[at : found[1]]), found[0]))
        return found


def _place(known: dict[_Key, None], value: _Key) -> int:
    known.setdefault(value)
    return list(known).index(value)
