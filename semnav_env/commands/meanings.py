"""What the rules of a grammar for steps mean; the same for every language.

A rule's name says what it means. Its parts are told apart by what they are, not by their order, so
each language may put them where it likes.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from lark import Token, v_args
from lark.tree import Meta

from semnav_env.commands.clauses import (
    Approach,
    Follow,
    GoBack,
    GoToDoor,
    GoToRoom,
    IfThere,
    Leave,
    Stop,
    Turn,
    Turning,
)
from semnav_env.commands.language import Language
from semnav_env.commands.parts import (
    EnterIt,
    Found,
    Instead,
    OnThatSide,
    Otherwise,
    Parts,
    Readings,
    at_reference,
    correction,
    door_and_turn,
    members,
    on_condition,
    one,
    ordinal_in,
    reference_in,
    side_in,
    sure,
    whole,
)
from semnav_env.commands.reference_meanings import ReferenceMeanings
from semnav_env.commands.references import Distance, DoorReference, Place, PlaceReference, Side


class _Meanings(ReferenceMeanings):
    """Builds the value of each rule, from the innermost outwards."""

    def __init__(self, language: Language, rooms: dict[str, str]) -> None:
        super().__init__(language)
        self._rooms = rooms

    def start(self, found: list[Found]) -> list[Found]:
        return found

    @v_args(meta=True)
    def clause(self, meta: Meta, parts: Parts) -> Found:
        adverbs = {part.type for part in parts if isinstance(part, Token)}
        span = meta.start_pos, meta.end_pos
        return Found(one(parts, tuple), *span, "FROM_THERE" in adverbs, "IN_ANY_CASE" in adverbs)

    def if_there(self, parts: Parts) -> Readings:
        return on_condition(IfThere(reference_in(parts)), one(parts, tuple))

    def if_not(self, parts: Parts) -> Readings:
        return on_condition(IfThere(reference_in(parts), absent=True), one(parts, tuple))

    def if_open(self, parts: Parts) -> Readings:
        return self.if_there([_first_open(reference_in(parts)), *parts])

    def if_closed(self, parts: Parts) -> Readings:
        return sure(GoToDoor(_first_open(reference_in(parts))))

    def otherwise(self, parts: Parts) -> Readings:
        readings = one(parts, tuple)
        if any(len(steps) != 1 for steps in readings):
            raise ValueError('one thing is done otherwise; begin the next with "in any case"')
        return tuple((Otherwise(), *steps) for steps in readings)

    def instead(self, parts: Parts) -> Readings:
        return ((correction(one(parts, tuple)),),)

    def instead_one(self, parts: Parts) -> Readings:
        ordinal = next((part for part in parts if isinstance(part, int)), None)
        return ((Instead(ordinal=ordinal, side=side_in(parts)),),)

    def follow(self, parts: Parts) -> Readings:
        return sure(Follow(reference_in(parts)))

    def straight(self, _: Parts) -> Readings:
        return sure(Follow())

    def to_end(self, _: Parts) -> Readings:
        return sure(Follow(PlaceReference(Place.END)))

    def follow_past(self, parts: Parts) -> Readings:
        return sure(Follow(reference_in(parts), past=True))

    def past_until(self, parts: Parts) -> Readings:
        past, until = [part for part in parts if isinstance(part, DoorReference | PlaceReference)]
        return ((Follow(past, past=True), Follow(until)),)

    def turn(self, parts: Parts) -> Readings:
        return sure(Turn(*members(parts, Turning)))

    def aside(self, parts: Parts) -> Readings:
        (way,) = members(parts, Turning)
        return (Turn(way),), (OnThatSide(Side(way.value)),)

    def turn_twice(self, parts: Parts) -> Readings:
        return ((Turn(*members(parts, Turning)),) * 2,)

    def turn_until(self, parts: Parts) -> Readings:
        return ((Turn(*members(parts, Turning)), Follow(reference_in(parts))),)

    def turn_around(self, _: Parts) -> Readings:
        return sure(Turn(Turning.AROUND))

    def turn_by(self, parts: Parts) -> Readings:
        degrees = whole(one(parts, float))
        ways = members(parts, Turning)
        if degrees == 180 and not ways:
            return sure(Turn(Turning.AROUND))
        ways = ways or [Turning.LEFT, Turning.RIGHT]
        return tuple((Turn(way, degrees=degrees),) for way in ways)

    def turn_off(self, parts: Parts) -> Readings:
        place = PlaceReference(Place.TURNING, ordinal_in(parts))
        if len(members(parts, Side)) > len(members(parts, Turning)):
            raise ValueError("one turns to the left or to the right")
        ways = members(parts, Turning) or [Turning.LEFT, Turning.RIGHT]
        return tuple((Turn(way, place),) for way in ways)

    def at(self, parts: Parts) -> Readings:
        reference, readings = reference_in(parts), one(parts, tuple)
        return tuple(there for steps in readings for there in at_reference(reference, steps))

    def at_turn(self, parts: Parts) -> Readings:
        return at_reference(reference_in(parts), (Turn(*members(parts, Turning)),))

    def at_around(self, parts: Parts) -> Readings:
        return at_reference(reference_in(parts), (Turn(Turning.AROUND),))

    def at_straight(self, parts: Parts) -> Readings:
        return at_reference(reference_in(parts), (Follow(),))

    def at_stop(self, parts: Parts) -> Readings:
        return at_reference(reference_in(parts), (Stop(),))

    def at_side(self, parts: Parts) -> Readings:
        door, turn = door_and_turn(parts)
        return at_reference(door, (turn,))

    def at_turn_off(self, parts: Parts) -> Readings:
        (turn,) = one(parts, tuple)[0]
        if [turn.turning] != members(parts, Turning):
            raise ValueError("one cannot turn left and right at once")
        return sure(replace(turn, at=PlaceReference(Place.TURNING, ordinal_in(parts))))

    def after(self, parts: Parts) -> Readings:
        past = Follow(reference_in(parts), past=True)
        return tuple((past, *steps) for steps in one(parts, tuple))

    def after_side(self, parts: Parts) -> Readings:
        door, turn = door_and_turn(parts)
        return ((Follow(door, past=True), turn),)

    def after_door(self, parts: Parts) -> Readings:
        place, door = one(parts, PlaceReference), one(parts, DoorReference)
        return ((Follow(place, past=True), GoToDoor(door)),)

    def go_to(self, parts: Parts) -> Readings:
        return sure(GoToDoor(one(parts, DoorReference), Approach.TO))

    def go_through(self, parts: Parts) -> Readings:
        return sure(GoToDoor(one(parts, DoorReference)))

    def go_through_side(self, parts: Parts) -> Readings:
        door = one(parts, DoorReference)
        return sure(GoToDoor(DoorReference(door.ordinal, side_in([*parts, door.side]))))

    def mention(self, parts: Parts) -> Readings:
        door = one(parts, DoorReference)
        return tuple((GoToDoor(door, approach),) for approach in Approach)

    def enter_it(self, _: Parts) -> Readings:
        return ((EnterIt(),),)

    def leave(self, _: Parts) -> Readings:
        return sure(Leave())

    def go_to_room(self, parts: Parts) -> Readings:
        name = " ".join(one(parts, Token).split())
        return sure(GoToRoom(self._rooms.get(name, name)))

    def go_back(self, _: Parts) -> Readings:
        return sure(GoBack())

    def back(self, _: Parts) -> Readings:
        return (GoBack(),), (Turn(Turning.AROUND), Follow())

    def back_along(self, parts: Parts) -> Readings:
        reference = reference_in(parts)
        if isinstance(reference, PlaceReference) and reference.ordinal < 0:
            raise ValueError("the last one there, or the one that was passed last? say which")
        door = isinstance(reference, DoorReference)
        onward = GoToDoor(reference, Approach.TO) if door else Follow(reference)
        return ((Turn(Turning.AROUND), onward),)

    def stop(self, _: Parts) -> Readings:
        return sure(Stop())

    def wait(self, parts: Parts) -> Readings:
        return sure(Stop(whole(one(parts, float))))

    def stop_before(self, parts: Parts) -> Readings:
        return ((GoToDoor(one(parts, DoorReference), Approach.TO), Stop()),)

    def stop_after(self, parts: Parts) -> Readings:
        return ((Follow(one(parts, Distance)), Stop()),)

    def stop_past(self, parts: Parts) -> Readings:
        return ((Follow(reference_in(parts), past=True), Stop()),)


def _first_open(door: DoorReference) -> DoorReference:
    """The door that one takes who is told to look whether the first one is open.

    Raises:
        ValueError: it is another one than the first.
    """
    if door.ordinal != 1:
        raise ValueError("closed doors look like walls and are not counted: say which open door")
    return door


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
