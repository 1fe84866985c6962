"""How remembered walls are laid out, and room for a new entry among remembered walls or doors."""

from __future__ import annotations

from typing import Any, TypeAlias

from numba.cpython.unsafe.numbers import trailing_zeros

from semnav_features.frames import FloatArray
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.lanes import load

Ends: TypeAlias = tuple[float, float, float, float]
"""Start and end of a wall or door: x1, y1, x2, y2 in metres."""

START_X, START_Y, END_X, END_Y, HITS, VARIANCE = range(6)
"""Rows of the array of remembered walls, shape (6, room), float64: their ends in metres, how often
each was seen, and the mean square distance of its sightings from it, m^2. A wall is a column, so
that eight walls can be compared at once: the room is a multiple of eight."""

WALL_ROWS = VARIANCE + 1

lowest_bit: Any = trailing_zeros
"""Place of the lowest bit that is set in a number which is not 0; only kernels can call it."""


@kernel
def ends_of_wall(walls: FloatArray, k: int) -> Ends:
    """The ends of remembered wall `k`."""
    return walls[START_X, k], walls[START_Y, k], walls[END_X, k], walls[END_Y, k]


@kernel
def ends_of_walls(walls: FloatArray, start: int) -> Any:
    """The ends of the eight remembered walls from `start` on, each of the four as lanes."""
    return (
        load(walls[START_X], start),
        load(walls[START_Y], start),
        load(walls[END_X], start),
        load(walls[END_Y], start),
    )


@kernel
def write_ends(walls: FloatArray, k: int, ends: Ends) -> None:
    """Write the ends of remembered wall `k`."""
    walls[START_X, k], walls[START_Y, k], walls[END_X, k], walls[END_Y, k] = ends


@kernel
def place_for_new(hits: Any, used: int) -> tuple[int, int]:
    """Place of a new entry, and how many are used then; a full memory replaces the rarest one.

    `hits` says how often each entry was seen, shape (room,).
    """
    if used < len(hits):
        return used, used + 1
    place = 0
    for k in range(used):
        if hits[k] < hits[place]:
            place = k
    return place, used
