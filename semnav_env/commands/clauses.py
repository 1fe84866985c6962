"""The typed form of a command: a tuple of frozen clauses whose text is canonical English.

`parse(str(command)) == command` for every command.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import TypeAlias


class Side(StrEnum):
    """On which side of the direction of travel."""

    LEFT = "left"
    RIGHT = "right"
    AHEAD = "ahead"


class Turning(StrEnum):
    """Which way to turn."""

    LEFT = "left"
    RIGHT = "right"
    AROUND = "around"


class Place(StrEnum):
    """Where a corridor offers a turn: an intersection, a bend (corner), or the end of it."""

    INTERSECTION = "intersection"
    CORNER = "corner"
    END = "end"


LAST = -1
"""The ordinal of "the last door"."""


@dataclass(frozen=True, slots=True)
class DoorReference:
    """ "the second door on the right".

    Attributes:
        ordinal: 1 for the first or next, n for the nth, `LAST` for the last.
        side: on which side; None where the command leaves it open.
    """

    ordinal: int = 1
    side: Side | None = None


@dataclass(frozen=True, slots=True)
class PlaceReference:
    """ "the second intersection", "the corner", "the end of the hallway".

    Attributes:
        place: what kind of place.
        ordinal: 1 for the first or next, n for the nth; always 1 for the end.
    """

    place: Place
    ordinal: int = 1


@dataclass(frozen=True, slots=True)
class Follow:
    """ "go down the hallway until the next intersection".

    Attributes:
        until: where to stop; None leaves it to the next clause, or to the end of the hallway.
    """

    until: PlaceReference | DoorReference | None = None


@dataclass(frozen=True, slots=True)
class Turn:
    """ "turn left at the second intersection".

    Attributes:
        turning: which way.
        at: where; None is here.
    """

    turning: Turning
    at: PlaceReference | None = None


class Approach(StrEnum):
    """How far a door clause goes: up to the door, or through it."""

    TO = "to"
    THROUGH = "through"


@dataclass(frozen=True, slots=True)
class GoToDoor:
    """ "go through the second door on the right".

    Attributes:
        door: which door.
        approach: stop before it, or go through it ("through", "into", "in" and "enter").
    """

    door: DoorReference
    approach: Approach = Approach.THROUGH


@dataclass(frozen=True, slots=True)
class Stop:
    """ "stop"."""


Clause: TypeAlias = Follow | Turn | GoToDoor | Stop
