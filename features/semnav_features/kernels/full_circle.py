"""Unrolls a scan of a full circle from a place (the seam) where no wall is cut."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from semnav_features.frames import FloatArray
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.layout import END_BREAK, END_RUPTURE, START_BREAK, START_RUPTURE
from semnav_features.kernels.segmentation import is_return

MIN_CIRCLE_BEAMS = 8
"""A scan of fewer beams per turn is not taken for a full circle."""


@kernel
def count_beams_per_turn(beams: int, increment: float, dropout_beams: int) -> int:
    """Number of beams in a full turn if the scan covers one, else 0.

    A scan that repeats its first direction covers it, and so does one whose ends are no farther
    apart than a gap of missing returns that does not end a wall.
    """
    beams_per_turn = 2.0 * math.pi / increment
    if beams_per_turn > beams + dropout_beams + 0.5 or beams_per_turn < MIN_CIRCLE_BEAMS:
        return 0
    return int(beams_per_turn + 0.5)


@kernel
def find_seam(pieces: int, scratch: Any) -> tuple[int, bool]:
    """Where to unroll the circle, given the pieces of the scan as it came.

    Returns:
        The first beam of a piece, and whether the wall is broken before it: at a break if there
        is one, else at a corner far from where the scan began.
    """
    for k in range(1, pieces):
        if scratch.pieces[k].flags & (START_BREAK | START_RUPTURE):
            return scratch.beams[scratch.pieces[k].first], True
    if pieces > 1:
        return scratch.beams[scratch.pieces[pieces // 2].first], False
    return 0, True


@kernel
def unroll(ranges: FloatArray, directions: FloatArray, seam: int, scratch: Any) -> None:
    """Write the circle to `scratch`, twice over, from the beam at the seam on.

    Missing beams have no return. If the last beam repeats the first direction it stands in for a
    first beam without return.
    """
    increment, beams_per_turn = scratch.increment, scratch.beams_per_turn
    given = min(len(ranges), beams_per_turn)
    for i in range(beams_per_turn):
        beam = seam + i if seam + i < beams_per_turn else seam + i - beams_per_turn
        distance, x, y = math.nan, directions[given - 1, 0], directions[given - 1, 1]
        if beam < given:
            distance, x, y = ranges[beam], directions[beam, 0], directions[beam, 1]
        else:
            c, s = (
                math.cos((beam - given + 1) * increment),
                math.sin((beam - given + 1) * increment),
            )
            x, y = c * x - s * y, s * x + c * y
        is_seen = is_return(distance, scratch.range_min, scratch.limit)
        if beam == 0 and len(ranges) > beams_per_turn and not is_seen:
            distance = ranges[beams_per_turn]
        for k in (i, i + beams_per_turn):
            scratch.ranges[k] = distance
            scratch.directions[k, 0], scratch.directions[k, 1] = x, y
    scratch.beam_count, scratch.known_directions = 2 * beams_per_turn, 0


@kernel
def close_seam(pieces: int, scratch: Any) -> None:
    """Take back the flags of a break where the circle was cut at a corner."""
    if pieces > 0:
        scratch.pieces[0].flags &= ~(START_BREAK | START_RUPTURE)
        scratch.pieces[pieces - 1].flags &= ~(END_BREAK | END_RUPTURE)


@kernel
def repeat_pieces(pieces: int, points: int, scratch: Any) -> int:
    """Append the pieces of the first half turn once more, a full turn later.

    So a gap that begins before the seam and ends behind it is found like any other.

    Returns:
        How many pieces there are with them.
    """
    xs, ys, beams = scratch.xs, scratch.ys, scratch.beams
    beams_per_turn = scratch.beams_per_turn
    count = pieces
    for k in range(pieces):
        if 2 * beams[scratch.pieces[k].first] >= beams_per_turn:
            break
        piece = scratch.pieces[count]
        scratch.pieces[count] = scratch.pieces[k]
        for i in range(piece.first, piece.last + 1):
            xs[points + i], ys[points + i] = xs[i], ys[i]
            beams[points + i] = beams[i] + beams_per_turn
        piece.first, piece.last = piece.first + points, piece.last + points
        count += 1
    return count


@kernel
def renumber_beams(items: np.ndarray, count: int, beams_per_turn: int, seam: int) -> None:
    """Number `first` and `last` beam of walls or arcs as the scan does."""
    for k in range(count):
        items[k].first = (items[k].first + seam) % beams_per_turn
        items[k].last = (items[k].last + seam) % beams_per_turn
