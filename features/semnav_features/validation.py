"""Checks of values before use, and the words of their errors."""

from __future__ import annotations

import math
from collections.abc import Mapping, Set, Sized
from numbers import Integral, Real
from typing import Any, TypeVar

import numpy as np

T = TypeVar("T")

SHOWN = 80
"""Largest number of characters of a value that a message repeats."""


def require(holds: object, name: str, value: object, right: str) -> None:
    """Refuse a value if a condition on it does not hold.

    Args:
        holds: whether the value is correct.
        name: name of the value.
        value: the value, for the message.
        right: correct values, in words that follow "it must be".

    Raises:
        ValueError: names the value and says what would be right.
    """
    if not holds:
        raise ValueError(f"{name} is {shown(value)}; it must be {right}")


def shown(value: object) -> str:
    """A value for a message, shortened if it is long."""
    try:
        return clipped(repr(value))
    except ValueError:  # Python writes no integer of more than some thousand digits
        return f"a {type(value).__name__} that is too long to write"


def clipped(text: str, most: int = SHOWN) -> str:
    """A text for a message, cut to a number of characters."""
    return text if len(text) <= most else f"{text[: most - 3]}..."


def check_kind(name: str, value: object, kind: type) -> None:
    """Refuse a value of another type.

    Args:
        name: of the value.
        value: to look at.
        kind: what it must be an instance of.

    Raises:
        ValueError: it is something else; says what would be right.
    """
    known = "text" if kind is str else f"a {kind.__module__}.{kind.__qualname__}"
    require(isinstance(value, kind), name, value, known)


def by_name(what: str, value: object, kind: type[T], known: Mapping[str, T]) -> T:
    """The value itself, or the known value that it names.

    Args:
        what: such values are, for the message.
        value: one of that kind, or its name.
        kind: of the values.
        known: values by name.

    Raises:
        ValueError: no such name; lists those there are.
    """
    if isinstance(value, kind):
        return value
    if not isinstance(value, str) or value not in known:
        raise ValueError(f"no {what} named {value!r:.80}; there are: {', '.join(known)}")
    return known[value]


def check_count(name: str, value: object) -> None:
    """Refuse a value that is not a whole number of at least 1.

    Raises:
        ValueError: says what would be right.
    """
    whole = isinstance(value, Integral) and not isinstance(value, bool) and int(value) >= 1
    require(whole, name, value, "a whole number, at least 1")


def finite_floats(values: object) -> tuple[float, ...] | None:
    """A row of numbers as floats; None if it is no row, or one of them no finite number.

    Texts, dates, booleans, complex numbers and masked entries are no numbers; sets and
    dictionaries are no rows.
    """
    if type(values) is tuple and all(type(each) is float for each in values):
        return values if all(map(math.isfinite, values)) else None
    if np.ma.is_masked(values):
        return None
    if hasattr(values, "__array__"):
        values = np.asarray(values)
    if not isinstance(values, Sized) or isinstance(values, str | bytes | Set | Mapping):
        return None
    try:
        given: tuple[Any, ...] = tuple(values)  # type: ignore[arg-type]
        numbers = tuple(map(float, given))
    except (TypeError, ValueError, OverflowError):
        return None
    known = all(isinstance(each, Real) and not isinstance(each, bool | np.bool_) for each in given)
    return numbers if known and all(map(math.isfinite, numbers)) else None


def finite_triple(name: str, value: object) -> tuple[float, float, float]:
    """A pose, a velocity or a contact as three floats.

    Raises:
        ValueError: it is not three finite numbers.
    """
    numbers = finite_floats(value)
    require(numbers is not None and len(numbers) == 3, name, value, "three finite numbers")
    x, y, third = numbers or (0.0, 0.0, 0.0)
    return x, y, third


def finite_float(name: str, value: Any, right: str = "a finite number") -> float:
    """A finite number as a float.

    Args:
        name: of the value.
        value: to look at.
        right: what would be right, for the message.

    Raises:
        ValueError: it is none.
    """
    try:
        number = float(value)
    except (TypeError, ValueError, OverflowError):
        number = math.nan
    require(math.isfinite(number), name, value, right)
    return number
