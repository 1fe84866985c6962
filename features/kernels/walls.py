"""Walls: straight pieces fitted to every group, joined where they are one line."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numba import njit

from semnav_env.features.frames import FloatArray
from semnav_env.features.kernels.layout import END_BREAK, END_RUPTURE, START_BREAK, START_RUPTURE
from semnav_env.features.kernels.lines import absorb, fit, gather, offset, split
from semnav_env.features.kernels.segmentation import is_return

MERGE_CHI_SQUARE = 13.8
"""Quantile 0.999 of chi-square with two degrees of freedom: what joining two fits of one line
may add to the squared residuals, in variances of a point."""


@njit(cache=True, error_model="numpy")
def fit_pieces(groups: int, settings: Any, scratch: Any) -> int:
    """Cut every group into straight pieces of two points or more and fit their lines.

    Returns:
        How many pieces were written to `scratch.pieces`.
    """
    xs, ys, pieces, vertices = scratch.xs, scratch.ys, scratch.pieces, scratch.vertices
    count = 0
    for group in range(groups):
        first, last = scratch.group_first[group], scratch.group_first[group + 1] - 1
        if last == first:
            continue
        cuts = split(xs, ys, first, last, settings.split_distance, scratch)
        group_start = count
        for k in range(cuts - 1):
            low = vertices[k] + (1 if k > 0 else 0)
            high = vertices[k + 1] - (1 if k < cuts - 2 else 0)
            if high > low:
                gather(xs, ys, low, high, pieces[count])
                fit(xs, ys, pieces[count])
                count += 1
        for k in range(group_start, count - 1):
            settle_border(xs, ys, pieces[k], pieces[k + 1])
        if count > group_start + 1:
            for k in range(group_start, count):
                gather(xs, ys, pieces[k].first, pieces[k].last, pieces[k])
                fit(xs, ys, pieces[k])
    return count


@njit(cache=True, error_model="numpy")
def settle_border(xs: FloatArray, ys: FloatArray, before: Any, after: Any) -> None:
    """Move the border of two pieces until every point is with the line it is nearer to.

    The end-point fit finds a corner only to within its split distance. The point at the cut is
    in neither piece yet.
    """
    if after.first != before.last + 2:
        return
    last, cut, first = before.last, before.last + 1, after.first
    if not prefers_second(before, after, xs[cut], ys[cut]):
        last = cut
        while first < after.last - 1 and not prefers_second(before, after, xs[first], ys[first]):
            last = first
            first += 1
    else:
        first = cut
        while last > before.first + 1 and prefers_second(before, after, xs[last], ys[last]):
            first = last
            last -= 1
    before.last, after.first = last, first


@njit(cache=True, error_model="numpy")
def prefers_second(first: Any, second: Any, x: float, y: float) -> bool:
    """Whether a point is nearer to the line of the second piece than to that of the first."""
    return bool(abs(offset(first, x, y)) > abs(offset(second, x, y)))


@njit(cache=True, error_model="numpy")
def flag_pieces(
    ranges: FloatArray, range_min: float, limit: float, groups: int, count: int, scratch: Any
) -> None:
    """Set the flags of pieces at the ends of groups: rupture (2.1) or break (2.2)."""
    pieces, beams, group_first = scratch.pieces, scratch.beams, scratch.group_first
    group = 0
    for k in range(count):
        piece = pieces[k]
        while piece.first >= group_first[group + 1]:
            group += 1
        before, after = beams[piece.first] - 1, beams[piece.last] + 1
        piece.flags = 0
        if piece.first == group_first[group] and before >= 0:
            seen = is_return(ranges[before], range_min, limit)
            piece.flags |= START_BREAK if seen else START_RUPTURE
        if piece.last == group_first[group + 1] - 1 and after < len(ranges):
            seen = is_return(ranges[after], range_min, limit)
            piece.flags |= END_BREAK if seen else END_RUPTURE


@njit(cache=True, error_model="numpy")
def joint_scatter(a: Any, b: Any) -> float:
    """Squared residuals of the one line fitted to the points of two pieces."""
    weight = a.points * b.points / (a.points + b.points)
    dx, dy = b.mean_x - a.mean_x, b.mean_y - a.mean_y
    xx = a.xx + b.xx + weight * dx * dx
    xy = a.xy + b.xy + weight * dx * dy
    yy = a.yy + b.yy + weight * dy * dy
    return float(0.5 * (xx + yy - math.sqrt((xx - yy) ** 2 + 4.0 * xy * xy)))


@njit(cache=True, error_model="numpy")
def is_one_line(a: Any, b: Any, settings: Any) -> bool:
    """Whether two successive pieces are one line with no gap between that one could pass."""
    gap = (b.start_x - a.end_x) ** 2 + (b.start_y - a.end_y) ** 2
    if gap > settings.merge_gap**2:
        return False
    allowed = MERGE_CHI_SQUARE * settings.sigma**2
    allowed += min(a.points, b.points) * settings.merge_offset**2
    return bool(joint_scatter(a, b) - a.scatter - b.scatter <= allowed)


@njit(cache=True, error_model="numpy")
def merge_pieces(count: int, settings: Any, scratch: Any) -> int:
    """Join successive pieces that are one line; returns how many remain."""
    pieces = scratch.pieces
    if count == 0:
        return 0
    kept = 0
    for k in range(1, count):
        current, following = pieces[kept], pieces[k]
        if is_one_line(current, following, settings):
            ends = END_BREAK | END_RUPTURE
            current.flags = (current.flags & ~ends) | (following.flags & ends)
            absorb(current, following)
            fit(scratch.xs, scratch.ys, current)
        else:
            kept += 1
            pieces[kept] = following
    return kept + 1


@njit(cache=True, error_model="numpy")
def select_walls(count: int, settings: Any, scratch: Any, walls: np.ndarray) -> int:
    """Write the pieces that are long and dense enough to be walls; returns how many."""
    found = 0
    for k in range(count):
        piece = scratch.pieces[k]
        length = math.hypot(piece.end_x - piece.start_x, piece.end_y - piece.start_y)
        piece.wall, piece.length = -1, length
        if (
            found == min(len(walls), len(scratch.wall_piece))
            or piece.points < settings.wall_beams
            or length < settings.wall_length
        ):
            continue
        wall = walls[found]
        wall.start_x, wall.start_y = piece.start_x, piece.start_y
        wall.end_x, wall.end_y = piece.end_x, piece.end_y
        wall.residual = math.sqrt(piece.scatter / piece.points)
        wall.first, wall.last = scratch.beams[piece.first], scratch.beams[piece.last]
        wall.flags, wall.points = piece.flags, piece.points
        piece.wall = found
        scratch.wall_piece[found] = k
        found += 1
    return found
