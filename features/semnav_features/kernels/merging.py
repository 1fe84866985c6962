"""Joins straight pieces that lie on one line, but never across a gap that a robot could pass."""

from __future__ import annotations

import math
from typing import Any

from semnav_features.frames import FloatArray
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.layout import END_BREAK, END_RUPTURE
from semnav_features.kernels.lines import absorb, fit, offset

MERGE_CHI_SQUARE = 13.8
"""Quantile 0.999 of chi-square with two degrees of freedom: what joining two fits of one line
may add to the squared residuals, in variances of a point."""


@kernel
def joint_scatter(a: Any, b: Any) -> float:
    """Squared residuals of the one line fitted to the points of two pieces."""
    weight = a.points * b.points / (a.points + b.points)
    dx, dy = b.mean_x - a.mean_x, b.mean_y - a.mean_y
    xx = a.xx + b.xx + weight * dx * dx
    xy = a.xy + b.xy + weight * dx * dy
    yy = a.yy + b.yy + weight * dy * dy
    return float(0.5 * (xx + yy - math.sqrt((xx - yy) ** 2 + 4.0 * xy * xy)))


@kernel
def merge_cost(a: Any, b: Any, settings: Any) -> float:
    """What joining two successive pieces adds to the squared residuals.

    Infinite if they are not one line, or if a robot could pass the gap between them.
    """
    gap = (b.start_x - a.end_x) ** 2 + (b.start_y - a.end_y) ** 2
    if gap > settings.merge_gap**2:
        return math.inf
    allowed = MERGE_CHI_SQUARE * settings.sigma**2
    allowed += min(a.points, b.points) * settings.merge_offset**2
    cost = joint_scatter(a, b) - a.scatter - b.scatter
    return float(cost) if cost <= allowed else math.inf


@kernel
def merge_pieces(count: int, settings: Any, scratch: Any) -> int:
    """Join successive pieces that are one line until none are left; returns how many remain."""
    before = count + 1
    while count < before:
        before = count
        count = merge_neighbours(count, settings, scratch)
        count = merge_across_spikes(count, settings, scratch)
    return count


@kernel
def merge_neighbours(count: int, settings: Any, scratch: Any) -> int:
    """Join successive pieces that are one line; returns how many remain.

    A piece that fits both its neighbours joins the one that it fits better.
    """
    pieces = scratch.pieces
    kept = 0
    for k in range(1, count):
        current, following = pieces[kept], pieces[k]
        cost = merge_cost(current, following, settings)
        joins = cost < math.inf
        if joins and k + 1 < count:
            joins = cost <= merge_cost(following, pieces[k + 1], settings)
        if joins:
            join(current, following)
            fit(scratch.xs, scratch.ys, current)
        else:
            kept += 1
            if kept < k:
                pieces[kept] = following
    return min(kept + 1, count)


@kernel
def merge_across_spikes(count: int, settings: Any, scratch: Any) -> int:
    """Join two pieces that are one line with the few noisy points between them.

    The end-point fit cuts a wall at a single bad point, and the cut leaves a short steep piece
    that fits neither side. Returns how many pieces remain.
    """
    xs, ys, pieces = scratch.xs, scratch.ys, scratch.pieces
    kept, k = 0, 1
    while k < count:
        current = pieces[kept]
        if k + 1 < count and is_spike(xs, ys, current, pieces[k], pieces[k + 1], settings):
            join(current, pieces[k])
            join(current, pieces[k + 1])
            fit(xs, ys, current)
            k += 2
        else:
            kept += 1
            if kept < k:
                pieces[kept] = pieces[k]
            k += 1
    return min(kept + 1, count)


@kernel
def is_spike(
    xs: FloatArray, ys: FloatArray, before: Any, piece: Any, after: Any, settings: Any
) -> bool:
    """Whether a piece is too small for a wall, and noise on the one line of its neighbours."""
    if piece.points >= settings.wall_beams or merge_cost(before, after, settings) == math.inf:
        return False
    line = before if before.points >= after.points else after
    farthest = settings.split_distance + settings.sigma
    for i in range(piece.first, piece.last + 1):
        if abs(offset(line, xs[i], ys[i])) > farthest:
            return False
    return True


@kernel
def join(piece: Any, following: Any) -> None:
    """Add the points of the following piece; the line must be fitted anew."""
    ends = END_BREAK | END_RUPTURE
    piece.flags = (piece.flags & ~ends) | (following.flags & ends)
    absorb(piece, following)
