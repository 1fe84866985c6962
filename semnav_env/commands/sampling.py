"""Random well-formed commands, whatever the building; for tests and for learning the language."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeVar

import numpy as np

from semnav_env.commands.clauses import (
    LAST,
    MAX_ORDINAL,
    Approach,
    Clause,
    DoorReference,
    Follow,
    GoToDoor,
    Place,
    PlaceReference,
    Side,
    Stop,
    Turn,
    Turning,
)
from semnav_env.commands.command import MAX_CLAUSES, Command

T = TypeVar("T")


def sample_command(
    rng: np.random.Generator, max_clauses: int = MAX_CLAUSES, max_ordinal: int = MAX_ORDINAL
) -> Command:
    """A command of 1 to `max_clauses` random clauses.

    Args:
        rng: source of randomness.
        max_clauses: 1 to `MAX_CLAUSES`.
        max_ordinal: the highest ordinal to use, 1 to `MAX_ORDINAL`.
    """
    number = int(rng.integers(1, max_clauses + 1))
    return Command(tuple(sample_clause(rng, max_ordinal) for _ in range(number)))


def sample_clause(rng: np.random.Generator, max_ordinal: int = MAX_ORDINAL) -> Clause:
    """A random clause: each kind is equally likely, and each of its readings has a chance."""
    kind = _choose(rng, (Follow, Turn, GoToDoor, Stop))
    if kind is Follow:
        return Follow(_choose(rng, (None, _place(rng, max_ordinal), _door(rng, max_ordinal))))
    if kind is Turn:
        at = _choose(rng, (None, _place(rng, max_ordinal)))
        return Turn(_choose(rng, tuple(Turning)), at)
    if kind is GoToDoor:
        return GoToDoor(_door(rng, max_ordinal), _choose(rng, tuple(Approach)))
    return Stop()


def _door(rng: np.random.Generator, max_ordinal: int) -> DoorReference:
    ordinal = _choose(rng, (LAST, *range(1, max_ordinal + 1)))
    return DoorReference(ordinal, _choose(rng, (None, *Side)))


def _place(rng: np.random.Generator, max_ordinal: int) -> PlaceReference:
    place = _choose(rng, tuple(Place))
    ordinal = 1 if place == Place.END else _choose(rng, range(1, max_ordinal + 1))
    return PlaceReference(place, ordinal)


def _choose(rng: np.random.Generator, choices: Sequence[T]) -> T:
    return choices[int(rng.integers(len(choices)))]
