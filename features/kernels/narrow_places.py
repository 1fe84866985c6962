"""Numba kernel that tells where a corridor narrows to the width of a door from a door across it."""

from __future__ import annotations

import math

import numpy as np
from numba import njit
from numpy.typing import NDArray

from semnav_env.features.frames import FloatArray

NEAREST, FARTHEST = 0.1, 3.0
"""So far before and behind the opening its sides are looked for, metres."""

BIN = 0.1
"""In pieces of this length, metres."""

LONG, SHORT = 1.0, 0.5
"""Sides run on if so much of them is there, on one side of the opening and on the other, metres."""

THROUGH = 1.25
"""One side runs through if so much of it is there beyond the opening, more than a leaf, metres."""

WIDER = 0.45
"""A corridor with a door across it is wider than the door by more than this, metres."""

FAR, ASIDE = 8.0, 1.25
"""The sides of a corridor that goes on behind an opening are looked for so far before and behind it
and so far beside its middle, metres."""

ON = 2.5
"""It goes on if so much of either side is there, before and behind the opening, metres."""

STEPS = 10
"""In so many steps a side is looked for outward from a jamb, up to `WIDER`."""

WITHIN = 0.1
"""A side may reach into the opening so far, metres; walls are rough."""

SLANT = math.tan(math.radians(20.0))
"""A side runs along the passage within this slope."""


@njit(cache=True, error_model="numpy")
def is_narrow_place(door: FloatArray, solid: FloatArray) -> bool:
    """Whether an opening across the way is no doorway, but the corridor goes on through it.

    So it is where a passage about as wide leads up to the opening and away from it: a corridor that
    narrows, between a pilaster and a wall for instance. A corridor with a door in it, or a room
    behind one, is wider than the door. Where the corridor ends in a room or a lobby, one of its
    sides runs through. A corridor both of whose sides go on behind the opening does not end
    there either, however much narrower the opening is, as between the corners of two alcoves.

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
        if _runs(here, LONG) and _runs(beyond, SHORT):
            return True
        if _runs(here, THROUGH) and _runs_through(here, beyond):
            return True
    return False


@njit(cache=True, error_model="numpy")
def _sides(door: FloatArray, solid: FloatArray) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Where sides run along the passage: before or behind the opening, right or left of it.

    Returns:
        By how far outside the jamb they are at most, in steps up to `WIDER`, then by distance from
        the opening up to `FARTHEST`, in pieces of `BIN`; and those within `ASIDE` of its middle, by
        distance up to `FAR`. Shapes (2, 2, STEPS, n) and (2, 2, m).
    """
    close = np.zeros((2, 2, STEPS, round((FARTHEST - NEAREST) / BIN)), dtype=np.bool_)
    far = np.zeros((2, 2, round((FAR - NEAREST) / BIN)), dtype=np.bool_)
    x, y = 0.5 * (door[0] + door[2]), 0.5 * (door[1] + door[3])
    dx, dy = door[2] - door[0], door[3] - door[1]
    width = math.hypot(dx, dy)
    c, s = dx / width, dy / width
    for i in range(len(solid)):
        across1 = c * (solid[i, 0] - x) + s * (solid[i, 1] - y)
        across2 = c * (solid[i, 2] - x) + s * (solid[i, 3] - y)
        along1 = c * (solid[i, 1] - y) - s * (solid[i, 0] - x)
        along2 = c * (solid[i, 3] - y) - s * (solid[i, 2] - x)
        if abs(across2 - across1) >= SLANT * abs(along2 - along1):
            continue
        side, aside = _beside(0.5 * (across1 + across2), 0.5 * width)
        if -WITHIN <= aside < ASIDE - 0.5 * width:
            _mark(along1, along2, far[0, side])
            _mark(-along1, -along2, far[1, side])
        if -WITHIN <= aside < WIDER:
            step = int(max(0.0, aside) / WIDER * STEPS)
            _mark(along1, along2, close[0, side, step])
            _mark(-along1, -along2, close[1, side, step])
    for step in range(1, STEPS):
        close[:, :, step] |= close[:, :, step - 1]
    return close, far


@njit(cache=True, error_model="numpy")
def _goes_on(far: NDArray[np.bool_]) -> bool:
    """Whether both sides of a corridor are there before and behind the opening."""
    for end in range(2):
        for side in range(2):
            if _length(far[end, side]) < ON:
                return False
    return True


@njit(cache=True, error_model="numpy")
def _beside(across: float, half: float) -> tuple[int, float]:
    """On which side of the opening something lies, and how far outside the jamb, metres."""
    return (1 if across > 0.0 else 0), abs(across) - half


@njit(cache=True, error_model="numpy")
def _mark(along1: float, along2: float, there: NDArray[np.bool_]) -> None:
    """Mark the pieces that a segment covers, if it lies at positive distances from the opening."""
    first = math.ceil((min(along1, along2) - NEAREST) / BIN - 0.5)
    last = math.floor((max(along1, along2) - NEAREST) / BIN - 0.5)
    for k in range(max(first, 0), min(last, len(there) - 1) + 1):
        there[k] = True


@njit(cache=True, error_model="numpy")
def _runs_through(here: NDArray[np.bool_], beyond: NDArray[np.bool_]) -> bool:
    """Whether one side runs on from this side of the opening to beyond it."""
    for side in range(2):
        if min(_length(here[side, -1]), _length(beyond[side, -1])) >= THROUGH:
            return True
    return False


@njit(cache=True, error_model="numpy")
def _length(pieces: NDArray[np.bool_]) -> float:
    """Of the pieces that are there, metres; a hair more, for it is compared."""
    return float(pieces.sum()) * BIN + 1e-9


@njit(cache=True, error_model="numpy")
def _runs(there: NDArray[np.bool_], length: float) -> bool:
    """Whether both sides run on for a length, together less than `WIDER` outside the jambs."""
    aside = 0.0
    for side in range(2):
        step = 0
        while step < STEPS and _length(there[side, step]) < length:
            step += 1
        aside += WIDER * step / STEPS
    return aside < WIDER - 1e-9
