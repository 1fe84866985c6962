"""What a text is made of: verbs, places, sides, distances and joints, as one reads them."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import Any

from semnav_env.language.references import PlaceOffset, Side


class ItemKind(StrEnum):
    """What an item is."""

    VERB = "verb"
    REF = "ref"
    SIDE = "side"
    DEGREES = "degrees"
    DISTANCE = "distance"
    SECONDS = "seconds"
    STRAIGHT = "straight"
    AROUND = "around"
    PARTICLE = "particle"
    BACK = "back"
    IN = "in"
    OUT = "out"
    HERE = "here"
    TWICE = "twice"
    TO_END = "to end"
    BE = "be"
    SIGN = "sign"
    AND = "and"
    THEN = "then"
    IF = "if"
    OTHERWISE = "otherwise"
    IN_ANY_CASE = "in any case"
    FROM_THERE = "from there"
    NO = "no"
    NOT = "not"
    BUT = "but"
    INSTEAD_OF = "instead of"
    OR = "or"
    SLIGHT = "slight"
    TOO_FAR = "too far"
    BEFORE_IT = "before it"
    BEFORE_DOING = "before doing"
    AFTER_DOING = "after doing"
    BEFORE_THAT = "before that"
    COULD_YOU = "could you"
    UNKNOWN = "unknown"


JOINTS = (ItemKind.SIGN, ItemKind.AND, ItemKind.THEN)
"""Items that part clauses."""


@dataclass(frozen=True, slots=True)
class Noun:
    """A door, a room, a hallway or a place as it is named.

    Attributes:
        kind: "door", "room", "area" (a lobby), "hall", "named", "start", "wall", "it", "one",
            "offset", or a place's value.
        ordinal: as in `DoorReference`; None if it is not said.
        side: None if it is not said.
        name: of a named room.
        counted: a number of things: "two doors".
        relative: "the one after that".
        definite: not "a door".
        is_next: it is said to be the next one.
        elliptic: the noun itself is left out.
        at_end: it is at the end of the hallway; of a named room: its door is meant.
        closed: it is said to be closed.
        doorway: its opening is meant: "doorway", "threshold".
        offset: of kind "offset": what it is.
    """

    kind: str
    ordinal: int | None = None
    side: Side | None = None
    name: str = ""
    counted: bool = False
    relative: bool = False
    definite: bool = True
    is_next: bool = False
    elliptic: bool = False
    at_end: bool = False
    closed: bool = False
    doorway: bool = False
    offset: PlaceOffset | None = None


@dataclass(frozen=True, slots=True)
class Item:
    """A part of a text.

    Attributes:
        kind: what it is.
        start: number of its first word.
        stop: number of the first word behind it.
        value: a noun, a side, a number, the class of a verb, a condition.
        roles: of a noun: what its preposition may say; empty without one.
    """

    kind: ItemKind
    start: int
    stop: int
    value: Any = None
    roles: tuple[str, ...] = ()
