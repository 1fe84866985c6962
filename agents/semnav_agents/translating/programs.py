"""Commands as the symbols that the network says, with placeholders for values, sides and rooms."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from semnav_agents.translating.masking import (
    MAX_ROOMS,
    MAX_VALUES,
    ROOM_SYMBOLS,
    SIDE_SYMBOLS,
    VALUE_SYMBOLS,
    MaskedText,
)
from semnav_env.language.clauses import (
    Approach,
    Clause,
    Face,
    Follow,
    GoBack,
    GoToDoor,
    GoToRoom,
    IfThere,
    Leave,
    SearchHouse,
    Stop,
    Turn,
    Turning,
)
from semnav_env.language.command import Command
from semnav_env.language.references import (
    Distance,
    DoorReference,
    Place,
    PlaceReference,
    RoomReference,
    Side,
    Unit,
)

START, END, REFUSE = "start", "end", "refuse"

_LITERALS = ("0", "1", "2", "3", "4", "5", "-1", "-2", "0.5", "45", "60", "90", "180")
_OTHER_SIDES = (Side.AHEAD, Side.BEHIND, Side.OPPOSITE)
_FIXED: dict[str, Clause] = {
    "leave": Leave(),
    "back": GoBack(),
    "search": SearchHouse(),
    "stop": Stop(),
}

SYMBOLS = (
    *(START, END, REFUSE),
    *("follow", "until", "past", "for", "turn", "turn by", "turn around"),
    *("to", "through", "in", "face", "wall", "wait", "if", "if not", "else"),
    *_FIXED,
    *("door", *(place.value for place in Place), *ROOM_SYMBOLS, *Unit),
    *(*SIDE_SYMBOLS, *_OTHER_SIDES, *VALUE_SYMBOLS, *_LITERALS),
)
"""What the network can say; a command is such symbols between `START` and `END`."""


class UnsayableError(ValueError):
    """Symbols that are no command, or a command that has no symbols for a text."""


def symbols_of(command: Command, text: MaskedText) -> tuple[str, ...]:
    """The symbols of a command, without `START` and `END`.

    Raises:
        UnsayableError: it has a value, side or room that the text does not have.
    """
    return tuple(symbol for clause in command.clauses for symbol in _Speaker(text).clause(clause))


class _Speaker:
    """Puts clauses in symbols, with the placeholders of a text."""

    def __init__(self, text: MaskedText) -> None:
        self._text = text

    def clause(self, clause: Clause) -> Iterator[str]:
        match clause:
            case Follow(None):
                yield "follow"
            case Follow(Distance(amount, unit)):
                yield from ("for", self.value(amount), unit.value)
            case Follow(until, past):
                yield from ("past" if past else "until", *self.place(until))
            case Turn(turning, at, degrees):
                yield from self.turn(turning, at, degrees)
            case GoToDoor(door, approach):
                yield from (approach.value, *self.place(door))
            case GoToRoom(name, approach):
                yield from (approach.value, self.room(name))
            case Face(Side() as side):
                yield from ("wall", self.side(side))
            case Face(what):
                yield from ("face", *self.place(what))
            case IfThere(what, absent, otherwise):
                yield "if not" if absent else "if"
                yield from self.place(what)
                if otherwise:
                    yield "else"
            case Stop(seconds) if seconds:
                yield from ("wait", self.value(seconds))
            case _:
                known = [name for name, fixed in _FIXED.items() if fixed == clause]
                if not known:
                    raise UnsayableError(f"there are no symbols for {clause!r}")
                yield known[0]

    def turn(
        self, turning: Turning, at: PlaceReference | None, degrees: int | None
    ) -> Iterator[str]:
        if turning is Turning.AROUND:
            yield "turn around"
        else:
            yield "turn" if degrees is None else "turn by"
            yield self.side(Side(turning.value))
        if degrees is not None:
            yield self.value(degrees)
        if at is not None:
            yield from self.place(at)

    def place(self, what: Any) -> Iterator[str]:
        match what:
            case RoomReference(name):
                yield self.room(name)
            case DoorReference(ordinal, side):
                yield from ("door", self.value(ordinal))
                if side is not None:
                    yield self.side(side)
            case PlaceReference(place, ordinal):
                yield from (place.value, self.value(ordinal))

    def value(self, number: float) -> str:
        if number in self._text.values[:MAX_VALUES]:
            return VALUE_SYMBOLS[self._text.values.index(number)]
        return _sayable(f"{number:g}", _LITERALS)

    def side(self, side: Side) -> str:
        if side in self._text.sides:
            return SIDE_SYMBOLS[self._text.sides.index(side)]
        return _sayable(side.value, tuple(each.value for each in _OTHER_SIDES))

    def room(self, name: str) -> str:
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
    listener = _Listener(list(symbols), text)
    clauses = []
    try:
        while listener.left:
            clauses.append(listener.clause())
        return Command(tuple(clauses))
    except (ValueError, IndexError) as error:
        raise UnsayableError(f"{' '.join(symbols)!r} is no command: {error}") from None


class _Listener:
    """Reads clauses from symbols."""

    def __init__(self, left: list[str], text: MaskedText) -> None:
        self.left, self._text = left, text

    def clause(self) -> Clause:
        symbol = self.left.pop(0)
        match symbol:
            case "follow":
                return Follow()
            case "until" | "past":
                return Follow(self.place(), symbol == "past")
            case "for":
                return Follow(Distance(self.value(), Unit(self.left.pop(0))))
            case "turn":
                return Turn(self.turning(), self.maybe_place())
            case "turn around":
                return Turn(Turning.AROUND, self.maybe_place())
            case "turn by":
                return Turn(self.turning(), degrees=self.whole())
            case "to" | "through" | "in":
                return self.destination(Approach(symbol))
            case "wall":
                return Face(self.side())
            case "face":
                return Face(self.place())
            case "wait":
                return Stop(self.whole())
            case "if" | "if not":
                what = self.place()
                otherwise = self.left[:1] == ["else"]
                del self.left[:otherwise]
                return IfThere(what, symbol == "if not", otherwise)
        if symbol in _FIXED:
            return _FIXED[symbol]
        raise ValueError(f"{symbol!r} begins no clause")

    def destination(self, approach: Approach) -> GoToDoor | GoToRoom:
        place = self.place()
        if isinstance(place, RoomReference):
            return GoToRoom(place.name, approach)
        if isinstance(place, DoorReference):
            return GoToDoor(place, approach)
        raise ValueError(f"one goes to a door or a room, not to {place!r}")

    def turning(self) -> Turning:
        return Turning(self.side().value)

    def maybe_place(self) -> PlaceReference | None:
        return self.place() if self.left and self.left[0] in tuple(Place) else None

    def place(self) -> Any:
        symbol = self.left.pop(0)
        if symbol in ROOM_SYMBOLS:
            return RoomReference(self._text.rooms[ROOM_SYMBOLS.index(symbol)])
        if symbol == "door":
            ordinal = self.whole()
            sides = (*SIDE_SYMBOLS, *_OTHER_SIDES)
            return DoorReference(
                ordinal, self.side() if self.left and self.left[0] in sides else None
            )
        return PlaceReference(Place(symbol), self.whole())

    def whole(self) -> int:
        value = self.value()
        if value != int(value):
            raise ValueError(f"{value} is no whole number")
        return int(value)

    def value(self) -> float:
        symbol = self.left.pop(0)
        return (
            self._text.values[VALUE_SYMBOLS.index(symbol)]
            if symbol in VALUE_SYMBOLS
            else float(symbol)
        )

    def side(self) -> Side:
        symbol = self.left.pop(0)
        return (
            self._text.sides[SIDE_SYMBOLS.index(symbol)] if symbol in SIDE_SYMBOLS else Side(symbol)
        )
