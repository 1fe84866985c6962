"""Decodes tokens to commands: the inverse of `encoding`."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from semnav_env.language.clauses import (
    DEGREE_STEP,
    Approach,
    Clause,
    Face,
    Follow,
    GoBack,
    GoToDoor,
    GoToRoom,
    IfThere,
    Leave,
    SearchHouse,
    Stop,
    Turn,
    Turning,
)
from semnav_env.language.command import MAX_CLAUSES, Command
from semnav_env.language.encoding import row_of
from semnav_env.language.references import (
    AMOUNT_STEP,
    OTHER,
    Distance,
    DoorReference,
    Place,
    PlaceReference,
    RoomReference,
    Unit,
)
from semnav_env.language.rooms import plain_name
from semnav_env.language.tokens import (
    CLAUSE_FEATURES,
    COLUMN_SIZES,
    CONDITION_CASES,
    DEGREES,
    DOOR,
    EVERY_ROOM,
    LAST_TOKEN,
    OTHER_TOKEN,
    ROOM,
    SECONDS,
    TOKEN_REFERENTS,
    TOKEN_SIDES,
    TOKEN_TURNINGS,
    Row,
    TokenVerb,
)


def decode(tokens: ArrayLike, rooms: Sequence[str] = ()) -> Command:
    """The command of an array that `encode` made.

    Args:
        tokens: shape (`MAX_CLAUSES`, `CLAUSE_FEATURES`), of integers.
        rooms: the same names that `encode` was given.

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
    return Command(tuple(_clause(number, row, rooms) for number, row in enumerate(rows)))


def _ordinal(token: int) -> int:
    if token == OTHER_TOKEN:
        return OTHER
    if not 1 <= token < OTHER_TOKEN:
        raise ValueError(f"{token} is the number of no ordinal")
    return token if token < LAST_TOKEN else LAST_TOKEN - token - 1


def _clause(number: int, row: Row, rooms: Sequence[str]) -> Clause:
    """The clause of a row; a row is valid only if encoding its clause gives it again."""
    problem = f"row {number} of the tokens, {row}, is no clause"
    if not all(0 <= token < count for token, count in zip(row, COLUMN_SIZES, strict=True)):
        raise ValueError(f"{problem}: its columns go up to {tuple(n - 1 for n in COLUMN_SIZES)}")
    try:
        clause = _clause_of(row, rooms)
    except ValueError as error:
        raise ValueError(f"{problem}: {error}") from None
    if clause is None or row_of(clause, rooms) != row:
        raise ValueError(problem)
    return clause


def _clause_of(row: Row, rooms: Sequence[str]) -> Clause | None:
    verb, turning, referent, number, side = row
    if TokenVerb(verb) is TokenVerb.GO_TO_ROOM:
        if number == EVERY_ROOM:
            return SearchHouse()
        return GoToRoom(_room(number, rooms), Approach.TO if turning else Approach.THROUGH)
    if TOKEN_REFERENTS[referent] == SECONDS:
        return Stop(number)
    reference = _reference(referent, number, side, rooms)
    match TokenVerb(verb), TOKEN_TURNINGS[turning], reference:
        case TokenVerb.IF_THERE, _, DoorReference() | PlaceReference() as what:
            return IfThere(what, *CONDITION_CASES[turning])
        case TokenVerb.TURN, None, None:
            wall = TOKEN_SIDES[side]
            return None if wall is None else Face(wall)
        case TokenVerb.TURN, None, DoorReference() | PlaceReference() | RoomReference() as what:
            return Face(what)
        case TokenVerb.FOLLOW | TokenVerb.PASS as way, _, RoomReference() as room:
            return Follow(room, past=way is TokenVerb.PASS)
        case TokenVerb.FOLLOW, _, Distance() | PlaceReference() | DoorReference() | None:
            return Follow(reference)
        case TokenVerb.PASS, _, PlaceReference() | DoorReference():
            return Follow(reference, past=True)
        case TokenVerb.TURN, Turning() as way, None if TOKEN_REFERENTS[referent] == DEGREES:
            return Turn(way, degrees=number * DEGREE_STEP)
        case TokenVerb.TURN, Turning() as way, None | PlaceReference() as at:
            return Turn(way, at)
        case TokenVerb.GO_TO, _, DoorReference() as door:
            return GoToDoor(door, Approach.IN if turning else Approach.TO)
        case TokenVerb.GO_THROUGH, _, DoorReference() as door:
            return GoToDoor(door, Approach.THROUGH)
        case TokenVerb.STOP, _, _:
            return Stop()
        case TokenVerb.LEAVE, _, _:
            return Leave()
        case TokenVerb.GO_BACK, _, _:
            return GoBack()
    return None


def _room(number: int, rooms: Sequence[str]) -> str:
    if not 1 <= number <= len(rooms):
        raise ValueError(f"there are {len(rooms)} rooms")
    return plain_name(rooms[number - 1])


def _reference(
    referent: int, number: int, side: int, rooms: Sequence[str]
) -> PlaceReference | DoorReference | RoomReference | Distance | None:
    kind = TOKEN_REFERENTS[referent]
    if kind == ROOM:
        return RoomReference(_room(number, rooms))
    if isinstance(kind, Place):
        return PlaceReference(kind, _ordinal(number))
    if isinstance(kind, Unit):
        return Distance(number * AMOUNT_STEP[kind], kind)
    return DoorReference(_ordinal(number), TOKEN_SIDES[side]) if kind == DOOR else None
