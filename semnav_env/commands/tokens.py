"""A command as an array of small integers, as a learner sees it, and the space it lives in."""

from __future__ import annotations

from enum import IntEnum
from typing import TypeAlias

import numpy as np
from gymnasium.spaces import Box
from numpy.typing import ArrayLike, NDArray

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

IntArray: TypeAlias = NDArray[np.int64]
Reference: TypeAlias = PlaceReference | DoorReference | None


class Verb(IntEnum):
    """What a clause asks for, the first column."""

    NONE = 0
    FOLLOW = 1
    TURN = 2
    GO_TO = 3
    GO_THROUGH = 4
    STOP = 5


TURNINGS = (None, Turning.LEFT, Turning.RIGHT, Turning.AROUND)
"""The second column."""

DOOR = "door"
REFERENTS = (None, DOOR, Place.INTERSECTION, Place.CORNER, Place.END)
"""What the clause refers to, the third column."""

SIDES = (None, Side.LEFT, Side.RIGHT, Side.AHEAD)
"""The fifth column; the fourth is the ordinal: 0 none, 1 to `MAX_ORDINAL`, then `LAST`."""

LAST_TOKEN = MAX_ORDINAL + 1
COUNTS = (len(Verb), len(TURNINGS), len(REFERENTS), LAST_TOKEN + 1, len(SIDES))
"""How many values each column can take: verb, turning, referent, ordinal, side."""

CLAUSE_FEATURES = len(COUNTS)
"""Columns of the array: verb, turning, referent, ordinal, side."""


def token_space() -> Box:
    """The space of `encode`: shape (`MAX_CLAUSES`, `CLAUSE_FEATURES`), int64."""
    high = np.tile(np.array(COUNTS, dtype=np.int64) - 1, (MAX_CLAUSES, 1))
    return Box(np.zeros_like(high), high, dtype=np.int64)


def encode(command: Command) -> IntArray:
    """The command as integers, shape (`MAX_CLAUSES`, `CLAUSE_FEATURES`), one clause a row.

    Columns: `Verb`, index in `TURNINGS`, index in `REFERENTS`, ordinal (0 none, `LAST_TOKEN` the
    last), index in `SIDES`. Rows after the last clause are zero.
    """
    tokens = np.zeros((MAX_CLAUSES, CLAUSE_FEATURES), dtype=np.int64)
    tokens[: len(command.clauses)] = [_row(clause) for clause in command.clauses]
    return tokens


def decode(tokens: ArrayLike) -> Command:
    """The command that `encode` made into these tokens.

    Raises:
        ValueError: the array has another shape or type, or a row that is no clause.
    """
    array = np.asarray(tokens)
    if array.shape != (MAX_CLAUSES, CLAUSE_FEATURES) or array.dtype.kind not in "iu":
        wanted = f"integers of shape {(MAX_CLAUSES, CLAUSE_FEATURES)}"
        raise ValueError(f"tokens are {wanted}, not {array.dtype} of shape {array.shape}")
    rows = [tuple(row) for row in array.tolist()]
    while rows and not any(rows[-1]):
        rows.pop()
    return Command(tuple(_clause(number, row) for number, row in enumerate(rows)))


def _row(clause: Clause) -> tuple[int, ...]:
    match clause:
        case Follow(until):
            return (Verb.FOLLOW, 0, *_reference_row(until))
        case Turn(turning, at):
            return (Verb.TURN, TURNINGS.index(turning), *_reference_row(at))
        case GoToDoor(door, approach):
            verb = Verb.GO_TO if approach == Approach.TO else Verb.GO_THROUGH
            return (verb, 0, *_reference_row(door))
        case Stop():
            return (Verb.STOP, 0, 0, 0, 0)


def _reference_row(reference: Reference) -> tuple[int, int, int]:
    match reference:
        case None:
            return (0, 0, 0)
        case DoorReference(ordinal, side):
            token = LAST_TOKEN if ordinal == LAST else ordinal
            return (REFERENTS.index(DOOR), token, SIDES.index(side))
        case PlaceReference(place, ordinal):
            return (REFERENTS.index(place), ordinal, 0)


def _clause(number: int, row: tuple[int, ...]) -> Clause:
    """The clause of a row; encoding it again must give the row, or the row is none."""
    problem = f"row {number} of the tokens, {row}, is no clause"
    if not all(0 <= token < count for token, count in zip(row, COUNTS, strict=True)):
        raise ValueError(f"{problem}: its columns go up to {tuple(n - 1 for n in COUNTS)}")
    try:
        clause = _clause_of(row)
    except ValueError as error:
        raise ValueError(f"{problem}: {error}") from None
    if clause is None or _row(clause) != row:
        raise ValueError(problem)
    return clause


def _clause_of(row: tuple[int, ...]) -> Clause | None:
    verb, turning, referent, ordinal, side = row
    reference = _reference(referent, ordinal, side)
    match Verb(verb), TURNINGS[turning], reference:
        case Verb.FOLLOW, _, _:
            return Follow(reference)
        case Verb.TURN, Turning() as way, None | PlaceReference() as at:
            return Turn(way, at)
        case Verb.GO_TO, _, DoorReference() as door:
            return GoToDoor(door, Approach.TO)
        case Verb.GO_THROUGH, _, DoorReference() as door:
            return GoToDoor(door, Approach.THROUGH)
        case Verb.STOP, _, _:
            return Stop()
    return None


def _reference(referent: int, ordinal: int, side: int) -> Reference:
    kind = REFERENTS[referent]
    if kind is None:
        return None
    if isinstance(kind, Place):
        return PlaceReference(kind, ordinal)
    return DoorReference(LAST if ordinal == LAST_TOKEN else ordinal, SIDES[side])
