"""Settings of the environment, looked at before anything is made of them."""

from __future__ import annotations

import math
from numbers import Integral, Real


def check_kind(name: str, value: object, kind: type) -> None:
    """Refuse a setting that is of another kind.

    Args:
        name: of the argument.
        value: that was given for it.
        kind: what it must be an instance of.

    Raises:
        ValueError: it is something else; says what would be right.
    """
    if not isinstance(value, kind):
        right = f"{kind.__module__}.{kind.__qualname__}"
        raise ValueError(f"{name} is {value!r:.80}; it must be a {right}")


def check_count(name: str, value: object) -> None:
    """Refuse what is no whole number of at least 1.

    Raises:
        ValueError: says what would be right.
    """
    if isinstance(value, bool) or not isinstance(value, Integral) or value < 1:
        raise ValueError(f"{name} is {value!r:.80}; it must be a whole number, at least 1")


def checked_seconds(max_seconds: object) -> float:
    """A time limit, seconds.

    Raises:
        ValueError: no number, or none that is positive and finite.
    """
    check_kind("max_seconds", max_seconds, Real)
    if not 0 < (seconds := float(max_seconds)) < math.inf:  # type: ignore[arg-type]
        raise ValueError(f"max_seconds is {max_seconds!r}; it must be positive and finite")
    return seconds
