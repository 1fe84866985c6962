"""What clauses refer to: doors, places and distances, as frozen values that can be put in words."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from enum import StrEnum
from numbers import Integral
from typing import ClassVar

from semnav_env.language.declarations import DOOR, ROOM, Form, Multiples, Spoken, form
from semnav_features.validation import shown

MAX_NAME = 40
"""The longest plain name of a room, characters."""


class Side(StrEnum):
    """The side on which a door lies, seen in the direction of travel.

    OPPOSITE is across the hallway for a robot that stands in a doorway.
    """

    LEFT = "left"
    RIGHT = "right"
    AHEAD = "ahead"
    BEHIND = "behind"
    OPPOSITE = "opposite"


class Place(StrEnum):
    """A place of a hallway where a robot can turn.

    INTERSECTION: a junction at which the hallway goes on or leads to both sides.
    CORNER: a bend, with one way on.
    END: the end of the hallway.
    T_JUNCTION: a T in which the hallway ends.
    TURNING: anything that leads to the side that is named.
    """

    INTERSECTION = "intersection"
    CORNER = "corner"
    END = "end"
    T_JUNCTION = "t_junction"
    TURNING = "turning"


class Unit(StrEnum):
    """The unit of a distance; SOME is of an amount that is not said: "a bit"."""

    METRES = "metres"
    STEPS = "steps"
    SOME = "some"


LAST = -1
"""The ordinal of "the last door"; -2 is the second to last."""

OTHER = 0
"""The ordinal of "the other door": the only one besides the door by which the robot came."""

ENTRY = -100
"""In place of an ordinal: "the door we came in by", through which the robot came last."""

MAX_ORDINAL = 20
"""The highest ordinal of doors and places; the languages have words up to it."""

MAX_FROM_END = 10
"""The lowest ordinal is minus this: the tenth from the end."""

MAX_AMOUNT = {Unit.METRES: 50.0, Unit.STEPS: 100.0, Unit.SOME: 1.0}
"""The longest distance in each unit: 100 times `AMOUNT_STEP`, the most that a token holds."""

AMOUNT_STEP = {Unit.METRES: 0.5, Unit.STEPS: 1.0, Unit.SOME: 1.0}
"""Distances are multiples of this, in their unit, so that they can be tokens."""


def to_half_metre(metres: float) -> float:
    """The nearest distance that a command can have, metres, of at least half a metre."""
    return max(AMOUNT_STEP[Unit.METRES], round(2.0 * metres) / 2.0)


STEP_LENGTH = 0.7
"""Length of a person's step, metres."""


class DoorRelation(StrEnum):
    """How a door is picked out by something else in the hallway: beside it, or before it."""

    AT = "at"
    BEFORE = "before"


@dataclass(frozen=True, slots=True)
class DoorReference(Spoken):
    """A door by its ordinal and side: "the second door on the right".

    A token has no room for the relation and for what it is to.

    Attributes:
        ordinal: 1 for the first or next, n for the nth, `LAST` for the last, -n for the nth from
            the end, `OTHER` for the only other one, `ENTRY` for the one by which the robot came.
            With `AT` 1 is the one nearest to what it is to.
        side: on which side; None if the command does not say, and for `ENTRY`.
        relation: beside what the door is, or before what it is counted; None for neither.
        to: what the relation is to; None without one.
    """

    ordinal: int = 1
    side: Side | None = None
    relation: DoorRelation | None = None
    to: PlaceReference | RoomReference | DoorReference | None = None
    untokened: ClassVar[tuple[str, ...]] = ("relation", "to")
    forms: ClassVar[tuple[Form, ...]] = (
        form(
            *("door_entry", "entry", "door(entry)", (None, 0, DOOR)),
            ordinal=(ENTRY,),
            side=None,
            sampled=False,
        ),
        form("door", "door {ordinal}", "door({ordinal})", (None, 0, DOOR)),
        form(
            "door_{side}",
            "door {ordinal} {side}",
            "door({ordinal},{side})",
            (None, 0, DOOR),
            side=Side,
        ),
        *(
            form(
                f"door{said}_{relation}",
                f"door {{ordinal}}{side}{symbol} {{to}}",
                f"door({{ordinal}}{side.replace(' ', ',')},{relation} {{to}})",
                (None, 0, DOOR),
                relation=relation,
                sampled=False,
                **{"side": (Side.LEFT, Side.RIGHT)} if side else {},
            )
            for relation, symbol in ((DoorRelation.AT, ""), (DoorRelation.BEFORE, " before"))
            for said, side in (("", ""), ("_{side}", " {side}"))
        ),
    )

    def __post_init__(self) -> None:
        if self.ordinal == ENTRY and self.side is not None:
            raise ValueError("the door by which the robot came is one door: say no side")
        if self.relation is not None or self.to is not None:
            _check_relation(self)
        if self.ordinal not in (OTHER, ENTRY) or isinstance(self.ordinal, float):
            _check_ordinal("door", self.ordinal)


@dataclass(frozen=True, slots=True)
class PlaceReference(Spoken):
    """A place by its ordinal: "the second intersection", "the corner", "the end of the hallway".

    Attributes:
        place: what kind of place.
        ordinal: 1 for the first or next, n for the nth, -n for the nth from the end; always 1 for
            the end.
    """

    place: Place
    ordinal: int = 1
    forms: ClassVar[tuple[Form, ...]] = (form("{place}", "{place} {ordinal}", "{place}#{ordinal}"),)

    def __post_init__(self) -> None:
        _check_ordinal(self.place, self.ordinal)
        if self.place == Place.END and self.ordinal != 1:
            raise ValueError(f"a hallway has one end ahead: its ordinal is 1, not {self.ordinal!r}")


@dataclass(frozen=True, slots=True)
class Distance(Spoken):
    """A distance from where the clause begins: "3 metres", "5 steps", "a bit".

    Attributes:
        amount: a multiple of half a metre up to 50 metres, or 1 to 100 whole steps; 1 of `SOME`.
        unit: metres, steps of `STEP_LENGTH`, or `SOME`.
    """

    amount: float
    unit: Unit = Unit.METRES
    forms: ClassVar[tuple[Form, ...]] = (
        form(
            *(Unit.SOME, "some", "some", (None, 0, Unit.METRES)),  # no metres, as a token
            amount=1.0,
            unit=Unit.SOME,
            sampled=False,
        ),
        *(
            form(
                unit,
                f"{{amount}} {unit}",
                f"{{amount}} {short}",
                (None, 0, unit),
                amount=Multiples(AMOUNT_STEP[unit], MAX_AMOUNT[unit]),
                unit=unit,
            )
            for unit, short in ((Unit.METRES, "m"), (Unit.STEPS, "steps"))
        ),
    )

    def __post_init__(self) -> None:
        quantum, most = AMOUNT_STEP[self.unit], MAX_AMOUNT[self.unit]
        if not quantum <= self.amount <= most or self.amount % quantum:
            problem = f"a distance is {quantum:g} to {most:g} {self.unit} in steps of {quantum:g}"
            raise ValueError(f"{problem}, not {shown(self.amount).removesuffix('.0')}")

    @property
    def metres(self) -> float:
        """The distance in metres; NaN if it is not said, see `Situation.metres`."""
        lengths = {Unit.METRES: 1.0, Unit.STEPS: STEP_LENGTH, Unit.SOME: math.nan}
        return self.amount * lengths[self.unit]


SOME = Distance(1.0, Unit.SOME)
"""An amount that is not said: "a bit", "a short way"."""


@dataclass(frozen=True, slots=True)
class RoomReference(Spoken):
    """A room of the floor plan as a landmark: "until room 12", "past the kitchen".

    Attributes:
        name: its plain name, see `semnav_env.language.rooms.plain_name`.
    """

    name: str
    forms: ClassVar[tuple[Form, ...]] = (
        form("named_room", "{name}", "room({name})", (None, 0, ROOM)),
    )

    def __post_init__(self) -> None:
        check_room_name(self.name)


class Relation(StrEnum):
    """On which side of a place something lies along the way."""

    BEFORE = "before"
    AFTER = "after"


@dataclass(frozen=True, slots=True)
class PlaceOffset(Spoken):
    """A place at a distance from another: "1 metre before the corner".

    A token has no room for the distance, so it is that of the place.

    Attributes:
        distance: along the way.
        relation: before the place, or after it.
        place: a door, a place or a room; there is nothing after the end of the hallway.
    """

    distance: Distance
    relation: Relation
    place: DoorReference | PlaceReference | RoomReference
    untokened: ClassVar[tuple[str, ...]] = ("distance", "relation")
    forms: ClassVar[tuple[Form, ...]] = (
        form(
            *(
                "offset_{relation}",
                "{distance} {relation} {place}",
                "{distance} {relation} {place}",
            ),
            sampled=False,
        ),
    )

    def __post_init__(self) -> None:
        is_end = isinstance(self.place, PlaceReference) and self.place.place is Place.END
        if is_end and self.relation is Relation.AFTER:
            raise ValueError(f"there is nothing after {self.place}")


_NAME = re.compile(rf"(?=.{{1,{MAX_NAME}}}$)[a-z0-9]+(?:[ ._-][a-z0-9]+)*", re.ASCII)


def check_room_name(name: str) -> None:
    """Refuse what is no plain name of a room.

    Raises:
        ValueError: it has other characters than small letters, digits and what parts them.
    """
    if not isinstance(name, str) or not _NAME.fullmatch(name):
        raise ValueError(f"a room's name is of small letters and digits, not {shown(name)}")


def _check_relation(door: DoorReference) -> None:
    """Refuse a door beside or before something from which it cannot be counted."""
    if door.relation is None or door.to is None:
        raise ValueError("a door is beside or before something: give both relation and to")
    if door.side not in (None, Side.LEFT, Side.RIGHT):
        raise ValueError(f"a door {door.relation} something is left or right, not {door.side}")
    if door.ordinal in (OTHER, ENTRY) or (door.relation is DoorRelation.AT and door.ordinal < 0):
        raise ValueError(f"a door {door.relation} something is the nth, not {door.ordinal!r}")
    if isinstance(door.to, DoorReference):
        across = door.to.side in (Side.BEHIND, Side.OPPOSITE) or door.to.ordinal == ENTRY
        if across or door.to.relation is not None:
            raise ValueError(f"a door {door.relation} another one: {door.to} is not along the way")


def _check_ordinal(what: str, ordinal: int) -> None:
    whole = isinstance(ordinal, Integral) and ordinal != OTHER
    if not whole or not -MAX_FROM_END <= ordinal <= MAX_ORDINAL:
        words = f"1 to {MAX_ORDINAL}, or LAST ({LAST}) down to {-MAX_FROM_END}"
        raise ValueError(f"the ordinal of a {what} is {words}, not {shown(ordinal)}")
