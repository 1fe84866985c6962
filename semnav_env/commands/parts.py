"""The parts that a rule of a grammar is made of, told apart by what they are."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, TypeAlias, TypeVar, get_args

from lark import Token

from semnav_env.commands.clauses import Clause, Follow, GoToDoor, IfThere, Turn, Turning
from semnav_env.commands.references import Distance, DoorReference, PlaceReference, Side

T = TypeVar("T")
Parts: TypeAlias = list[Any]


@dataclass(frozen=True, slots=True)
class EnterIt:
    """Go through the door that was spoken of just before."""


@dataclass(frozen=True, slots=True)
class OnThatSide:
    """The door that was spoken of just before is on this side: "the second door, left"."""

    side: Side


@dataclass(frozen=True, slots=True)
class Otherwise:
    """What follows is for the other case of the condition before."""


@dataclass(frozen=True, slots=True)
class Instead:
    """A correction of the clause before: "no, the second one on the left".

    Attributes:
        clause: what to do instead of it; None changes only what else is given.
        ordinal: of its door or place.
        side: of its door, or of its turn.
    """

    clause: Clause | None = None
    ordinal: int | None = None
    side: Side | None = None


Steps: TypeAlias = tuple["Clause | EnterIt | OnThatSide | Otherwise | Instead", ...]
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
        in_any_case: whether it says that it hangs on no condition.
    """

    readings: Readings
    start: int
    stop: int
    anew: bool
    in_any_case: bool = False

    @property
    def wants_side(self) -> bool:
        """Whether it ends with a door whose side is left open."""
        ends = [reading[-1] for reading in self.readings]
        return any(isinstance(end, GoToDoor) and end.door.side is None for end in ends)

    def without_asides(self) -> Found:
        """The same without the readings in which it speaks of the door before."""
        kept = [r for r in self.readings if not any(isinstance(s, OnThatSide) for s in r)]
        return replace(self, readings=tuple(kept))

    @property
    def longest(self) -> int:
        """Number of clauses in the longest reading."""
        return max(
            sum(isinstance(step, get_args(Clause)) for step in each) for each in self.readings
        )


def at_reference(reference: DoorReference | PlaceReference, steps: Steps) -> Readings:
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


def on_condition(condition: IfThere, readings: Readings) -> Readings:
    """The readings of "if you see the second door, ...".

    Raises:
        ValueError: more than one thing hangs on it.
    """
    if any(len(steps) != 1 for steps in readings):
        raise ValueError('one thing hangs on a condition; begin the next with "in any case"')
    return tuple((condition, *steps) for steps in readings)


def correction(readings: Readings) -> Instead:
    """What "no, ..." changes, by what follows it.

    Raises:
        ValueError: more than one clause.
    """
    asides = [step.side for steps in readings for step in steps if isinstance(step, OnThatSide)]
    if asides:
        return Instead(side=asides[0])
    (step, *more), *others = readings
    if isinstance(step, GoToDoor) and others:
        return Instead(ordinal=step.door.ordinal, side=step.door.side)
    if more or others or not isinstance(step, get_args(Clause)):
        raise ValueError("one clause is corrected at a time")
    return Instead(step)


def door_and_turn(parts: Parts) -> tuple[DoorReference, Turn]:
    """A door without its side, and the turn to that side.

    Raises:
        ValueError: it has none.
    """
    door = one(parts, DoorReference)
    if door.side not in (Side.LEFT, Side.RIGHT):
        raise ValueError("to the left or to the right? say which")
    return replace(door, side=None), Turn(Turning(door.side.value))


def sure(clause: Clause) -> Readings:
    """The one reading of a clause that can be taken in one way only."""
    return ((clause,),)


def one(parts: Parts, kind: type[T]) -> T:
    """The first part of a kind; there must be one."""
    return next(part for part in parts if isinstance(part, kind))


def reference_in(parts: Parts) -> Any:
    """The first door, place or distance among the parts; None without."""
    kinds = DoorReference | PlaceReference | Distance
    return next((part for part in parts if isinstance(part, kinds)), None)


def ordinal_in(parts: Parts) -> int:
    """The ordinal among the parts; 1 without."""
    return next((part for part in parts if isinstance(part, int)), 1)


def whole(number: float) -> int:
    """A whole number.

    Raises:
        ValueError: it is none.
    """
    if number != int(number):
        raise ValueError(f"{number:g} is not a whole number")
    return int(number)


def side_in(parts: Sequence[Any]) -> Side | None:
    """The side among the parts; None without.

    Raises:
        ValueError: there are two different ones.
    """
    sides = {*members(parts, Side), *(part for part in parts if isinstance(part, Side))}
    if len(sides) > 1:
        raise ValueError(f"a door is not {' and '.join(sorted(sides))} at once")
    return sides.pop() if sides else None


def members(parts: Sequence[Any], kind: Any) -> list[Any]:
    """The members of an enumeration that terminals among the parts are named after."""
    tokens = [part for part in parts if isinstance(part, Token)]
    return [kind[token.type] for token in tokens if token.type in kind.__members__]
