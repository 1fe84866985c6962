"""What the rules of a grammar mean; the same for every language.

A rule's name says what it means. Its parts are told apart by what they are, not by their order, so
each language may put them where it likes.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, TypeAlias, TypeVar

from lark import Token, Transformer, v_args
from lark.tree import Meta

from semnav_env.commands.clauses import (
    Approach,
    Clause,
    Follow,
    GoBack,
    GoToDoor,
    GoToRoom,
    Leave,
    Stop,
    Turn,
    Turning,
)
from semnav_env.commands.language import Language
from semnav_env.commands.references import (
    LAST,
    OTHER,
    Distance,
    DoorReference,
    Place,
    PlaceReference,
    Side,
    Unit,
)

T = TypeVar("T")
Parts: TypeAlias = list[Any]


@dataclass(frozen=True, slots=True)
class EnterIt:
    """Go through the door that was spoken of just before."""


Steps: TypeAlias = tuple["Clause | EnterIt", ...]
Readings: TypeAlias = tuple[Steps, ...]
"""What a stretch of text can mean: each reading is some clauses in turn."""


@dataclass(frozen=True, slots=True)
class Found:
    """What a stretch of text can mean.

    Attributes:
        readings: the ways to take it.
        start: where it begins in the text.
        stop: where it ends.
        anew: whether it says that counting begins anew.
    """

    readings: Readings
    start: int
    stop: int
    anew: bool


class _Meanings(Transformer[Token, list[Found]]):
    """Builds the value of each rule, from the innermost outwards."""

    def __init__(self, language: Language, rooms: dict[str, str]) -> None:
        super().__init__()
        self._language = language
        self._rooms = rooms

    def start(self, found: list[Found]) -> list[Found]:
        return found

    @v_args(meta=True)
    def clause(self, meta: Meta, parts: Parts) -> Found:
        anew = any(isinstance(part, Token) for part in parts)
        return Found(_one(parts, tuple), meta.start_pos, meta.end_pos, anew)

    def follow(self, parts: Parts) -> Readings:
        return _sure(Follow(_reference(parts)))

    def straight(self, _: Parts) -> Readings:
        return _sure(Follow())

    def to_end(self, _: Parts) -> Readings:
        return _sure(Follow(PlaceReference(Place.END)))

    def follow_past(self, parts: Parts) -> Readings:
        return _sure(Follow(_reference(parts), past=True))

    def turn(self, parts: Parts) -> Readings:
        return _sure(Turn(*_members(parts, Turning)))

    def turn_around(self, _: Parts) -> Readings:
        return _sure(Turn(Turning.AROUND))

    def turn_by(self, parts: Parts) -> Readings:
        degrees = _whole(_one(parts, float))
        ways = _members(parts, Turning)
        if degrees == 180 and not ways:
            return _sure(Turn(Turning.AROUND))
        ways = ways or [Turning.LEFT, Turning.RIGHT]
        return tuple((Turn(way, degrees=degrees),) for way in ways)

    def turn_off(self, parts: Parts) -> Readings:
        place = PlaceReference(Place.TURNING, _ordinal(parts))
        if len(_members(parts, Side)) > len(_members(parts, Turning)):
            raise ValueError("one turns to the left or to the right")
        ways = _members(parts, Turning) or [Turning.LEFT, Turning.RIGHT]
        return tuple((Turn(way, place),) for way in ways)

    def at(self, parts: Parts) -> Readings:
        reference, readings = _reference(parts), _one(parts, tuple)
        return tuple(there for steps in readings for there in _at(reference, steps))

    def at_turn(self, parts: Parts) -> Readings:
        return _at(_reference(parts), (Turn(*_members(parts, Turning)),))

    def at_around(self, parts: Parts) -> Readings:
        return _at(_reference(parts), (Turn(Turning.AROUND),))

    def at_straight(self, parts: Parts) -> Readings:
        return _at(_reference(parts), (Follow(),))

    def at_stop(self, parts: Parts) -> Readings:
        return _at(_reference(parts), (Stop(),))

    def at_side(self, parts: Parts) -> Readings:
        door, turn = _door_and_turn(parts)
        return _at(door, (turn,))

    def at_turn_off(self, parts: Parts) -> Readings:
        (turn,) = _one(parts, tuple)[0]
        if [turn.turning] != _members(parts, Turning):
            raise ValueError("one cannot turn left and right at once")
        return _sure(replace(turn, at=PlaceReference(Place.TURNING, _ordinal(parts))))

    def after(self, parts: Parts) -> Readings:
        past = Follow(_reference(parts), past=True)
        return tuple((past, *steps) for steps in _one(parts, tuple))

    def after_side(self, parts: Parts) -> Readings:
        door, turn = _door_and_turn(parts)
        return ((Follow(door, past=True), turn),)

    def after_door(self, parts: Parts) -> Readings:
        place, door = _one(parts, PlaceReference), _one(parts, DoorReference)
        return ((Follow(place, past=True), GoToDoor(door)),)

    def go_to(self, parts: Parts) -> Readings:
        return _sure(GoToDoor(_one(parts, DoorReference), Approach.TO))

    def go_through(self, parts: Parts) -> Readings:
        return _sure(GoToDoor(_one(parts, DoorReference)))

    def go_through_side(self, parts: Parts) -> Readings:
        door = _one(parts, DoorReference)
        return _sure(GoToDoor(DoorReference(door.ordinal, _side([*parts, door.side]))))

    def mention(self, parts: Parts) -> Readings:
        door = _one(parts, DoorReference)
        return tuple((GoToDoor(door, approach),) for approach in Approach)

    def enter_it(self, _: Parts) -> Readings:
        return ((EnterIt(),),)

    def leave(self, _: Parts) -> Readings:
        return _sure(Leave())

    def go_to_room(self, parts: Parts) -> Readings:
        name = " ".join(_one(parts, Token).split())
        return _sure(GoToRoom(self._rooms.get(name, name)))

    def go_back(self, _: Parts) -> Readings:
        return _sure(GoBack())

    def back(self, _: Parts) -> Readings:
        return (GoBack(),), (Turn(Turning.AROUND), Follow())

    def back_along(self, parts: Parts) -> Readings:
        reference = _reference(parts)
        if isinstance(reference, PlaceReference) and reference.ordinal < 0:
            raise ValueError("the last one there, or the one that was passed last? say which")
        door = isinstance(reference, DoorReference)
        onward = GoToDoor(reference, Approach.TO) if door else Follow(reference)
        return ((Turn(Turning.AROUND), onward),)

    def stop(self, _: Parts) -> Readings:
        return _sure(Stop())

    def wait(self, parts: Parts) -> Readings:
        return _sure(Stop(_whole(_one(parts, float))))

    def stop_before(self, parts: Parts) -> Readings:
        return ((GoToDoor(_one(parts, DoorReference), Approach.TO), Stop()),)

    def stop_after(self, parts: Parts) -> Readings:
        return ((Follow(_one(parts, Distance)), Stop()),)

    def junction(self, parts: Parts) -> PlaceReference:
        return PlaceReference(_members(parts, Place)[0], _ordinal(parts))

    def place(self, _: Parts) -> PlaceReference:
        return PlaceReference(Place.END)

    def counted_junctions(self, parts: Parts) -> PlaceReference:
        return PlaceReference(Place.INTERSECTION, _whole(_one(parts, float)))

    def door(self, parts: Parts) -> DoorReference:
        return DoorReference(_ordinal(parts), _side(parts))

    room = door

    def door_from_end(self, parts: Parts) -> DoorReference:
        ordinal = _ordinal(parts)
        if ordinal <= OTHER:
            raise ValueError("one counts from the end with first, second, third ...")
        return DoorReference(-ordinal, _side(parts))

    def last_door(self, parts: Parts) -> DoorReference:
        return DoorReference(LAST, _side(parts))

    def counted_doors(self, parts: Parts) -> DoorReference:
        return DoorReference(_whole(_one(parts, float)), _side(parts))

    def ahead(self, _: Parts) -> Side:
        return Side.AHEAD

    def distance(self, parts: Parts) -> Distance:
        amounts = [part for part in parts if isinstance(part, float)]
        return Distance(amounts[0] if amounts else 1.0, _members(parts, Unit)[0])

    @v_args(inline=True)
    def number(self, words: Token) -> float:
        return float(self._language.number(words))

    @v_args(inline=True)
    def nth(self, words: Token) -> int:
        return self._language.counts[words]

    from_end = nth

    def other(self, _: Parts) -> int:
        return OTHER


def meanings_of(tree: Any, language: Language, rooms: dict[str, str]) -> list[Found]:
    """What the clauses of a parsed text mean.

    Args:
        tree: Lark's.
        language: for its number words.
        rooms: names of rooms by how they are spoken.

    Raises:
        lark.exceptions.VisitError: around a ValueError that says what has no meaning.
    """
    return _Meanings(language, rooms).transform(tree)


def _at(reference: DoorReference | PlaceReference, steps: Steps) -> Readings:
    """The readings of "at the second intersection, turn left"."""
    match steps[0], reference:
        case Turn(_, None, None) as turn, PlaceReference():
            return ((replace(turn, at=reference), *steps[1:]),)
        case Follow(None), PlaceReference():
            return ((Follow(reference, past=True), *steps[1:]),)
        case Turn(Turning.LEFT | Turning.RIGHT as way, None, None), DoorReference(ordinal, side):
            through = GoToDoor(DoorReference(ordinal, Side(way.value)))
            there: Steps = (Follow(reference), *steps)
            aside = side in (None, Side(way.value))
            return (there, (through, *steps[1:])) if aside else (there,)
    return ((Follow(reference), *steps),)


def _door_and_turn(parts: Parts) -> tuple[DoorReference, Turn]:
    """A door without its side, and the turn to that side.

    Raises:
        ValueError: it has none.
    """
    door = _one(parts, DoorReference)
    if door.side not in (Side.LEFT, Side.RIGHT):
        raise ValueError("to the left or to the right? say which")
    return replace(door, side=None), Turn(Turning(door.side.value))


def _sure(clause: Clause) -> Readings:
    return ((clause,),)


def _one(parts: Parts, kind: type[T]) -> T:
    return next(part for part in parts if isinstance(part, kind))


def _reference(parts: Parts) -> Any:
    kinds = DoorReference | PlaceReference | Distance
    return next((part for part in parts if isinstance(part, kinds)), None)


def _ordinal(parts: Parts) -> int:
    return next((part for part in parts if isinstance(part, int)), 1)


def _whole(number: float) -> int:
    if number != int(number):
        raise ValueError(f"{number:g} is not a whole number")
    return int(number)


def _side(parts: Sequence[Any]) -> Side | None:
    sides = {*_members(parts, Side), *(part for part in parts if isinstance(part, Side))}
    if len(sides) > 1:
        raise ValueError(f"a door is not {' and '.join(sorted(sides))} at once")
    return sides.pop() if sides else None


def _members(parts: Sequence[Any], kind: Any) -> list[Any]:
    """The members of an enumeration that terminals among the parts are named after."""
    tokens = [part for part in parts if isinstance(part, Token)]
    return [kind[token.type] for token in tokens if token.type in kind.__members__]
