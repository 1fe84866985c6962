"""The layout of tokens: a command as rows of small integers, for agents that learn."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from gymnasium.spaces import Box
from numpy.typing import ArrayLike, NDArray

from semnav_env.language.clauses import Turning
from semnav_env.language.command import MAX_CLAUSES
from semnav_env.language.declarations import DEGREES, DOOR, ROOM, SECONDS, TokenVerb
from semnav_env.language.references import MAX_FROM_END, MAX_ORDINAL, Place, Side, Unit

Row: TypeAlias = tuple[int, ...]
"""The token of one clause: a value for each column."""


TOKEN_TURNINGS = (None, Turning.LEFT, Turning.RIGHT, Turning.AROUND)
"""The first column is a `TokenVerb`, the second one an index into these; a turn without one is to
face its referent.

For `GO_TO` 1 means in the doorway, 2 to a person and 3 to ask one. For `GO_TO_ROOM` 1 means in
front of the room and 2 to search it, or where the robot is. For `STOP` 1 and 2 are no stop but a
pace, slow and fast. "Look around" is to turn around with `ROOM`, and "call" to stop with it."""

CONDITION_CASES = ((False, False), (False, True), (True, False), (True, True))
"""The second column of a condition is an index into these pairs: whether it asks for something
absent, and whether it has an otherwise."""

TOKEN_REFERENTS = (
    *(None, DOOR, Place.INTERSECTION, Place.CORNER, Place.END, Place.T_JUNCTION, Place.TURNING),
    *(Unit.METRES, Unit.STEPS, DEGREES, SECONDS, ROOM),
)
"""The third column is an index into these: what the clause refers to, or what its number counts."""

MAX_NUMBER = 100
"""The fourth column is a number from 0 (none) to this.

It is the ordinal of a door or place: 1 to `MAX_ORDINAL`, then from `LAST_TOKEN` on the last, the
second to last and so on, then `OTHER_TOKEN` for the other one and `ENTRY_TOKEN` for the one by
which the robot came. For a distance it is the number of half metres (0 for "a bit") or of steps,
for a turn the number of `DEGREE_STEP`, for a wait the number of seconds, and for a room its place
among the names, from 1; 0 stands for all of them.
"""

LAST_TOKEN = MAX_ORDINAL + 1
"""The number of "the last"; the nth from the end is n - 1 more."""

OTHER_TOKEN = LAST_TOKEN + MAX_FROM_END
"""The number of "the other"."""

ENTRY_TOKEN = OTHER_TOKEN + 1
"""The number of "the door we came in by"."""

TOKEN_SIDES = (None, Side.LEFT, Side.RIGHT, Side.AHEAD, Side.BEHIND, Side.OPPOSITE)
"""The fifth column is an index into these."""

COLUMN_SIZES = (
    len(TokenVerb),
    len(TOKEN_TURNINGS),
    len(TOKEN_REFERENTS),
    MAX_NUMBER + 1,
    len(TOKEN_SIDES),
)
"""How many values each column has: verb, turning, referent, number, side."""

CLAUSE_FEATURES = len(COLUMN_SIZES)
"""How many columns a token has."""


def is_pace(tokens: NDArray[np.integer]) -> NDArray[np.bool_]:
    """Which rows, shape (..., 5), say only how fast to drive."""
    paces: NDArray[np.bool_] = (tokens[..., 0] == TokenVerb.STOP) & (tokens[..., 1] > 0)
    return paces


def token_space() -> Box:
    """The space of `encode`'s arrays: shape (`MAX_CLAUSES`, `CLAUSE_FEATURES`), int64."""
    high = np.tile(np.array(COLUMN_SIZES, dtype=np.int64) - 1, (MAX_CLAUSES, 1))
    return Box(np.zeros_like(high), high, dtype=np.int64)


def token_mask(tokens: ArrayLike) -> NDArray[np.bool_]:
    """Which rows hold a clause: shape (`MAX_CLAUSES`,); rows of zeros hold none."""
    return np.asarray(np.any(np.reshape(tokens, (MAX_CLAUSES, CLAUSE_FEATURES)), axis=1))
