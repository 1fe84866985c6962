"""Encodes commands as tokens."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

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
    OwnClause,
    SearchHouse,
    Stop,
    Turn,
)
from semnav_env.language.command import MAX_CLAUSES, Command
from semnav_env.language.references import (
    AMOUNT_STEP,
    OTHER,
    Distance,
    DoorReference,
    PlaceReference,
    RoomReference,
    Side,
)
from semnav_env.language.rooms import plain_name
from semnav_env.language.tokens import (
    CLAUSE_FEATURES,
    CONDITION_CASES,
    DEGREES,
    DOOR,
    EVERY_ROOM,
    LAST_TOKEN,
    MAX_NUMBER,
    OTHER_TOKEN,
    ROOM,
    SECONDS,
    TOKEN_REFERENTS,
    TOKEN_SIDES,
    TOKEN_TURNINGS,
    Row,
    TokenVerb,
)


def encode(command: Command, rooms: Sequence[str] = ()) -> NDArray[np.int64]:
    """The tokens of a command: shape (`MAX_CLAUSES`, `CLAUSE_FEATURES`), one clause a row.

    The columns are verb, turning, referent, number and side, as `tokens` lays them out. Rows after
    the last clause are zero.

    Args:
        command: what to encode.
        rooms: names of the rooms that it may name; the number of a room is its place among them.

    Raises:
        ValueError: the command names a room that is not among the first `MAX_NUMBER` of them.
    """
    tokens = np.zeros((MAX_CLAUSES, CLAUSE_FEATURES), dtype=np.int64)
    tokens[: len(command.clauses)] = [row_of(clause, rooms) for clause in command.clauses]
    return tokens


def row_of(clause: Clause, rooms: Sequence[str]) -> Row:
    """The token of a clause; `rooms` as for `encode`."""
    match clause:
        case Follow(until, past):
            return (TokenVerb.PASS if past else TokenVerb.FOLLOW, 0, *_reference_row(until, rooms))
        case Face(Side() as side):
            return (TokenVerb.TURN, 0, 0, 0, TOKEN_SIDES.index(side))
        case Face(DoorReference() | PlaceReference() | RoomReference() as what):
            return (TokenVerb.TURN, 0, *_reference_row(what, rooms))
        case Turn(turning, at, None):
            return (TokenVerb.TURN, TOKEN_TURNINGS.index(turning), *_reference_row(at))
        case Turn(turning, _, int(degrees)):
            number = degrees // DEGREE_STEP
            return (
                TokenVerb.TURN,
                TOKEN_TURNINGS.index(turning),
                TOKEN_REFERENTS.index(DEGREES),
                number,
                0,
            )
        case GoToDoor(door, approach):
            verb = TokenVerb.GO_THROUGH if approach is Approach.THROUGH else TokenVerb.GO_TO
            return (verb, int(approach is Approach.IN), *_reference_row(door))
        case GoToRoom(name, approach):
            return (
                TokenVerb.GO_TO_ROOM,
                int(approach is Approach.TO),
                TOKEN_REFERENTS.index(ROOM),
                _room_number(name, rooms),
                0,
            )
        case SearchHouse():
            return (TokenVerb.GO_TO_ROOM, 0, TOKEN_REFERENTS.index(ROOM), EVERY_ROOM, 0)
        case Leave():
            return (TokenVerb.LEAVE, 0, 0, 0, 0)
        case GoBack():
            return (TokenVerb.GO_BACK, 0, 0, 0, 0)
        case IfThere(what, absent, otherwise):
            return (
                TokenVerb.IF_THERE,
                CONDITION_CASES.index((absent, otherwise)),
                *_reference_row(what),
            )
        case Stop(seconds):
            return (TokenVerb.STOP, 0, TOKEN_REFERENTS.index(SECONDS) if seconds else 0, seconds, 0)
        case OwnClause(stand_in=known):
            return row_of(known, rooms)
    raise TypeError(f"{clause!r} is no clause")


def _room_number(name: str, rooms: Sequence[str]) -> int:
    names = [plain_name(room) for room in rooms[:MAX_NUMBER]]
    if name not in names:
        known = ", ".join(rooms) or "none"
        raise ValueError(f"there is no room {name!r} to be numbered; there are: {known}")
    return 1 + names.index(name)


def _reference_row(
    reference: PlaceReference | DoorReference | RoomReference | Distance | None,
    rooms: Sequence[str] = (),
) -> Row:
    match reference:
        case RoomReference(name):
            return (TOKEN_REFERENTS.index(ROOM), _room_number(name, rooms), 0)
        case None:
            return (0, 0, 0)
        case DoorReference(ordinal, side):
            return (TOKEN_REFERENTS.index(DOOR), _ordinal_token(ordinal), TOKEN_SIDES.index(side))
        case PlaceReference(place, ordinal):
            return (TOKEN_REFERENTS.index(place), _ordinal_token(ordinal), 0)
        case Distance(amount, unit):
            return (TOKEN_REFERENTS.index(unit), round(amount / AMOUNT_STEP[unit]), 0)


def _ordinal_token(ordinal: int) -> int:
    if ordinal == OTHER:
        return OTHER_TOKEN
    return ordinal if ordinal > 0 else LAST_TOKEN - ordinal - 1
