"""Random well-formed commands without regard to a building, for tests and language learning."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeVar

import numpy as np

from semnav_env.language.clauses import (
    DEGREE_STEP,
    MAX_DEGREES,
    MAX_SECONDS,
    Approach,
    Clause,
    Follow,
    GoBack,
    GoToDoor,
    IfThere,
    Leave,
    Stop,
    Turn,
    Turning,
)
from semnav_env.language.command import MAX_CLAUSES, Command
from semnav_env.language.references import (
    AMOUNT_STEP,
    LAST,
    MAX_AMOUNT,
    MAX_FROM_END,
    MAX_ORDINAL,
    OTHER,
    Distance,
    DoorReference,
    Place,
    PlaceReference,
    Side,
    Unit,
)

T = TypeVar("T")

CONDITION_SHARE = 0.1
"""Share of conditions among sampled clauses, where there is room for the clauses that depend on
them."""


def check_generator(rng: object) -> None:
    """Refuse anything that is not a NumPy generator, such as a bare seed.

    Raises:
        TypeError: it is not; says how to make one.
    """
    if not isinstance(rng, np.random.Generator):
        raise TypeError(f"rng is {rng!r}; give a generator: np.random.default_rng(0)")


def sample_command(
    rng: np.random.Generator, max_clauses: int = MAX_CLAUSES, max_ordinal: int = MAX_ORDINAL
) -> Command:
    """A command of 1 to `max_clauses` random clauses.

    Args:
        rng: source of randomness.
        max_clauses: 1 to `MAX_CLAUSES`.
        max_ordinal: the highest ordinal to use, 1 to `MAX_ORDINAL`.

    Raises:
        TypeError: `rng` is no generator.
    """
    check_generator(rng)
    number = int(rng.integers(1, max_clauses + 1))
    clauses: list[Clause] = []
    while len(clauses) < number:
        if number - len(clauses) > 1 and rng.random() < CONDITION_SHARE:
            clauses += _conditional(rng, max_ordinal, number - len(clauses) > 2)
        else:
            clauses.append(sample_clause(rng, max_ordinal))
    return Command(tuple(clauses))


def sample_clause(rng: np.random.Generator, max_ordinal: int = MAX_ORDINAL) -> Clause:
    """A random clause; each kind of clause is equally likely.

    There are no rooms, whose names belong to a building, and no conditions, which need clauses that
    depend on them.
    """
    kind = _choose(rng, (Follow, Turn, GoToDoor, Leave, GoBack, Stop))
    if kind is Follow:
        return _follow(rng, max_ordinal)
    if kind is Turn:
        return _turn(rng, max_ordinal)
    if kind is GoToDoor:
        return GoToDoor(_door(rng, max_ordinal), _choose(rng, (Approach.TO, Approach.THROUGH)))
    if kind is Stop:
        return Stop(_choose(rng, (0, int(rng.integers(1, MAX_SECONDS + 1)))))
    return Leave() if kind is Leave else GoBack()


def _conditional(rng: np.random.Generator, max_ordinal: int, otherwise: bool) -> list[Clause]:
    """A condition with the clauses that depend on it."""
    whats = (_door(rng, max_ordinal), _place(rng, max_ordinal))
    what = whats[int(rng.integers(2))]
    condition = IfThere(what, _choose(rng, (False, True)), otherwise and rng.random() < 0.5)
    dependent = 2 if condition.otherwise else 1
    return [condition, *(sample_clause(rng, max_ordinal) for _ in range(dependent))]


def _follow(rng: np.random.Generator, max_ordinal: int) -> Follow:
    door, place = _door(rng, max_ordinal), _place(rng, max_ordinal)
    past = _choose(rng, (door, place if place.place is not Place.END else door))
    ways = (Follow(), Follow(place), Follow(door), Follow(_distance(rng)), Follow(past, past=True))
    return _choose(rng, ways)


def _turn(rng: np.random.Generator, max_ordinal: int) -> Turn:
    turning = _choose(rng, tuple(Turning))
    degrees = DEGREE_STEP * int(rng.integers(1, MAX_DEGREES // DEGREE_STEP + 1))
    ways = [Turn(turning), Turn(turning, _place(rng, max_ordinal))]
    if turning is not Turning.AROUND:
        ways.append(Turn(turning, degrees=degrees))
    return _choose(rng, ways)


def _distance(rng: np.random.Generator) -> Distance:
    unit = _choose(rng, tuple(Unit))
    most = round(MAX_AMOUNT[unit] / AMOUNT_STEP[unit])
    return Distance(AMOUNT_STEP[unit] * int(rng.integers(1, most + 1)), unit)


def _door(rng: np.random.Generator, max_ordinal: int) -> DoorReference:
    counted = (*range(1, max_ordinal + 1), *_from_end(max_ordinal))
    return DoorReference(_choose(rng, (OTHER, *counted)), _choose(rng, (None, *Side)))


def _place(rng: np.random.Generator, max_ordinal: int) -> PlaceReference:
    place = _choose(rng, tuple(Place))
    counted = (*range(1, max_ordinal + 1), *_from_end(max_ordinal))
    return PlaceReference(place, 1 if place == Place.END else _choose(rng, counted))


def _from_end(max_ordinal: int) -> range:
    return range(LAST, -min(max_ordinal, MAX_FROM_END) - 1, -1)


def _choose(rng: np.random.Generator, choices: Sequence[T]) -> T:
    return choices[int(rng.integers(len(choices)))]
