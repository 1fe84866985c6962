"""Picks the parts of a grammar rule by what they are, as their order differs by language."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, TypeAlias, TypeVar

from lark import Token

from semnav_env.commands.clauses import Turn, Turning
from semnav_env.commands.references import Distance, DoorReference, PlaceReference, Side

T = TypeVar("T")
Parts: TypeAlias = list[Any]
"""The values and tokens that a rule was made of; Lark knows no types for them."""


def first_of(parts: Parts, kind: type[T]) -> T:
    """The first part of a kind; the grammar guarantees that there is one."""
    return next(part for part in parts if isinstance(part, kind))


def reference_in(parts: Parts) -> Any:
    """The first door, place or distance among the parts; None if there is none."""
    kinds = DoorReference | PlaceReference | Distance
    return next((part for part in parts if isinstance(part, kinds)), None)


def ordinal_in(parts: Parts) -> int:
    """The ordinal among the parts; 1 if there is none."""
    return next((part for part in parts if isinstance(part, int)), 1)


def side_in(parts: Sequence[Any]) -> Side | None:
    """The side among the parts; None if there is none.

    Raises:
        ValueError: there are two different sides.
    """
    sides = {*members(parts, Side), *(part for part in parts if isinstance(part, Side))}
    if len(sides) > 1:
        raise ValueError(f"a door is not {' and '.join(sorted(sides))} at once")
    return sides.pop() if sides else None


def members(parts: Sequence[Any], kind: Any) -> list[Any]:
    """The members of an enumeration for those parts that are terminals with a member's name."""
    tokens = [part for part in parts if isinstance(part, Token)]
    return [kind[token.type] for token in tokens if token.type in kind.__members__]


def door_and_turn(parts: Parts) -> tuple[DoorReference, Turn]:
    """A door on a side, taken apart: the door without its side, and a turn to that side.

    Raises:
        ValueError: the door is neither to the left nor to the right.
    """
    door = first_of(parts, DoorReference)
    if door.side is None or door.side not in (Side.LEFT, Side.RIGHT):
        raise ValueError("to the left or to the right? say which")
    return replace(door, side=None), Turn(Turning(door.side.value))


def whole_number(number: float) -> int:
    """A number as an integer.

    Raises:
        ValueError: it has a fraction.
    """
    if number != int(number):
        raise ValueError(f"{number:g} is not a whole number")
    return int(number)
