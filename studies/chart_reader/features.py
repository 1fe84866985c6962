"""Features of spans: sorted pairs of a name and a value, which may be features themselves."""

from __future__ import annotations

from typing import Any, TypeAlias

Features: TypeAlias = tuple[tuple[str, Any], ...]


def features(values: dict[str, Any]) -> Features:
    """A dictionary as features."""
    return tuple(sorted(values.items(), key=lambda pair: pair[0]))


def merged(first: Features, second: Features) -> Features | None:
    """Both together; None if they contradict each other."""
    if not first or not second:
        return first or second
    values = dict(first)
    for name, value in second:
        if values.setdefault(name, value) != value:
            return None
    return features(values)


def read_features(text: str) -> Features:
    """Features as they stand in a table: "kind=door ord=1"."""
    pairs = (word.split("=") for word in text.split())
    return features({name: _value(value) for name, value in pairs})


def _value(text: str) -> Any:
    try:
        number = float(text)
    except ValueError:
        return text
    return int(number) if number == int(number) else number
