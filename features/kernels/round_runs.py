"""Which runs of straight pieces may be an arc: tests that need no fit, as most pieces are walls."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numba import njit

from semnav_env.features.kernels.layout import END_BREAK, END_RUPTURE, START_BREAK, START_RUPTURE
from semnav_env.features.kernels.lines import offset

SOLID = 3
"""Points from which on the direction of a piece means something."""
MOST_TURN = math.cos(math.radians(110.0))
"""Cosine of the largest turn between two pieces of one arc."""
CHORD_SAGITTA = 12.0
"""A chord c of a circle of radius R has the sagitta c^2 / (8 R), and the end-point fit leaves
pieces of at most the split distance; with half of that again for noise, c^2 / R <= 12 of it."""
UNEVEN = 1.3
"""A lone piece may be an arc if its points scatter so many times more than the noise."""
LEAST_BOW = 0.25 * 0.25 / 8.0
"""A quarter of s / 4, with s = c^2 / (8 R)."""


@njit(cache=True, error_model="numpy")
def end_of_run(first: int, count: int, settings: Any, pieces: np.ndarray) -> tuple[int, float]:
    """Last piece of the run that begins with `first`, and how far it turns: a sum of sines."""
    last, turn = first, 0.0
    for k in range(first + 1, count):
        if pieces[first].points < SOLID:
            break
        if pieces[k].points < SOLID:
            continue
        sine = turn_sine(pieces[last], pieces[k], settings)
        if sine == 0.0 or sine * turn < 0.0:
            break
        last = k
        turn += sine
    return last, turn


@njit(cache=True, error_model="numpy")
def turn_sine(a: Any, b: Any, settings: Any) -> float:
    """Sine of the turn between two pieces if both may be chords of one circle, else 0."""
    gap_x, gap_y = b.start_x - a.end_x, b.start_y - a.end_y
    sine = a.along_x * b.along_y - a.along_y * b.along_x
    cosine = a.along_x * b.along_x + a.along_y * b.along_y
    first, second = chord(a), chord(b)
    longer, mean = max(first, second), 0.5 * (first + second)
    fits = longer * longer * abs(sine) <= CHORD_SAGITTA * settings.split_distance * mean
    meets = gap_x * gap_x + gap_y * gap_y <= settings.merge_gap * settings.merge_gap
    return float(sine) if fits & meets & (cosine >= MOST_TURN) else 0.0


@njit(cache=True, error_model="numpy")
def chord(piece: Any) -> float:
    """Length of a piece, metres."""
    dx, dy = piece.end_x - piece.start_x, piece.end_y - piece.start_y
    return float(dx * piece.along_x + dy * piece.along_y)


@njit(cache=True, error_model="numpy")
def is_bowed(first: int, last: int, turn: float, settings: Any, scratch: Any) -> bool:
    """Whether the pieces of a run are bent as chords of one circle are: a test without a fit.

    The middle half of a bow of sagitta s = c^2 / (8 R) lies s / 4 off its fitted line. A quarter
    of that is asked for, with R the length of the run over its turn. A lone piece has no turn
    and is asked for its scatter.
    """
    pieces = scratch.pieces
    if first == last:
        return is_lonely(pieces[first], settings)
    runs = last - first + 1.0
    extent = turn * runs / (runs - 1.0)
    if abs(extent) < settings.arc_extent_min:
        return False
    length = expected = bow = 0.0
    for k in range(first, last + 1):
        piece, chord_length = pieces[k], chord(pieces[k])
        length += chord_length
        expected += chord_length * chord_length * (piece.points // 2)
        low = piece.first + piece.points // 4
        for i in range(low, low + piece.points // 2):
            bow -= offset(piece, scratch.xs[i], scratch.ys[i])
    if extent < 0.0:
        bow, extent = -bow, -extent
    return bool(bow >= LEAST_BOW * expected * extent / length)


@njit(cache=True, error_model="numpy")
def is_lonely(piece: Any, settings: Any) -> bool:
    """Whether a piece stands free at both ends and is uneven: perhaps a thin column."""
    uneven = (UNEVEN * settings.sigma) ** 2 * piece.points
    return bool(
        (piece.points >= settings.arc_beams)
        & (piece.scatter >= uneven)
        & (piece.flags & (START_BREAK | START_RUPTURE) != 0)
        & (piece.flags & (END_BREAK | END_RUPTURE) != 0)
    )
