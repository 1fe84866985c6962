"""What clauses refer to: doors, places, distances. Frozen values that say themselves."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import StrEnum
from numbers import Integral
from typing import TypeAlias

from semnav_env.commands.language import Language, english


class Side(StrEnum):
    """On which side of the direction of travel.

    Opposite is across the hallway, for one who stands in a doorway.
    """

    LEFT = "left"
    RIGHT = "right"
    AHEAD = "ahead"
    BEHIND = "behind"
    OPPOSITE = "opposite"


class Place(StrEnum):
    """Where a hallway offers a turn.

    An intersection, a bend (corner), the end of the hallway, a T that it ends in, or whatever
    leads to the side that is spoken of (turning).
    """

    INTERSECTION = "intersection"
    CORNER = "corner"
    END = "end"
    T_JUNCTION = "t_junction"
    TURNING = "turning"


class Unit(StrEnum):
    """What distances are told in."""

    METRES = "metres"
    STEPS = "steps"


LAST = -1
"""The ordinal of "the last door"; -2 is the second to last."""

OTHER = 0
"""The ordinal of "the other door", the only one but that which the robot came by."""

MAX_ORDINAL = 20
"""The highest ordinal: doors and places are counted from 1 to here."""

MAX_FROM_END = 10
"""Counting from the end goes from `LAST` to minus this."""

MAX_AMOUNT = {Unit.METRES: 50.0, Unit.STEPS: 100.0}
"""The longest distances."""

QUANTUM = {Unit.METRES: 0.5, Unit.STEPS: 1.0}
"""Distances are multiples of this."""

STEP = 0.7
"""Length of a step, metres."""


@dataclass(frozen=True, slots=True)
class DoorReference:
    """A door by its number and side: "the second door on the right".

    Attributes:
        ordinal: 1 for the first or next, n for the nth, `LAST` for the last, -n for the nth from
            the end, `OTHER` for the only other one.
        side: on which side; None where the command leaves it open.
    """

    ordinal: int = 1
    side: Side | None = None

    def __post_init__(self) -> None:
        if self.ordinal != OTHER or isinstance(self.ordinal, float):
            _check_ordinal("door", self.ordinal)

    def __str__(self) -> str:
        return self.say(english())

    def say(self, language: Language, form: str = "") -> str:
        """In the words of a language, in a form (case) that its phrases name."""
        phrase = "door" if self.side is None else f"door_{self.side}"
        return language.say(phrase, form, ordinal=language.ordinal(self.ordinal))


@dataclass(frozen=True, slots=True)
class PlaceReference:
    """A place by its number: "the second intersection", "the corner", "the end of the hallway".

    Attributes:
        place: what kind of place.
        ordinal: 1 for the first or next, n for the nth, -n for the nth from the end; always 1 for
            the end.
    """

    place: Place
    ordinal: int = 1

    def __post_init__(self) -> None:
        _check_ordinal(self.place, self.ordinal)
        if self.place == Place.END and self.ordinal != 1:
            raise ValueError(f"a hallway has one end ahead: its ordinal is 1, not {self.ordinal!r}")

    def __str__(self) -> str:
        return self.say(english())

    def say(self, language: Language, form: str = "") -> str:
        """In the words of a language, in a form (case) that its phrases name."""
        return language.say(self.place, form, ordinal=language.ordinal(self.ordinal))


@dataclass(frozen=True, slots=True)
class Distance:
    """A distance from where the clause begins: "3 metres", "5 steps".

    Attributes:
        amount: a multiple of half a metre up to 50 metres, or 1 to 100 whole steps.
        unit: metres or steps of `STEP`.
    """

    amount: float
    unit: Unit = Unit.METRES

    def __post_init__(self) -> None:
        quantum, most = QUANTUM[self.unit], MAX_AMOUNT[self.unit]
        whole = math.isfinite(self.amount) and self.amount % quantum == 0
        if not whole or not quantum <= self.amount <= most:
            problem = f"a distance is {quantum:g} to {most:g} {self.unit}"
            raise ValueError(f"{problem} in steps of {quantum:g}, not {self.amount:g}")

    @property
    def metres(self) -> float:
        """How far that is, metres."""
        return self.amount * (1.0 if self.unit is Unit.METRES else STEP)

    def __str__(self) -> str:
        return self.say(english())

    def say(self, language: Language, form: str = "") -> str:
        """In the words of a language."""
        unit = f"{self.unit}_one" if self.amount == 1 else str(self.unit)
        return language.say(unit, form, amount=language.number_text(self.amount))


Reference: TypeAlias = DoorReference | PlaceReference | Distance


def _check_ordinal(what: str, ordinal: int) -> None:
    whole = isinstance(ordinal, Integral) and ordinal != OTHER
    if not whole or not -MAX_FROM_END <= ordinal <= MAX_ORDINAL:
        words = f"1 to {MAX_ORDINAL}, or LAST ({LAST}) down to {-MAX_FROM_END}"
        raise ValueError(f"the ordinal of a {what} is {words}, not {ordinal!r}")
