"""Tells corridors as narrow as a door from doors: one that narrows, and one that leads away."""

from __future__ import annotations

import math
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from semnav_features.frames import FloatArray
from semnav_features.kernels.compiling import kernel

SIDE_RANGE_MIN, SIDE_RANGE_MAX = 0.1, 3.0
"""Distances before and behind the opening between which its sides are looked for, metres."""

CELL_LENGTH = 0.1
"""Length of the pieces in which a side is recorded, metres."""

MIN_LONG_SIDES, MIN_SHORT_SIDES = 1.0, 0.5
"""Sides lead up to the opening and away from it if this length of both is there on one side of the
opening, and that length on the other, metres."""

MAX_SIDE_START = 1.0
"""Farthest from the opening that a side which leads up to it may begin, metres: less than any
corridor that crosses there is wide, and more than what furniture hides of it."""

MIN_THROUGH_SIDE = 1.25
"""A single side runs through if this length of it is there before and behind the opening, metres:
longer than a door leaf."""

MAX_SETBACK = 0.45
"""How far outside the jambs both sides together may lie, metres. A corridor with a door across it
is wider than the door by more than this."""

CORRIDOR_RANGE, CORRIDOR_HALF_WIDTH = 8.0, 1.25
"""Distances before and behind the opening, and beside its middle, within which the sides of a
corridor that goes on are looked for, metres."""

MIN_CORRIDOR_SIDE = 2.5
"""A corridor goes on if this length of either side is there, before and behind the opening,
metres."""

MIN_ARM_SIDE = 2.0
"""Both sides of a hall that leads away from an opening are at least this long, metres: longer than
those of a niche, or of a small room behind a door."""

MAX_ARM_SETBACK_STEP = 2
"""Each of these sides lies at most this many steps outside the jamb: less than 0.14 m. A room is
wider than its door."""

SETBACK_STEPS = 10
"""Steps from a jamb outward to `MAX_SETBACK` in which a side is recorded."""

MAX_INTRUSION = 0.1
"""How far a side may reach into the opening, metres: walls are rough."""

MAX_SIDE_SLOPE = math.tan(math.radians(20.0))
"""Largest slope of a side against the direction through the opening."""

Table: TypeAlias = NDArray[np.int64]
"""By pieces along the sides of an opening: how far outside the jamb the innermost side lies."""


@kernel
def is_narrowing(door: FloatArray, solid: FloatArray) -> bool:
    """Whether an opening across a corridor is no doorway, because the corridor goes on through it.

    It goes on in three cases. (1) Sides about as far apart as the jambs lead up to the opening and
    away from it: the corridor narrows, for instance between a pilaster and a wall; a corridor with
    a door in it, or a room behind a door, is wider than the door. (2) One side runs through: the
    corridor ends in a room or a lobby. (3) Both sides of the corridor go on behind the opening,
    however much narrower that is, as between the corners of two alcoves.

    Args:
        door: the opening's jambs, shape (4,), metres.
        solid: walls and doors, shape (n, 4), metres; the opening may be among them.
    """
    if door[0] == door[2] and door[1] == door[3]:
        return False
    close, far = _sides(door, solid)
    if _goes_on(far):
        return True
    for here, beyond in ((close[0], close[1]), (close[1], close[0])):
        if _runs(here, MIN_LONG_SIDES) and _runs(beyond, MIN_SHORT_SIDES):
            return True
        if _runs(here, MIN_THROUGH_SIDE) and _runs_through(here, beyond):
            return True
    return False


@kernel
def leads_into_arm(door: FloatArray, solid: FloatArray, x: float, y: float) -> bool:
    """Whether a hall as wide as the opening leads away from it, behind it as seen from (x, y).

    Args:
        door: the opening's jambs, shape (4,), metres.
        solid: walls and doors, shape (n, 4), metres; the opening may be among them.
        x: of a place before the opening, metres.
        y: the same.
    """
    dx, dy = door[2] - door[0], door[3] - door[1]
    if dx == 0.0 and dy == 0.0:
        return False
    close, _ = _sides(door, solid)
    behind = close[1] if dx * (y - door[1]) > dy * (x - door[0]) else close[0]
    right = _leads_up(behind[0], MAX_ARM_SETBACK_STEP, MIN_ARM_SIDE)
    return bool(right and _leads_up(behind[1], MAX_ARM_SETBACK_STEP, MIN_ARM_SIDE))


@kernel
def _sides(door: FloatArray, solid: FloatArray) -> tuple[Table, Table]:
    """Record where sides run along the direction through the opening.

    Returns:
        Two tables. Their first two axes are: before or behind the opening; right or left of it.
        Their last axis is the distance from the opening in pieces of `CELL_LENGTH`. The first
        table, up to `SIDE_RANGE_MAX`, says how far outside the jamb a side lies, in steps up to
        `MAX_SETBACK`; `SETBACK_STEPS` where there is none. In the second, up to `CORRIDOR_RANGE`,
        it is 0 where there is a side within `CORRIDOR_HALF_WIDTH`, else 1.
    """
    pieces = round((SIDE_RANGE_MAX - SIDE_RANGE_MIN) / CELL_LENGTH)
    close = np.full((2, 2, pieces), SETBACK_STEPS, np.int64)
    pieces = round((CORRIDOR_RANGE - SIDE_RANGE_MIN) / CELL_LENGTH)
    far = np.ones((2, 2, pieces), np.int64)
    x, y = 0.5 * (door[0] + door[2]), 0.5 * (door[1] + door[3])
    dx, dy = door[2] - door[0], door[3] - door[1]
    width = math.hypot(dx, dy)
    c, s = dx / width, dy / width
    for i in range(len(solid)):
        across1 = c * (solid[i, 0] - x) + s * (solid[i, 1] - y)
        across2 = c * (solid[i, 2] - x) + s * (solid[i, 3] - y)
        along1 = c * (solid[i, 1] - y) - s * (solid[i, 0] - x)
        along2 = c * (solid[i, 3] - y) - s * (solid[i, 2] - x)
        if abs(across2 - across1) >= MAX_SIDE_SLOPE * abs(along2 - along1):
            continue
        side, aside = _beside(0.5 * (across1 + across2), 0.5 * width)
        if -MAX_INTRUSION <= aside < CORRIDOR_HALF_WIDTH - 0.5 * width:
            _mark(along1, along2, 0, far[0, side])
            _mark(-along1, -along2, 0, far[1, side])
        if -MAX_INTRUSION <= aside < MAX_SETBACK:
            step = int(max(0.0, aside) / MAX_SETBACK * SETBACK_STEPS)
            _mark(along1, along2, step, close[0, side])
            _mark(-along1, -along2, step, close[1, side])
    return close, far


@kernel
def _goes_on(far: Table) -> bool:
    """Whether both sides of a corridor are there before and behind the opening."""
    for end in range(2):
        for side in range(2):
            if _length(far[end, side], 0) < MIN_CORRIDOR_SIDE:
                return False
    return True


@kernel
def _beside(across: float, half: float) -> tuple[int, float]:
    """On which side of the opening something lies, and how far outside the jamb, metres."""
    return (1 if across > 0.0 else 0), abs(across) - half


@kernel
def _mark(along1: float, along2: float, step: int, steps: Table) -> None:
    """Note a side in the pieces that a segment covers at positive distances from the opening."""
    first = math.ceil((min(along1, along2) - SIDE_RANGE_MIN) / CELL_LENGTH - 0.5)
    last = math.floor((max(along1, along2) - SIDE_RANGE_MIN) / CELL_LENGTH - 0.5)
    for k in range(max(first, 0), min(last, len(steps) - 1) + 1):
        steps[k] = min(steps[k], step)


@kernel
def _runs_through(here: Table, beyond: Table) -> bool:
    """Whether one side runs on from this side of the opening to beyond it."""
    last = SETBACK_STEPS - 1
    for side in range(2):
        if min(_length(here[side], last), _length(beyond[side], last)) >= MIN_THROUGH_SIDE:
            return True
    return False


@kernel
def _length(steps: Table, most: int) -> float:
    """Length of the pieces with a side `most` steps outside the jamb or less, metres.

    It is 1 nm more, against rounding in comparisons.
    """
    count = 0
    for k in range(len(steps)):
        count += steps[k] <= most
    return count * CELL_LENGTH + 1e-9


@kernel
def _runs(there: Table, length: float) -> bool:
    """Whether both sides have a length, together less than `MAX_SETBACK` outside the jambs."""
    aside = 0.0
    for side in range(2):
        step = 0
        while step < SETBACK_STEPS and not _leads_up(there[side], step, length):
            step += 1
        aside += MAX_SETBACK * step / SETBACK_STEPS
    return aside < MAX_SETBACK - 1e-9


@kernel
def _leads_up(steps: Table, most: int, length: float) -> bool:
    """Whether a side of a length, `most` steps outside the jamb or less, begins near the opening.

    The sides of a corridor that ends beyond a crossing, or of a room beyond, do not.
    """
    first = 0
    while first < len(steps) and steps[first] > most:
        first += 1
    return bool(first * CELL_LENGTH <= MAX_SIDE_START and _length(steps, most) >= length)
