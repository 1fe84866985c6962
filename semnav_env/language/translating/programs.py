"""Commands as symbols of the network, with placeholders for values, sides and rooms."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from enum import StrEnum
from itertools import groupby, islice
from typing import Any, TypeAlias, TypeVar

from semnav_env.language.clause_kinds import CLAUSE_KINDS
from semnav_env.language.clauses import MAX_SECONDS, Clause, Stop, Turning, waits_of
from semnav_env.language.command import MAX_CLAUSES, Command
from semnav_env.language.declarations import Multiples, Option, Spoken, form_of, open_fields
from semnav_env.language.references import ENTRY, Place, Side, Unit
from semnav_env.language.translating.masking import (
    MAX_ROOMS,
    MAX_VALUES,
    ROOM_SYMBOLS,
    SIDE_SYMBOLS,
    VALUE_SYMBOLS,
    MaskedText,
)

S = TypeVar("S", bound=Spoken)
Fields: TypeAlias = Mapping[str, tuple[Option, ...]]

START, END, REFUSE = "<start>", "<end>", "<refuse>"

_LITERALS = ("0", "1", "2", "3", "-1", "-2", "0.5", "45", "90", "180")
"""Numbers that are meant without being said: "the next", "the one after", "a half turn"."""

_FROM_END = "from_end"
"""Before a number that counts from the end."""

_OTHER_SIDES = (Side.AHEAD, Side.BEHIND, Side.OPPOSITE)

_OPEN_SIDES = (Side.LEFT, Side.RIGHT)
"""Sides that a text without one may mean: "turn" leaves open which."""

SYMBOLS = (
    *(START, END, REFUSE),
    *("follow", "until", "past", "for", "turn", "turn_by", "turn_around"),
    *("to", "through", "in", "face", "wall", "wait", "if", "if_not", "else"),
    *("leave", "back", "search", "stop", "reverse", "entry", "along"),
    *("before", "after", "slow", "fast"),
    *("door", *(place.value for place in Place), *ROOM_SYMBOLS, *Unit),
    *(*SIDE_SYMBOLS, *_OTHER_SIDES, *VALUE_SYMBOLS, *_LITERALS, _FROM_END, *_OPEN_SIDES),
    *("all", "here", "within", "look", "call", "person", "ask"),
)
"""The symbols of the network; a command is a list of symbols between `START` and `END`.

Weights know them by their positions, so none may be removed or moved; new ones come last. Weights
from before say only those that they know (`TranslatorShape.symbols`).
"""


def sayable(text: MaskedText) -> tuple[bool, ...]:
    """Which symbols can be said of a text: all but values, sides and rooms that it does not have.

    Left and right themselves can be said only if the text has neither. The order is that of
    `SYMBOLS`.
    """
    missing = {
        *VALUE_SYMBOLS[len(text.values) :],
        *SIDE_SYMBOLS[len(text.sides) :],
        *ROOM_SYMBOLS[len(text.rooms) :],
        *(_OPEN_SIDES if text.sides else ()),
    }
    return tuple(symbol not in missing for symbol in SYMBOLS)


class UnsayableError(ValueError):
    """Symbols that are no command, or a command that has no symbols for a text."""


def symbols_of(command: Command, text: MaskedText) -> tuple[str, ...]:
    """The symbols of a command, without `START` and `END`.

    Raises:
        UnsayableError: it has a value, side or room that the text does not have.
    """
    speaker, symbols = _Speaker(text), []
    for is_wait, group in groupby(command.clauses, _is_wait):
        clauses = tuple(group)
        seconds = sum(each.seconds for each in clauses if isinstance(each, Stop))
        if is_wait and len(clauses) > 1 and seconds in text.values and clauses == waits_of(seconds):
            symbols += ["wait", VALUE_SYMBOLS[text.values.index(seconds)]]
        else:
            symbols += [symbol for clause in clauses for symbol in speaker.said(clause)]
    return tuple(symbols)


def _is_wait(clause: Clause) -> bool:
    return isinstance(clause, Stop) and clause.seconds > 0


class _Speaker:
    """Puts clauses and their parts in symbols, with the placeholders of a text."""

    def __init__(self, text: MaskedText) -> None:
        self._text = text

    def said(self, value: Spoken) -> Iterator[str]:
        """The symbols of a clause, or of a part of one."""
        template = form_of(value).symbols if value.forms else ""
        if not template:
            raise UnsayableError(f"there are no symbols for {value!r}")
        for word in template.split(" "):
            if word.startswith("{"):
                yield from self._field(getattr(value, word[1:-1]))
            else:
                yield _sayable(word, SYMBOLS)

    def _field(self, value: object) -> Iterator[str]:
        match value:
            case Spoken():
                yield from self.said(value)
            case Side() | Turning():
                yield self._side(Side(value.value))
            case StrEnum():
                yield value.value
            case str():
                yield self._room(value)
            case int() | float():
                yield from self._number(value)

    def _number(self, number: float) -> Iterator[str]:
        values = self._text.values[:MAX_VALUES]
        if number in values:
            yield VALUE_SYMBOLS[values.index(number)]
        elif -number in values and number < 0:
            yield from (_FROM_END, VALUE_SYMBOLS[values.index(-number)])
        else:
            yield _sayable(f"{number:g}", _LITERALS)

    def _side(self, side: Side) -> str:
        if side in self._text.sides:
            return SIDE_SYMBOLS[self._text.sides.index(side)]
        open_sides = () if self._text.sides else _OPEN_SIDES
        return _sayable(side.value, tuple(each.value for each in (*_OTHER_SIDES, *open_sides)))

    def _room(self, name: str) -> str:
        return ROOM_SYMBOLS[self._text.rooms.index(_sayable(name, self._text.rooms[:MAX_ROOMS]))]


def _sayable(word: str, known: Sequence[str]) -> str:
    if word not in known:
        raise UnsayableError(f"{word!r} is not in the text")
    return word


def command_of(symbols: Sequence[str], text: MaskedText) -> Command:
    """The command of symbols; `symbols_of` is the inverse.

    Raises:
        UnsayableError: they are no command.
    """
    reader, at = _SymbolReader(symbols, text), 0
    clauses: list[Clause] = []
    try:
        while at < len(symbols):
            found, at = reader.first_clauses(at)
            clauses += found
        return Command(tuple(clauses))
    except ValueError as error:
        raise UnsayableError(f"{' '.join(symbols)!r} is no command: {error}") from None


def _only_options(options: Fields) -> dict[str, Any]:
    """The fields that can be but one number, which their form need not say."""
    return {name: each[0] for name, each in options.items() if each == (ENTRY,)}


class _SymbolReader:
    """Reads clauses and their parts from symbols.

    What is read from a place comes with the place behind it; the longest reading is the first.
    """

    def __init__(self, symbols: Sequence[str], text: MaskedText) -> None:
        self._symbols, self._text = tuple(symbols), text

    def first_clauses(self, at: int) -> tuple[tuple[Clause, ...], int]:
        """The clause that begins at a place, or the waits that a long one consists of."""
        if self._symbols[at] == "wait" and at + 1 < len(self._symbols):
            seconds = next(self._numbers(self._symbols[at + 1], int), 0.0)
            if MAX_SECONDS < seconds <= MAX_CLAUSES * MAX_SECONDS:
                return waits_of(int(seconds)), at + 2
        found = [each for kind in CLAUSE_KINDS.values() for each in self._longest(kind, at)]
        if not found:
            raise ValueError(f"{self._symbols[at]!r} begins no clause")
        clause, stop = max(found, key=lambda each: each[1])
        return (clause,), stop

    def _longest(self, kind: type[S], at: int) -> Iterator[tuple[S, int]]:
        return islice(self._values(kind, at), 1)

    def _values(self, kind: type[S], at: int) -> Iterator[tuple[S, int]]:
        """The values of a class that begin at a place."""
        forms = sorted(open_fields(kind), key=lambda each: -each[0].symbols.count(" "))
        for form, options in forms:
            for parts, stop in self._parts(form.symbols.split(" "), options, at):
                try:
                    value = kind(**form.fixed | _only_options(options) | parts)
                except ValueError:
                    continue
                yield value, stop

    def _parts(
        self, template: list[str], options: Fields, at: int
    ) -> Iterator[tuple[dict[str, Any], int]]:
        """The open fields of a form, by name."""
        if not template:
            yield {}, at
        elif at < len(self._symbols) and template[0].startswith("{"):
            name = template[0][1:-1]
            for value, stop in self._field(options[name], at):
                for others, end in self._parts(template[1:], options, stop):
                    yield {name: value} | others, end
        elif at < len(self._symbols) and self._symbols[at] == template[0]:
            yield from self._parts(template[1:], options, at + 1)

    def _field(self, options: tuple[Option, ...], at: int) -> Iterator[tuple[Any, int]]:
        for option in options:
            if isinstance(option, type) and issubclass(option, Spoken):
                yield from self._values(option, at)
            elif option is int and self._symbols[at : at + 1] == (_FROM_END,):
                counted = self._symbols[at + 1 : at + 2]
                yield from ((-n, at + 2) for s in counted for n in self._numbers(s, int))
            else:
                yield from ((value, at + 1) for value in self._plain(option, self._symbols[at]))

    def _plain(self, option: Option, symbol: str) -> Iterator[Any]:
        """The value that a symbol stands for, if it is such a one."""
        match option:
            case Side() | Turning():
                side = self._side(symbol)
                if side == option.value:
                    yield option
            case StrEnum():
                if symbol == option.value:
                    yield option
            case Multiples():
                yield from self._numbers(symbol, type(option.step))
            case _ if option is int:
                yield from self._numbers(symbol, int)
            case _ if option is str and symbol in ROOM_SYMBOLS:
                yield from self._text.rooms[ROOM_SYMBOLS.index(symbol) :][:1]

    def _side(self, symbol: str) -> str | None:
        if symbol in SIDE_SYMBOLS:
            return next(iter(self._text.sides[SIDE_SYMBOLS.index(symbol) :]), None)
        return symbol

    def _numbers(self, symbol: str, kind: type[float]) -> Iterator[float]:
        found = (
            self._text.values[VALUE_SYMBOLS.index(symbol) :][:1] if symbol in VALUE_SYMBOLS else ()
        )
        if symbol in _LITERALS:
            found = (float(symbol),)
        yield from (kind(value) for value in found if kind(value) == value)
