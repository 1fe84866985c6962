"""A command as an array of small integers, as a learner sees it, and the space it lives in."""

from __future__ import annotations

from collections.abc import Sequence
from enum import IntEnum
from typing import TypeAlias

import numpy as np
from gymnasium.spaces import Box
from numpy.typing import ArrayLike, NDArray

from semnav_env.commands.clauses import (
    DEGREE_STEP,
    Approach,
    Clause,
    Follow,
    GoBack,
    GoToDoor,
    GoToRoom,
    IfThere,
    Leave,
    Stop,
    Turn,
    Turning,
)
from semnav_env.commands.command import MAX_CLAUSES, Command
from semnav_env.commands.references import (
    MAX_FROM_END,
    MAX_ORDINAL,
    OTHER,
    QUANTUM,
    Distance,
    DoorReference,
    Place,
    PlaceReference,
    Side,
    Unit,
)
from semnav_env.commands.rooms import plain_name

IntArray: TypeAlias = NDArray[np.int64]
Row: TypeAlias = tuple[int, ...]


class Verb(IntEnum):
    """What a clause asks for, the first column.

    A condition asks for nothing; its second column says in which case (`CASES`).
    """

    IF_THERE = 0
    FOLLOW = 1
    TURN = 2
    GO_TO = 3
    GO_THROUGH = 4
    STOP = 5
    PASS = 6
    GO_TO_ROOM = 7
    LEAVE = 8
    GO_BACK = 9


TURNINGS = (None, Turning.LEFT, Turning.RIGHT, Turning.AROUND)
"""The second column."""

CASES = ((False, False), (False, True), (True, False), (True, True))
"""The second column of a condition: whether it is for something absent, and whether it has an
otherwise."""

DOOR, DEGREES, SECONDS, ROOM = "door", "degrees", "seconds", "room"
REFERENTS = (
    *(None, DOOR, Place.INTERSECTION, Place.CORNER, Place.END, Place.T_JUNCTION, Place.TURNING),
    *(Unit.METRES, Unit.STEPS, DEGREES, SECONDS, ROOM),
)
"""What the clause refers to, or what its number counts; the third column."""

MAX_NUMBER = 100
"""The fourth column is a number from 0 (none) to this.

For doors and places the ordinal: 1 to `MAX_ORDINAL`, then `LAST_TOKEN` the last and onwards the nth
from the end, then `OTHER_TOKEN` the other one. For distances the number of half metres or of steps,
for turns by degrees that of `DEGREE_STEP`, for waits that of seconds, for rooms their place among
the names.
"""

LAST_TOKEN = MAX_ORDINAL + 1
OTHER_TOKEN = LAST_TOKEN + MAX_FROM_END

SIDES = (None, Side.LEFT, Side.RIGHT, Side.AHEAD, Side.BEHIND, Side.OPPOSITE)
"""The fifth column."""

COUNTS = (len(Verb), len(TURNINGS), len(REFERENTS), MAX_NUMBER + 1, len(SIDES))
"""How many values each column can take: verb, turning, referent, number, side."""

CLAUSE_FEATURES = len(COUNTS)
"""Columns of the array: verb, turning, referent, number, side."""


def token_space() -> Box:
    """The space of `encode`: shape (`MAX_CLAUSES`, `CLAUSE_FEATURES`), int64."""
    high = np.tile(np.array(COUNTS, dtype=np.int64) - 1, (MAX_CLAUSES, 1))
    return Box(np.zeros_like(high), high, dtype=np.int64)


def token_mask(tokens: ArrayLike) -> NDArray[np.bool_]:
    """Which rows of tokens hold a clause, shape (`MAX_CLAUSES`,)."""
    return np.asarray(np.any(np.reshape(tokens, (MAX_CLAUSES, CLAUSE_FEATURES)), axis=1))


def encode(command: Command, rooms: Sequence[str] = ()) -> IntArray:
    """The command as integers, shape (`MAX_CLAUSES`, `CLAUSE_FEATURES`), one clause a row.

    Columns: `Verb`, index in `TURNINGS`, index in `REFERENTS`, number (see `MAX_NUMBER`), index in
    `SIDES`. Rows after the last clause are zero; `token_mask` says which are not.

    Args:
        command: to be encoded.
        rooms: the names of rooms that it may speak of; their numbers are their places in it.

    Raises:
        ValueError: the command names a room that is not among them, or is beyond the hundredth.
    """
    tokens = np.zeros((MAX_CLAUSES, CLAUSE_FEATURES), dtype=np.int64)
    tokens[: len(command.clauses)] = [_row(clause, rooms) for clause in command.clauses]
    return tokens


def decode(tokens: ArrayLike, rooms: Sequence[str] = ()) -> Command:
    """The command that `encode` made into these tokens.

    Args:
        tokens: from `encode`.
        rooms: as they were given to it.

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


def _row(clause: Clause, rooms: Sequence[str]) -> Row:
    match clause:
        case Follow(until, past):
            return (Verb.PASS if past else Verb.FOLLOW, 0, *_reference_row(until))
        case Turn(turning, at, None):
            return (Verb.TURN, TURNINGS.index(turning), *_reference_row(at))
        case Turn(turning, _, int(degrees)):
            number = degrees // DEGREE_STEP
            return (Verb.TURN, TURNINGS.index(turning), REFERENTS.index(DEGREES), number, 0)
        case GoToDoor(door, approach):
            verb = Verb.GO_TO if approach == Approach.TO else Verb.GO_THROUGH
            return (verb, 0, *_reference_row(door))
        case GoToRoom(name):
            return (Verb.GO_TO_ROOM, 0, REFERENTS.index(ROOM), _room_number(name, rooms), 0)
        case Leave():
            return (Verb.LEAVE, 0, 0, 0, 0)
        case GoBack():
            return (Verb.GO_BACK, 0, 0, 0, 0)
        case IfThere(what, absent, otherwise):
            return (Verb.IF_THERE, CASES.index((absent, otherwise)), *_reference_row(what))
        case Stop(seconds):
            return (Verb.STOP, 0, REFERENTS.index(SECONDS) if seconds else 0, seconds, 0)
    raise TypeError(f"{clause!r} is no clause")


def _room_number(name: str, rooms: Sequence[str]) -> int:
    names = [plain_name(room) for room in rooms[:MAX_NUMBER]]
    if name not in names:
        known = ", ".join(rooms) or "none"
        raise ValueError(f"there is no room {name!r} to be numbered; there are: {known}")
    return 1 + names.index(name)


def _reference_row(reference: PlaceReference | DoorReference | Distance | None) -> Row:
    match reference:
        case None:
            return (0, 0, 0)
        case DoorReference(ordinal, side):
            return (REFERENTS.index(DOOR), _ordinal_token(ordinal), SIDES.index(side))
        case PlaceReference(place, ordinal):
            return (REFERENTS.index(place), _ordinal_token(ordinal), 0)
        case Distance(amount, unit):
            return (REFERENTS.index(unit), round(amount / QUANTUM[unit]), 0)


def _ordinal_token(ordinal: int) -> int:
    if ordinal == OTHER:
        return OTHER_TOKEN
    return ordinal if ordinal > 0 else LAST_TOKEN - ordinal - 1


def _ordinal(token: int) -> int:
    if token == OTHER_TOKEN:
        return OTHER
    if not 1 <= token < OTHER_TOKEN:
        raise ValueError(f"{token} is the number of no ordinal")
    return token if token < LAST_TOKEN else LAST_TOKEN - token - 1


def _clause(number: int, row: Row, rooms: Sequence[str]) -> Clause:
    """The clause of a row; encoding it again must give the row, or the row is none."""
    problem = f"row {number} of the tokens, {row}, is no clause"
    if not all(0 <= token < count for token, count in zip(row, COUNTS, strict=True)):
        raise ValueError(f"{problem}: its columns go up to {tuple(n - 1 for n in COUNTS)}")
    try:
        clause = _clause_of(row, rooms)
    except ValueError as error:
        raise ValueError(f"{problem}: {error}") from None
    if clause is None or _row(clause, rooms) != row:
        raise ValueError(problem)
    return clause


def _clause_of(row: Row, rooms: Sequence[str]) -> Clause | None:
    verb, turning, referent, number, side = row
    if Verb(verb) is Verb.GO_TO_ROOM:
        if not 1 <= number <= len(rooms):
            raise ValueError(f"there are {len(rooms)} rooms")
        return GoToRoom(plain_name(rooms[number - 1]))
    if REFERENTS[referent] == SECONDS:
        return Stop(number)
    reference = _reference(referent, number, side)
    match Verb(verb), TURNINGS[turning], reference:
        case Verb.IF_THERE, _, DoorReference() | PlaceReference() as what:
            return IfThere(what, *CASES[turning])
        case Verb.FOLLOW, _, Distance() | PlaceReference() | DoorReference() | None:
            return Follow(reference)
        case Verb.PASS, _, PlaceReference() | DoorReference():
            return Follow(reference, past=True)
        case Verb.TURN, Turning() as way, None if REFERENTS[referent] == DEGREES:
            return Turn(way, degrees=number * DEGREE_STEP)
        case Verb.TURN, Turning() as way, None | PlaceReference() as at:
            return Turn(way, at)
        case Verb.GO_TO, _, DoorReference() as door:
            return GoToDoor(door, Approach.TO)
        case Verb.GO_THROUGH, _, DoorReference() as door:
            return GoToDoor(door, Approach.THROUGH)
        case Verb.STOP, _, _:
            return Stop()
        case Verb.LEAVE, _, _:
            return Leave()
        case Verb.GO_BACK, _, _:
            return GoBack()
    return None


def _reference(
    referent: int, number: int, side: int
) -> PlaceReference | DoorReference | Distance | None:
    kind = REFERENTS[referent]
    if isinstance(kind, Place):
        return PlaceReference(kind, _ordinal(number))
    if isinstance(kind, Unit):
        return Distance(number * QUANTUM[kind], kind)
    return DoorReference(_ordinal(number), SIDES[side]) if kind == DOOR else None
