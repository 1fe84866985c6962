"""Tells which runs of straight pieces may be an arc, by tests without a fit: most are walls."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from semnav_features.frames import FloatArray
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.layout import END_BREAK, END_RUPTURE, START_BREAK, START_RUPTURE
from semnav_features.kernels.lines import offset

MIN_DIRECTED_POINTS = 3
"""Points from which on the direction of a piece means something."""

MIN_TURN_COSINE = math.cos(math.radians(110.0))
"""Cosine of the largest heading change between two pieces of one arc."""

CHORD_SAGITTA_LIMIT = 12.0
"""Largest c^2 / R of a chord c of a circle of radius R, in split distances.

The chord has the sagitta c^2 / (8 R), and the end-point fit leaves pieces with a sagitta of at most
the split distance: 8, and half of that again for noise."""

MIN_COLUMN_SCATTER = 1.3
"""Least scatter of a lone piece that may be an arc, in standard deviations of the noise."""

MIN_BOW = 0.25 * 0.25 / 8.0
"""Least mean distance of a bow's middle half from its fitted line, as a factor of c^2 / R: a
quarter of the expected s / 4 with s = c^2 / (8 R)."""


@kernel
def end_of_run(first: int, count: int, settings: Any, pieces: np.ndarray) -> tuple[int, float]:
    """Last piece of the run that begins with `first`, and its heading change as a sum of sines.

    Pieces of too few points have no direction and are passed over. The run ends where the heading
    changes the other way, or by more than chords of one circle do.
    """
    last, heading_change = first, 0.0
    for k in range(first + 1, count):
        if pieces[first].points < MIN_DIRECTED_POINTS:
            break
        if pieces[k].points < MIN_DIRECTED_POINTS:
            continue
        sine = turn_sine(pieces[last], pieces[k], settings)
        if sine == 0.0 or sine * heading_change < 0.0:
            break
        last = k
        heading_change += sine
    return last, heading_change


@kernel
def turn_sine(a: Any, b: Any, settings: Any) -> float:
    """Sine of the heading change between two pieces that may be chords of one circle, else 0.

    Chords of mean length c of a circle of radius R follow each other at the angle c / R, which
    bounds c^2 / R by `CHORD_SAGITTA_LIMIT`.
    """
    gap_x, gap_y = b.start_x - a.end_x, b.start_y - a.end_y
    sine = a.along_x * b.along_y - a.along_y * b.along_x
    cosine = a.along_x * b.along_x + a.along_y * b.along_y
    first, second = chord(a), chord(b)
    longer, mean = max(first, second), 0.5 * (first + second)
    fits = longer * longer * abs(sine) <= CHORD_SAGITTA_LIMIT * settings.split_distance * mean
    meets = gap_x * gap_x + gap_y * gap_y <= settings.merge_gap * settings.merge_gap
    return float(sine) if fits & meets & (cosine >= MIN_TURN_COSINE) else 0.0


@kernel
def chord(piece: Any) -> float:
    """Length of a piece, metres."""
    dx, dy = piece.end_x - piece.start_x, piece.end_y - piece.start_y
    return float(dx * piece.along_x + dy * piece.along_y)


@kernel
def is_bent_like_arc(
    first: int,
    last: int,
    heading_change: float,
    settings: Any,
    xs: FloatArray,
    ys: FloatArray,
    pieces: np.ndarray,
) -> bool:
    """Whether the points of a run lie off its pieces as those of bows lie off their chords.

    The middle half of a bow of sagitta s = c^2 / (8 R) lies s / 4 off its fitted line. A quarter
    of that is required, where R is the length of the run over its heading change. A lone piece has
    no heading change; its scatter decides.
    """
    if first == last:
        return may_be_column(pieces[first], settings)
    runs = last - first + 1.0
    extent = heading_change * runs / (runs - 1.0)
    if abs(extent) < settings.arc_extent_min:
        return False
    length = expected = bow = 0.0
    for k in range(first, last + 1):
        piece, chord_length = pieces[k], chord(pieces[k])
        length += chord_length
        expected += chord_length * chord_length * (piece.points // 2)
        low = piece.first + piece.points // 4
        for i in range(low, low + piece.points // 2):
            bow -= offset(piece, xs[i], ys[i])
    if extent < 0.0:
        bow, extent = -bow, -extent
    return bool(bow >= MIN_BOW * expected * extent / length)


@kernel
def may_be_column(piece: Any, settings: Any) -> bool:
    """Whether a piece stands free at both ends and is uneven: perhaps a thin column."""
    uneven = (MIN_COLUMN_SCATTER * settings.sigma) ** 2 * piece.points
    return bool(
        (piece.points >= settings.arc_beams)
        & (piece.scatter >= uneven)
        & (piece.flags & (START_BREAK | START_RUPTURE) != 0)
        & (piece.flags & (END_BREAK | END_RUPTURE) != 0)
    )
