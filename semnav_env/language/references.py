"""What clauses refer to: doors, places and distances, as frozen values that can be put in words."""

from __future__ import annotations

import re
from dataclasses import dataclass
from enum import StrEnum
from functools import lru_cache
from numbers import Integral
from typing import TYPE_CHECKING, TypeAlias

from semnav_features.validation import shown

if TYPE_CHECKING:
    from semnav_env.language.language import Language

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
    """The unit of a distance."""

    METRES = "metres"
    STEPS = "steps"


LAST = -1
"""The ordinal of "the last door"; -2 is the second to last."""

OTHER = 0
"""The ordinal of "the other door": the only one besides the door by which the robot came."""

MAX_ORDINAL = 20
"""The highest ordinal of doors and places; the languages have words up to it."""

MAX_FROM_END = 10
"""The lowest ordinal is minus this: the tenth from the end."""

MAX_AMOUNT = {Unit.METRES: 50.0, Unit.STEPS: 100.0}
"""The longest distance in each unit: 100 times `AMOUNT_STEP`, the most that a token holds."""

AMOUNT_STEP = {Unit.METRES: 0.5, Unit.STEPS: 1.0}
"""Distances are multiples of this, in their unit, so that they can be tokens."""

STEP_LENGTH = 0.7
"""Length of a person's step, metres."""


class Spoken:
    """Base of clauses and references: they can be put in the words of a language.

    It is no `ABC`, whose instances take several times as long to tell apart.
    """

    __slots__ = ()

    def say(self, language: Language) -> str:
        """In the words of a language."""
        raise NotImplementedError

    def __str__(self) -> str:
        from semnav_env.language.languages import english  # read when first spoken

        return self.say(english())


class OrdinalReference(Spoken):
    """Base of references that count; there are few, so what was said of them is kept."""

    __slots__ = ()

    def __str__(self) -> str:
        return _said_in_english(self)


@lru_cache(maxsize=1024)
def _said_in_english(reference: Spoken) -> str:
    return Spoken.__str__(reference)


@dataclass(frozen=True, slots=True)
class DoorReference(OrdinalReference):
    """A door by its ordinal and side: "the second door on the right".

    Attributes:
        ordinal: 1 for the first or next, n for the nth, `LAST` for the last, -n for the nth from
            the end, `OTHER` for the only other one.
        side: on which side; None if the command does not say.
    """

    ordinal: int = 1
    side: Side | None = None

    def __post_init__(self) -> None:
        if self.ordinal != OTHER or isinstance(self.ordinal, float):
            _check_ordinal("door", self.ordinal)

    def say(self, language: Language, form: str = "") -> str:
        """In the words of a language, in the grammatical form (case) that a phrase asks for."""
        phrase = "door" if self.side is None else f"door_{self.side}"
        return language.say(phrase, form, ordinal=language.ordinal(self.ordinal))


@dataclass(frozen=True, slots=True)
class PlaceReference(OrdinalReference):
    """A place by its ordinal: "the second intersection", "the corner", "the end of the hallway".

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

    def say(self, language: Language, form: str = "") -> str:
        """In the words of a language, in the grammatical form (case) that a phrase asks for."""
        return language.say(self.place, form, ordinal=language.ordinal(self.ordinal))


@dataclass(frozen=True, slots=True)
class Distance(Spoken):
    """A distance from where the clause begins: "3 metres", "5 steps".

    Attributes:
        amount: a multiple of half a metre up to 50 metres, or 1 to 100 whole steps.
        unit: metres or steps of `STEP_LENGTH`.
    """

    amount: float
    unit: Unit = Unit.METRES

    def __post_init__(self) -> None:
        quantum, most = AMOUNT_STEP[self.unit], MAX_AMOUNT[self.unit]
        if not quantum <= self.amount <= most or self.amount % quantum:
            problem = f"a distance is {quantum:g} to {most:g} {self.unit} in steps of {quantum:g}"
            raise ValueError(f"{problem}, not {shown(self.amount).removesuffix('.0')}")

    @property
    def metres(self) -> float:
        """The distance in metres."""
        return self.amount * (1.0 if self.unit is Unit.METRES else STEP_LENGTH)

    def say(self, language: Language, form: str = "") -> str:
        """In the words of a language."""
        unit = f"{self.unit}_one" if self.amount == 1 else str(self.unit)
        return language.say(unit, form, amount=language.number_text(self.amount))


@dataclass(frozen=True, slots=True)
class RoomReference(Spoken):
    """A room of the floor plan as a landmark: "until room 12", "past the kitchen".

    Attributes:
        name: its plain name, see `semnav_env.language.rooms.plain_name`.
    """

    name: str

    def __post_init__(self) -> None:
        check_room_name(self.name)

    def say(self, language: Language, form: str = "") -> str:
        """In the words of a language, in the grammatical form (case) that a phrase asks for."""
        return language.say("named_room", form, name=self.name)


Reference: TypeAlias = DoorReference | PlaceReference | RoomReference | Distance

_NAME = re.compile(rf"(?=.{{1,{MAX_NAME}}}$)[a-z0-9]+(?:[ ._-][a-z0-9]+)*", re.ASCII)


def check_room_name(name: str) -> None:
    """Refuse what is no plain name of a room.

    Raises:
        ValueError: it has other characters than small letters, digits and what parts them.
    """
    if not isinstance(name, str) or not _NAME.fullmatch(name):
        raise ValueError(f"a room's name is of small letters and digits, not {shown(name)}")


def _check_ordinal(what: str, ordinal: int) -> None:
    whole = isinstance(ordinal, Integral) and ordinal != OTHER
    if not whole or not -MAX_FROM_END <= ordinal <= MAX_ORDINAL:
        words = f"1 to {MAX_ORDINAL}, or LAST ({LAST}) down to {-MAX_FROM_END}"
        raise ValueError(f"the ordinal of a {what} is {words}, not {shown(ordinal)}")
