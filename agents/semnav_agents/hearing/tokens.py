"""The input features of the network for a clause and the clause before it."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from semnav_agents.base import Observation
from semnav_env.language.clauses import DEGREE_STEP
from semnav_env.language.declarations import DEGREES, SECONDS
from semnav_env.language.references import AMOUNT_STEP, STEP_LENGTH, Unit
from semnav_env.language.tokens import (
    CLAUSE_FEATURES,
    COLUMN_SIZES,
    LAST_TOKEN,
    TOKEN_REFERENTS,
    is_pace,
)
from semnav_env.mind.observations import MEMORY_TABLES
from semnav_env.rules import GroundingRules

MOST_COUNTED = 12
"""Largest ordinal with a number of its own in the description."""

MOST_FROM_END = 4
"""Number of ordinals from the end that have a number of their own."""

_METRES = {
    TOKEN_REFERENTS.index(Unit.METRES): AMOUNT_STEP[Unit.METRES],
    TOKEN_REFERENTS.index(Unit.STEPS): AMOUNT_STEP[Unit.STEPS] * STEP_LENGTH,
}
_DEGREES, _SECONDS = TOKEN_REFERENTS.index(DEGREES), TOKEN_REFERENTS.index(SECONDS)
_ONE_HOT = (COLUMN_SIZES[0], COLUMN_SIZES[1], COLUMN_SIZES[2], COLUMN_SIZES[4])
_AMOUNTS = 5

CLAUSE_SIZE = sum(_ONE_HOT) + MOST_COUNTED + MOST_FROM_END + _AMOUNTS
"""Numbers that describe one clause."""

COMMAND_SIZE = 2 * CLAUSE_SIZE
"""Number of values that describe the active clause and the one before it."""


def without_paces(observation: Observation) -> Observation:
    """The observation of a command without its paces, which the network does not know.

    The clauses behind a pace move up, also in what was told of their ways.
    """
    tokens = observation["command"].reshape(-1, CLAUSE_FEATURES)
    paces = is_pace(tokens)
    if not paces.any():
        return observation
    kept = np.concatenate((tokens[~paces], np.zeros_like(tokens[paces])))
    plain = {**observation, "command": kept.ravel()}
    before = np.cumsum(paces)
    for table in MEMORY_TABLES:
        if table.columns[0] == "clause":
            rows = observation[table.name].reshape(table.rows, -1).copy()
            rows[:, 0] -= before[rows[:, 0].astype(int)]
            plain[table.name] = rows.ravel()
    return plain


def describe_clauses(tokens: NDArray[np.int64], clause: int) -> NDArray[np.float32]:
    """Describe the active clause and the one before it, shape (COMMAND_SIZE,).

    Args:
        tokens: of the command, shape (8, 5).
        clause: index of the current clause of the command.
    """
    before = np.zeros_like(tokens[0]) if clause == 0 else tokens[clause - 1]
    return np.concatenate((_describe(tokens[clause]), _describe(before)))


def _describe(row: NDArray[np.int64]) -> NDArray[np.float32]:
    """The features of one clause; zeros if there is no clause."""
    if not row.any():
        return np.zeros(CLAUSE_SIZE, np.float32)
    verb, turning, referent, number, side = (int(value) for value in row)
    hot = np.zeros(sum(_ONE_HOT), np.float32)
    for start, value in zip(
        np.cumsum((0, *_ONE_HOT)), (verb, turning, referent, side), strict=False
    ):
        hot[start + value] = 1.0
    counts = np.zeros(MOST_COUNTED + MOST_FROM_END, np.float32)
    from_end = number - LAST_TOKEN
    if referent in (_DEGREES, _SECONDS, *_METRES):
        pass
    elif 1 <= number <= MOST_COUNTED:
        counts[number - 1] = 1.0
    elif 0 <= from_end < MOST_FROM_END:
        counts[MOST_COUNTED + from_end] = 1.0
    return np.concatenate((hot, counts, _amounts(referent, number)))


def _amounts(referent: int, number: int) -> NDArray[np.float32]:
    """Metres, cosine and sine of an angle, seconds; each with a scale near 1.

    No metres are "a bit".
    """
    amounts = np.zeros(_AMOUNTS, np.float32)
    if referent in _METRES:
        metres = number * _METRES[referent] or GroundingRules().some_distance
        amounts[0] = metres / 10.0
    elif referent == _DEGREES:
        angle = math.radians(number * DEGREE_STEP)
        amounts[1:4] = math.cos(angle), math.sin(angle), angle / math.pi
    elif referent == _SECONDS:
        amounts[4] = number / 10.0
    return amounts
