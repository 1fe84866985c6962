"""The meaning of the grammar rules for clauses, which all languages share.

Each method is called as a rule of the grammar (`english.lark`, `german.lark`) and gives the value
of that rule. It picks the parts of the rule by their kind and not by their order, because the
order differs between languages.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from lark import Token, v_args
from lark.tree import Meta

from semnav_env.commands.clause_readings import (
    ClauseReadings,
    Correction,
    EnterMentionedDoor,
    OtherwiseMarker,
    Readings,
    SideOfMentionedDoor,
    at_reference,
    correction_of,
    on_condition,
    single_reading,
)
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
from semnav_env.commands.references import Distance, DoorReference, Place, PlaceReference, Side
from semnav_env.commands.referent_transformer import ReferentTransformer
from semnav_env.commands.rule_parts import (
    Parts,
    door_and_turn,
    first_of,
    members,
    ordinal_in,
    reference_in,
    side_in,
    whole_number,
)


class _ClauseTransformer(ReferentTransformer):
    """A Lark transformer: the value of each rule from the values of its parts, innermost first."""

    def __init__(self, language: Language, rooms: dict[str, str]) -> None:
        super().__init__(language)
        self._rooms = rooms

    def start(self, found: list[ClauseReadings]) -> list[ClauseReadings]:
        return found

    @v_args(meta=True)
    def clause(self, meta: Meta, parts: Parts) -> ClauseReadings:
        adverbs = {part.type for part in parts if isinstance(part, Token)}
        span = meta.start_pos, meta.end_pos
        return ClauseReadings(
            first_of(parts, tuple), *span, "FROM_THERE" in adverbs, "IN_ANY_CASE" in adverbs
        )

    def if_there(self, parts: Parts) -> Readings:
        return on_condition(IfThere(reference_in(parts)), first_of(parts, tuple))

    def if_not(self, parts: Parts) -> Readings:
        return on_condition(IfThere(reference_in(parts), absent=True), first_of(parts, tuple))

    def if_open(self, parts: Parts) -> Readings:
        return self.if_there([_first_open(reference_in(parts)), *parts])

    def if_closed(self, parts: Parts) -> Readings:
        return single_reading(GoToDoor(_first_open(reference_in(parts))))

    def otherwise(self, parts: Parts) -> Readings:
        readings = first_of(parts, tuple)
        if any(len(steps) != 1 for steps in readings):
            raise ValueError('one thing is done otherwise; begin the next with "in any case"')
        return tuple((OtherwiseMarker(), *steps) for steps in readings)

    def instead(self, parts: Parts) -> Readings:
        return ((correction_of(first_of(parts, tuple)),),)

    def instead_one(self, parts: Parts) -> Readings:
        ordinal = next((part for part in parts if isinstance(part, int)), None)
        return ((Correction(ordinal=ordinal, side=side_in(parts)),),)

    def follow(self, parts: Parts) -> Readings:
        return single_reading(Follow(reference_in(parts)))

    def straight(self, _: Parts) -> Readings:
        return single_reading(Follow())

    def to_end(self, _: Parts) -> Readings:
        return single_reading(Follow(PlaceReference(Place.END)))

    def follow_past(self, parts: Parts) -> Readings:
        return single_reading(Follow(reference_in(parts), past=True))

    def past_until(self, parts: Parts) -> Readings:
        past, until = [part for part in parts if isinstance(part, DoorReference | PlaceReference)]
        return ((Follow(past, past=True), Follow(until)),)

    def turn(self, parts: Parts) -> Readings:
        return single_reading(Turn(*members(parts, Turning)))

    def aside(self, parts: Parts) -> Readings:
        (way,) = members(parts, Turning)
        return (Turn(way),), (SideOfMentionedDoor(Side(way.value)),)

    def turn_twice(self, parts: Parts) -> Readings:
        return ((Turn(*members(parts, Turning)),) * 2,)

    def turn_until(self, parts: Parts) -> Readings:
        return ((Turn(*members(parts, Turning)), Follow(reference_in(parts))),)

    def turn_around(self, _: Parts) -> Readings:
        return single_reading(Turn(Turning.AROUND))

    def turn_by(self, parts: Parts) -> Readings:
        degrees = whole_number(first_of(parts, float))
        ways = members(parts, Turning)
        if degrees == 180 and not ways:
            return single_reading(Turn(Turning.AROUND))
        ways = ways or [Turning.LEFT, Turning.RIGHT]
        return tuple((Turn(way, degrees=degrees),) for way in ways)

    def turn_off(self, parts: Parts) -> Readings:
        place = PlaceReference(Place.TURNING, ordinal_in(parts))
        if len(members(parts, Side)) > len(members(parts, Turning)):
            raise ValueError("one turns to the left or to the right")
        ways = members(parts, Turning) or [Turning.LEFT, Turning.RIGHT]
        return tuple((Turn(way, place),) for way in ways)

    def at(self, parts: Parts) -> Readings:
        reference, readings = reference_in(parts), first_of(parts, tuple)
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
        (turn,) = first_of(parts, tuple)[0]
        if [turn.turning] != members(parts, Turning):
            raise ValueError("one cannot turn left and right at once")
        return single_reading(replace(turn, at=PlaceReference(Place.TURNING, ordinal_in(parts))))

    def after(self, parts: Parts) -> Readings:
        past = Follow(reference_in(parts), past=True)
        return tuple((past, *steps) for steps in first_of(parts, tuple))

    def after_side(self, parts: Parts) -> Readings:
        door, turn = door_and_turn(parts)
        return ((Follow(door, past=True), turn),)

    def after_door(self, parts: Parts) -> Readings:
        place, door = first_of(parts, PlaceReference), first_of(parts, DoorReference)
        return ((Follow(place, past=True), GoToDoor(door)),)

    def go_to(self, parts: Parts) -> Readings:
        return single_reading(GoToDoor(first_of(parts, DoorReference), Approach.TO))

    def go_through(self, parts: Parts) -> Readings:
        return single_reading(GoToDoor(first_of(parts, DoorReference)))

    def go_through_side(self, parts: Parts) -> Readings:
        door = first_of(parts, DoorReference)
        return single_reading(GoToDoor(DoorReference(door.ordinal, side_in([*parts, door.side]))))

    def mention(self, parts: Parts) -> Readings:
        door = first_of(parts, DoorReference)
        return tuple((GoToDoor(door, approach),) for approach in Approach)

    def enter_it(self, _: Parts) -> Readings:
        return ((EnterMentionedDoor(),),)

    def leave(self, _: Parts) -> Readings:
        return single_reading(Leave())

    def go_to_room(self, parts: Parts) -> Readings:
        name = " ".join(first_of(parts, Token).split())
        return single_reading(GoToRoom(self._rooms.get(name, name)))

    def go_back(self, _: Parts) -> Readings:
        return single_reading(GoBack())

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
        return single_reading(Stop())

    def wait(self, parts: Parts) -> Readings:
        return single_reading(Stop(whole_number(first_of(parts, float))))

    def stop_before(self, parts: Parts) -> Readings:
        return ((GoToDoor(first_of(parts, DoorReference), Approach.TO), Stop()),)

    def stop_after(self, parts: Parts) -> Readings:
        return ((Follow(first_of(parts, Distance)), Stop()),)

    def stop_past(self, parts: Parts) -> Readings:
        return ((Follow(reference_in(parts), past=True), Stop()),)


def _first_open(door: DoorReference) -> DoorReference:
    """The door of "if the door is open": closed doors do not count, so it is the first open one.

    Raises:
        ValueError: the ordinal is not 1; nobody can count closed doors, which look like walls.
    """
    if door.ordinal != 1:
        raise ValueError("closed doors look like walls and are not counted: say which open door")
    return door


def clauses_of_tree(tree: Any, language: Language, rooms: dict[str, str]) -> list[ClauseReadings]:
    """The readings of each clause of a parsed text, in order.

    Args:
        tree: as Lark gives it.
        language: whose number words the text has.
        rooms: plain name of each room by the words that people say for it.

    Raises:
        lark.exceptions.VisitError: wraps a ValueError that says what has no meaning.
    """
    return _ClauseTransformer(language, rooms).transform(tree)
