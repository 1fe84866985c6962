"""The clauses of a command: frozen values whose text is canonical English.

`parse(str(clause)).clauses == (clause,)` for every clause.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from numbers import Integral
from typing import TypeAlias

from semnav_env.commands.language import Language, english


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

MAX_ORDINAL = 20
"""The highest ordinal: doors and places are counted from 1 to here."""


@dataclass(frozen=True, slots=True)
class DoorReference:
    """A door by its number and side: "the second door on the right".

    Attributes:
        ordinal: 1 for the first or next, n for the nth, `LAST` for the last.
        side: on which side; None where the command leaves it open.
    """

    ordinal: int = 1
    side: Side | None = None

    def __post_init__(self) -> None:
        if self.ordinal != LAST:
            _check_ordinal("door", self.ordinal)

    def __str__(self) -> str:
        return self.say(english())

    def say(self, language: Language) -> str:
        """In the words of a language."""
        last = self.ordinal == LAST
        ordinal = language.say("last") if last else language.ordinals[self.ordinal - 1][0]
        phrase = "door" if self.side is None else f"door_{self.side}"
        return language.say(phrase, ordinal=ordinal)


@dataclass(frozen=True, slots=True)
class PlaceReference:
    """A place by its number: "the second intersection", "the corner", "the end of the hallway".

    Attributes:
        place: what kind of place.
        ordinal: 1 for the first or next, n for the nth; always 1 for the end.
    """

    place: Place
    ordinal: int = 1

    def __post_init__(self) -> None:
        _check_ordinal(self.place, self.ordinal)
        if self.place == Place.END and self.ordinal != 1:
            raise ValueError(f"a hallway has one end ahead: its ordinal is 1, not {self.ordinal!r}")

    def __str__(self) -> str:
        return self.say(english())

    def say(self, language: Language) -> str:
        """In the words of a language."""
        return language.say(self.place, ordinal=language.ordinals[self.ordinal - 1][0])


@dataclass(frozen=True, slots=True)
class Follow:
    """Follow the hallway: "go down the hallway until the next intersection".

    Attributes:
        until: where to stop; None leaves it to the next clause, or to the end of the hallway.
    """

    until: PlaceReference | DoorReference | None = None

    def __str__(self) -> str:
        return self.say(english())

    def say(self, language: Language) -> str:
        """In the words of a language."""
        if self.until is None:
            return language.say("follow")
        return language.say("follow_until", referent=self.until.say(language))


@dataclass(frozen=True, slots=True)
class Turn:
    """Change direction: "turn left at the second intersection".

    Attributes:
        turning: which way.
        at: where; None is here.
    """

    turning: Turning
    at: PlaceReference | None = None

    def __str__(self) -> str:
        return self.say(english())

    def say(self, language: Language) -> str:
        """In the words of a language."""
        turning = language.say(self.turning)
        if self.at is None:
            return language.say("turn", turning=turning)
        return language.say("turn_at", turning=turning, place=self.at.say(language))


class Approach(StrEnum):
    """How far a door clause goes: up to the door, or through it."""

    TO = "to"
    THROUGH = "through"


@dataclass(frozen=True, slots=True)
class GoToDoor:
    """Go to a door or through it: "go through the second door on the right".

    Attributes:
        door: which door.
        approach: stop before it, or go through it ("through", "into", "in" and "enter").
    """

    door: DoorReference
    approach: Approach = Approach.THROUGH

    def __str__(self) -> str:
        return self.say(english())

    def say(self, language: Language) -> str:
        """In the words of a language."""
        return language.say(self.approach, door=self.door.say(language))


@dataclass(frozen=True, slots=True)
class Stop:
    """Stand still: "stop"."""

    def __str__(self) -> str:
        return self.say(english())

    def say(self, language: Language) -> str:
        """In the words of a language."""
        return language.say("stop")


Clause: TypeAlias = Follow | Turn | GoToDoor | Stop


def _check_ordinal(what: str, ordinal: int) -> None:
    if not isinstance(ordinal, Integral) or not 1 <= ordinal <= MAX_ORDINAL:
        last = " or LAST" if what == "door" else ""
        raise ValueError(f"the ordinal of a {what} is 1 to {MAX_ORDINAL}{last}, not {ordinal!r}")
