"""Finds possible jambs: the places where an opening may start or end."""

from __future__ import annotations

from typing import Any

import numpy as np

from semnav_features.kernels.compiling import kernel

MAX_REVEAL_LENGTH = 0.5
"""Longest piece that may be a reveal, the side of a jamb, metres: walls are hardly thicker."""

EDGE_BEAMS = 2
"""A piece that ends within this many beams of the edge of the field of view may go on outside it,
so its end there is none: a wall that is seen past a corner looks like a reveal."""


@kernel
def find_jambs(groups: int, pieces: int, scratch: Any) -> tuple[int, int]:
    """Write where openings may start and end: the ends of pieces, and of groups beyond them.

    Groups and pieces are walked together in beam order: `k` is the first piece that does not end
    before the group. A group's first and last point are jambs of their own where no piece covers
    them, and a group without pieces is both. Where the far jamb of an opening is seen and the wall
    beside it is not, the jamb is the near end of its reveal. The pieces that come once more at the
    end of an unrolled circle are in no group, and only end openings that start before them.

    Returns:
        How many starts and how many ends were written, in beam order.
    """
    first_of, found = scratch.group_first, scratch.pieces
    most = len(scratch.start_jambs)
    starts = ends = k = 0
    for group in range(groups):
        first, last = first_of[group], first_of[group + 1] - 1
        while k < pieces and found[k].last < first:
            k += 1
        if (k == pieces or found[k].first > first) and ends < most:
            write_point(scratch.end_jambs[ends], first, k, scratch)
            ends += 1
        while k < pieces and found[k].first <= last:
            piece = found[k]
            if piece.first >= first and ends < most:
                jamb = scratch.end_jambs[ends]
                write_jamb(jamb, piece.start_x, piece.start_y, scratch.beams[piece.first], k)
                ends += 1
            if starts < most and piece.last == last and is_start_reveal(found, k, scratch):
                jamb = scratch.start_jambs[starts]
                write_jamb(jamb, piece.start_x, piece.start_y, scratch.beams[piece.first], k - 1)
                jamb.is_reveal = True
                starts += 1
            if piece.last > last:
                break
            if ends < most and piece.first == first and is_end_reveal(found[:pieces], k, scratch):
                jamb = scratch.end_jambs[ends]
                write_jamb(jamb, piece.end_x, piece.end_y, scratch.beams[piece.last], k + 1)
                jamb.is_reveal = True
                ends += 1
            if starts < most:
                jamb = scratch.start_jambs[starts]
                write_jamb(jamb, piece.end_x, piece.end_y, scratch.beams[piece.last], k)
                starts += 1
            k += 1
        loose = (k == pieces or found[k].first > last) and (k == 0 or found[k - 1].last < last)
        if loose and starts < most:
            write_point(scratch.start_jambs[starts], last, k - 1, scratch)
            starts += 1
    while k < pieces and ends < most:
        piece = found[k]
        jamb = scratch.end_jambs[ends]
        write_jamb(jamb, piece.start_x, piece.start_y, scratch.beams[piece.first], k)
        ends += 1
        k += 1
    return starts, ends


@kernel
def is_start_reveal(pieces: np.ndarray, k: int, scratch: Any) -> bool:
    """Whether the last piece of a group may be the reveal of the jamb where an opening starts.

    It recedes from the scanner in beam order, and no piece meets it at its near end: too few beams
    hit the wall there, for they graze it.
    """
    piece = pieces[k]
    is_free = k == 0 or pieces[k - 1].last < piece.first
    is_free &= scratch.beams_per_turn > 0 or scratch.beams[piece.first] >= EDGE_BEAMS
    return bool(is_free and piece.length <= MAX_REVEAL_LENGTH and recession(piece) > 0.0)


@kernel
def is_end_reveal(pieces: np.ndarray, k: int, scratch: Any) -> bool:
    """The mirror image of `is_start_reveal`, for the first piece of a group."""
    piece = pieces[k]
    is_free = k + 1 == len(pieces) or pieces[k + 1].first > piece.last
    last = scratch.beam_count - 1 - EDGE_BEAMS
    is_free &= scratch.beams_per_turn > 0 or scratch.beams[piece.last] <= last
    return bool(is_free and piece.length <= MAX_REVEAL_LENGTH and recession(piece) < 0.0)


@kernel
def recession(piece: Any) -> float:
    """Squared distance of a piece's end from the scanner less that of its start, square metres."""
    start = piece.start_x * piece.start_x + piece.start_y * piece.start_y
    return float(piece.end_x * piece.end_x + piece.end_y * piece.end_y - start)


@kernel
def write_point(jamb: Any, point: int, piece: int, scratch: Any) -> None:
    """A jamb at a single point; `piece` is the next one on the side away from the opening."""
    write_jamb(jamb, scratch.xs[point], scratch.ys[point], scratch.beams[point], piece)


@kernel
def write_jamb(jamb: Any, x: float, y: float, beam: int, piece: int) -> None:
    """Set every field of a jamb; it is not that of a reveal."""
    jamb.x, jamb.y, jamb.beam, jamb.piece, jamb.is_reveal = x, y, beam, piece, False
