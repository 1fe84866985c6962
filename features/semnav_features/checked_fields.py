"""Checks the fields of settings: the type, the bounds and the choices of each field.

A settings class declares in its annotations what its fields take, and calls `check_fields`:

    @dataclass(frozen=True)
    class Walking:
        radius: Annotated[float, Bounds(0.1, 0.5, "m")] = 0.25

        def __post_init__(self) -> None:
            check_fields(self)
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from numbers import Integral, Real
from types import NoneType, UnionType
from typing import Annotated, Any, TypeAlias, Union, get_args, get_origin, get_type_hints

import numpy as np

from semnav_features.validation import check_kind, require, shown


@dataclass(frozen=True, slots=True)
class Bounds:
    """The least and the largest value of a number, both included.

    Attributes:
        least: smallest accepted value.
        most: largest accepted value.
        unit: for messages; empty for none.
    """

    least: float
    most: float
    unit: str = ""

    def __str__(self) -> str:
        return f"from {self.least:.10g} to {self.most:.10g} {self.unit}".rstrip()


@dataclass(frozen=True, slots=True)
class OneOf:
    """The texts that a field accepts."""

    choices: tuple[str, ...]


ANY_NUMBER = Bounds(-1e6, 1e6)
"""Bounds of a number without declared bounds: finite, and not too large for exact sums."""

Share: TypeAlias = Annotated[float, Bounds(0.0, 1.0)]
"""A probability, or a part of a whole."""

Length: TypeAlias = Annotated[float, Bounds(0.0, 1000.0, "m")]
"""Metres."""

Angle: TypeAlias = Annotated[float, Bounds(0.0, math.tau, "rad")]
"""Radians, at most a full turn."""

Count: TypeAlias = Annotated[int, Bounds(1, 1_000_000)]
"""A number of things, at least one."""

Seconds: TypeAlias = Annotated[float, Bounds(1e-3, 1e6, "s")]
"""A time limit, from a millisecond to eleven days."""


def check_fields(settings: object) -> None:
    """Refuse a settings object with a field that its annotation does not allow.

    Numbers become plain `float` and `int`, and sequences tuples, so that equal settings are equal
    and hashable.

    Raises:
        ValueError: names the first such field, its value and correct values.
    """
    kind: type = type(settings)
    for name, hint in _hints(kind).items():
        object.__setattr__(settings, name, checked(name, getattr(settings, name), hint))


def checked(name: str, value: object, hint: Any, limits: Bounds | OneOf = ANY_NUMBER) -> Any:
    """Check a value by its annotation, such as `Annotated[float, Bounds(0, 1)]`, and convert it.

    Args:
        name: of the value, for the message.
        value: to look at.
        hint: a type, `Annotated` or not, a union with None, or a tuple of such.
        limits: of a number or a text.

    Raises:
        ValueError: it is something else; names correct values.
    """
    origin = get_origin(hint)
    if origin is Annotated:
        inner, limits = get_args(hint)
        return checked(name, value, inner, limits)
    if origin in (Union, UnionType):
        return None if value is None else checked(name, value, _but_none(hint), limits)
    if origin is tuple:
        return _checked_tuple(name, value, get_args(hint), limits)
    if hint in (int, float) and isinstance(limits, Bounds):
        return _checked_number(name, value, hint, limits)
    if isinstance(limits, OneOf):
        require(value in limits.choices, name, value, f"one of {', '.join(limits.choices)}")
    elif hint is bool:
        require(isinstance(value, bool | np.bool_), name, value, "True or False")
        return bool(value)
    else:
        check_kind(name, value, origin or hint)
    return value


def require_order(settings: object, *pairs: tuple[str, str]) -> None:
    """Refuse a settings object in which the first field of a pair exceeds the second.

    Raises:
        ValueError: names both fields and their values.
    """
    for small, large in pairs:
        least, most = getattr(settings, small), getattr(settings, large)
        require(least <= most, small, least, f"at most {large}, which is {shown(most)}")


def require_span(name: str, span: tuple[float, float]) -> None:
    """Refuse a range whose first value exceeds the second.

    Raises:
        ValueError: names it.
    """
    require(span[0] <= span[1], name, span, "the least and then the most")


def _checked_number(name: str, value: Any, kind: type, limits: Bounds) -> float:
    right = f"a {'whole ' if kind is int else ''}number {limits}"
    numbers: Any = Integral if kind is int else Real
    fits = isinstance(value, numbers) and not isinstance(value, bool)
    require(fits and limits.least <= value <= limits.most, name, value, right)
    return int(value) if kind is int else float(value)


def _checked_tuple(name: str, value: Any, hints: tuple[Any, ...], limits: Bounds | OneOf) -> Any:
    """A tuple with a hint for each value, or with one hint and an ellipsis."""
    is_row = isinstance(value, Sequence) and not isinstance(value, str | bytes)
    is_row = is_row or (isinstance(value, np.ndarray) and value.ndim > 0)
    if hints[-1] is Ellipsis:
        require(is_row, name, value, "a tuple")
        hints = hints[:1] * len(value)
    require(is_row and len(value) == len(hints), name, value, f"a tuple of {len(hints)}")
    parts = enumerate(zip(value, hints, strict=True))
    return tuple(checked(f"{name}[{i}]", part, hint, limits) for i, (part, hint) in parts)


def _but_none(hint: Any) -> Any:
    return next(part for part in get_args(hint) if part is not NoneType)


@cache
def _hints(kind: type) -> dict[str, Any]:
    """The annotations of a settings class, resolved."""
    return get_type_hints(kind, include_extras=True)
