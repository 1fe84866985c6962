"""Fits straight pieces to every group of points and chooses those that are walls."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from semnav_features.frames import FloatArray
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.cuts import cut
from semnav_features.kernels.layout import (
    END_BREAK,
    END_RUPTURE,
    ROUND,
    START_BREAK,
    START_RUPTURE,
)
from semnav_features.kernels.lines import fit, gather, offset, refit, split
from semnav_features.kernels.segmentation import is_return
from semnav_features.strategies import Segmentation

END_POINT_FIT = int(Segmentation.END_POINT_FIT)

TOO_FEW_BEAMS, TOO_SHORT, PART_OF_ARC = 1, 2, 3
"""Why a piece is no wall; 0 stands for no fault."""

PRIOR_POINTS = 4
"""Weight of the scanner's known `sigma` in the variance of a wall, in points."""


@kernel
def fit_pieces(groups: int, settings: Any, scratch: Any) -> int:
    """Cut every group into straight pieces of two points or more and fit their lines.

    Returns:
        How many pieces were written to `scratch.pieces`.
    """
    xs, ys, pieces, vertices = scratch.xs, scratch.ys, scratch.pieces, scratch.vertices
    near = 3.0 * settings.sigma
    count = 0
    for group in range(groups):
        first, last = scratch.group_first[group], scratch.group_first[group + 1] - 1
        if last == first:
            continue
        if settings.segmentation == END_POINT_FIT:  # the usual one; handing over scratch takes time
            cuts = split(xs, ys, first, last, settings.split_distance, scratch.stack, vertices)
        else:
            cuts = cut(xs, ys, first, last, settings, scratch)
        group_start = count
        for k in range(cuts - 1):
            # A vertex between two pieces is left out of both at first: it may lie on neither line.
            low = vertices[k] + (1 if k > 0 else 0)
            high = vertices[k + 1] - (1 if k < cuts - 2 else 0)
            if high > low:
                gather(xs, ys, low, high, pieces[count])
                fit(xs, ys, pieces[count])
                count += 1
        for k in range(group_start, count - 1):
            settle_border(xs, ys, near, pieces[k], pieces[k + 1])
        if cuts > 2 and count > group_start:
            extend(xs, ys, near, first, last, pieces[group_start], pieces[count - 1])
            for k in range(group_start, count):
                refit(xs, ys, pieces[k])
    return count


@kernel
def settle_border(xs: FloatArray, ys: FloatArray, near: float, before: Any, after: Any) -> None:
    """Move the border of two pieces until every point is with the line it is nearer to.

    The end-point fit finds a corner only to within its split distance. The points between the
    pieces, a cut or a run too short for a line, join one of them if they are `near` its line. Where
    none are left over, the border itself moves. Each piece keeps two points at least.
    """
    last: int = before.last
    first: int = after.first
    while (
        last + 1 < first
        and abs(offset(before, xs[last + 1], ys[last + 1])) <= near
        and not prefers_second(before, after, xs[last + 1], ys[last + 1])
    ):
        last += 1
    while first - 1 > last and abs(offset(after, xs[first - 1], ys[first - 1])) <= near:
        first -= 1
    if first == last + 1:
        while last > before.first + 1 and prefers_second(before, after, xs[last], ys[last]):
            last -= 1
        first = last + 1
        while first < after.last - 1 and prefers_second(after, before, xs[first], ys[first]):
            first += 1
        last = first - 1
    before.last, after.first = last, first


@kernel
def extend(xs: Any, ys: Any, near: float, first: int, last: int, head: Any, tail: Any) -> None:
    """Let a group's first and last piece take the points beyond them that are near their lines."""
    while head.first > first and abs(offset(head, xs[head.first - 1], ys[head.first - 1])) <= near:
        head.first -= 1
    while tail.last < last and abs(offset(tail, xs[tail.last + 1], ys[tail.last + 1])) <= near:
        tail.last += 1


@kernel
def prefers_second(first: Any, second: Any, x: float, y: float) -> bool:
    """Whether a point is nearer to the line of the second piece than to that of the first."""
    return bool(abs(offset(first, x, y)) > abs(offset(second, x, y)))


@kernel
def flag_pieces(groups: int, count: int, beams_per_turn: int, scratch: Any) -> None:
    """Set the flags of pieces at the ends of groups: rupture (2.1) or break (2.2).

    In a full circle of `beams_per_turn` beams, which the scan holds twice, the last beam comes
    before the first one. `beams_per_turn` is 0 for other scans.
    """
    pieces, beams, group_first = scratch.pieces, scratch.beams, scratch.group_first
    ranges, beam_count = scratch.ranges, scratch.beam_count
    range_min, limit = scratch.range_min, scratch.limit
    group = 0
    for k in range(count):
        piece = pieces[k]
        while piece.first >= group_first[group + 1]:
            group += 1
        before: int = beams[piece.first] - 1
        after: int = beams[piece.last] + 1
        before = before + beams_per_turn if before < 0 and beams_per_turn > 0 else before
        piece.flags = 0
        if piece.first == group_first[group] and before >= 0:
            seen = is_return(ranges[before], range_min, limit)
            piece.flags |= START_BREAK if seen else START_RUPTURE
        if piece.last == group_first[group + 1] - 1 and after < beam_count:
            seen = is_return(ranges[after], range_min, limit)
            piece.flags |= END_BREAK if seen else END_RUPTURE


@kernel
def point_variance(scatter: float, points: int, sigma: float) -> float:
    """Variance of a point across its line, square metres.

    The residuals say it, as real walls are rougher than the scanner and a grazing wall is
    sharper; those of a short wall alone would be a matter of luck, so `sigma` counts as
    `PRIOR_POINTS` more of them (the mean of a scaled inverse chi-square prior's posterior).
    """
    return (scatter + PRIOR_POINTS * sigma * sigma) / (points - 2 + PRIOR_POINTS)


@kernel
def wall_fault(piece: Any, settings: Any) -> int:
    """Why a piece is no wall: `TOO_FEW_BEAMS`, `TOO_SHORT` or `PART_OF_ARC`; 0 if it is one."""
    if piece.points < settings.wall_beams:
        return TOO_FEW_BEAMS
    if piece.length < settings.wall_length:
        return TOO_SHORT
    return PART_OF_ARC if piece.flags & ROUND else 0


@kernel
def select_walls(count: int, settings: Any, scratch: Any, walls: np.ndarray) -> int:
    """Write the pieces that are long and dense enough to be walls; returns how many."""
    found = 0
    for k in range(count):
        piece = scratch.pieces[k]
        length = math.hypot(piece.end_x - piece.start_x, piece.end_y - piece.start_y)
        piece.wall, piece.length = -1, length
        if found == min(len(walls), len(scratch.wall_piece)) or wall_fault(piece, settings):
            continue
        wall = walls[found]
        wall.start_x, wall.start_y = piece.start_x, piece.start_y
        wall.end_x, wall.end_y = piece.end_x, piece.end_y
        wall.residual = math.sqrt(piece.scatter / piece.points)
        wall.first, wall.last = scratch.beams[piece.first], scratch.beams[piece.last]
        wall.flags, wall.points = piece.flags, piece.points
        wall.mean_x, wall.mean_y, wall.spread = piece.mean_x, piece.mean_y, piece.spread
        wall.variance = point_variance(piece.scatter, piece.points, settings.sigma)
        piece.wall = found
        scratch.wall_piece[found] = k
        found += 1
    return found
