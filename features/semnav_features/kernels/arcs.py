"""Finds arcs (columns and curved walls) where straight pieces bend step by step (Yan et al.)."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from semnav_features.kernels.arc_candidates import end_of_run, is_bent_like_arc, may_be_column
from semnav_features.kernels.arc_criterion import is_arc, straight_scatter
from semnav_features.kernels.circles import (
    NO_RAY,
    Ray,
    algebraic_circle,
    circle_residuals,
    refine_circle,
)
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.layout import ROUND

MAX_CIRCLE_DEVIATIONS = 3.0
"""Largest distance of a point from a circle that it may belong to, in standard deviations."""

EDGE_DEVIATION = 0.25
"""Standard deviation of where a beam ends at an edge, on top of its spacing, in sigma."""


@kernel
def find_arcs(groups: int, pieces: int, settings: Any, scratch: Any, arcs: np.ndarray) -> int:
    """Write the arcs among the pieces and flag these pieces `ROUND`; returns how many.

    A run of pieces that bend the same way, no more than chords of one circle would, is tried as
    one arc and otherwise split where it fits worst (Yan et al., section 2).
    """
    found = first = 0
    xs, ys, straight = scratch.xs, scratch.ys, scratch.pieces
    while settings.arcs and first < pieces:
        if straight[first].flags & ROUND:
            first += 1
            continue
        last, heading_change = end_of_run(first, pieces, settings, straight)
        before = found
        if is_bent_like_arc(first, last, heading_change, settings, xs, ys, straight):
            run = (first, last)
            found = explain_run(run, (groups, pieces), settings, scratch, arcs, found)
        starts_another = last > first and found == before
        first = last if starts_another else last + 1
    return found


@kernel
def explain_run(
    run: tuple[int, int],
    counts: tuple[int, int],
    settings: Any,
    scratch: Any,
    arcs: np.ndarray,
    found: int,
) -> int:
    """Find the arcs in a run of pieces; returns how many arcs there are now.

    The stack holds the last pieces of the parts that are still to be tried, the nearest on top;
    `start` is the first piece that is not explained yet. A part that is no arc is cut in two.

    Args:
        run: its first and its last piece.
        counts: of groups and of pieces.
        settings: of the extractor.
        scratch: with the pieces.
        arcs: written from entry `found` on.
        found: how many arcs there are already.
    """
    stack = scratch.stack
    start, stack[0] = run
    height = 1
    while height > 0 and found < len(arcs):
        end = stack[height - 1]
        if start > end or scratch.pieces[start].flags & ROUND:
            height -= start > end
            start += start <= end
            continue
        worst = 0
        if end > start or may_be_column(scratch.pieces[start], settings):
            worst = try_arc((start, end), counts, settings, scratch, arcs[found])
        if worst >= 0 and end > start:
            stack[height] = piece_before_cut(start, end, worst, scratch.pieces)
            height += 1
            continue
        found += worst < 0
        height -= 1
        start = end + 1
    return found


@kernel
def piece_before_cut(start: int, end: int, worst: int, pieces: np.ndarray) -> int:
    """The piece with the worst point, after which a run is cut; never the last of the run."""
    cut = start
    while cut + 1 < end and pieces[cut + 1].first <= worst:
        cut += 1
    return cut


@kernel
def try_arc(
    run: tuple[int, int], counts: tuple[int, int], settings: Any, scratch: Any, arc: Any
) -> int:
    """Fit one arc to a run of pieces and write it if it explains them better; as `explain_run`.

    Returns:
        -1 if it does, else the point that is farthest from the circle.
    """
    xs, ys, pieces = scratch.xs, scratch.ys, scratch.pieces
    start, end = run
    first, last = pieces[start].first, pieces[end].last
    circle = algebraic_circle(xs, ys, first, last)
    start, first = grow_run(circle, start, first, -1, counts, settings, scratch)
    end, last = grow_run(circle, end, last, 1, counts, settings, scratch)
    before = after = NO_RAY
    if is_convex_at(circle, xs[(first + last) // 2], ys[(first + last) // 2]):
        before = edge_ray(first, -1, counts[0], settings, scratch)
        after = edge_ray(last, 1, counts[0], settings, scratch)
    circle = refine_circle(xs, ys, first, last, circle, before, after)
    scatter, worst = circle_residuals(xs, ys, first, last, circle)
    straight = straight_scatter(start, end, first, last, scratch)
    write_arc(circle, first, last, scatter, scratch, arc)
    if not is_arc(arc, straight, end - start + 1, settings):
        return worst
    for k in range(start, end + 1):
        pieces[k].flags |= ROUND
    return -1


@kernel
def is_convex_at(circle: tuple[float, float, float], x: float, y: float) -> bool:
    """Whether a circle bulges towards the scanner at its point (x, y)."""
    return (circle[0] - x) * x + (circle[1] - y) * y > 0.0


@kernel
def grow_run(
    circle: tuple[float, float, float],
    piece: int,
    point: int,
    step: int,
    counts: tuple[int, int],
    settings: Any,
    scratch: Any,
) -> tuple[int, int]:
    """Add points beside a run, backwards (step -1) or onwards (1), while they lie on the circle.

    It stays in the group of the run, and takes the points of another piece only all together, since
    a curved wall may end in a straight one. One bad point does not end it, two in a row do.

    Returns:
        The outermost piece and the outermost point.
    """
    groups, count = counts
    pieces, bounds = scratch.pieces, scratch.group_first[: groups + 1]
    group = np.searchsorted(bounds, point, side="right")
    border = bounds[group - 1] if step < 0 else bounds[group] - 1
    taken, reached, i, was_on = piece, point, point, True
    while i != border:
        i += step
        on = is_on_circle(circle, scratch.xs[i], scratch.ys[i], settings)
        if not on and not was_on:
            break
        was_on = on
        beside = taken + step
        if 0 <= beside < count and pieces[beside].first <= i <= pieces[beside].last:
            if i != (pieces[beside].first if step < 0 else pieces[beside].last):
                continue
            if pieces[beside].flags & ROUND:
                break
            taken = beside
        if on:
            reached = i
    return taken, reached


@kernel
def is_on_circle(circle: tuple[float, float, float], x: float, y: float, settings: Any) -> bool:
    """Whether a point is as near to a circle as noise lets its points be."""
    distance = math.hypot(x - circle[0], y - circle[1]) - circle[2]
    return bool(abs(distance) <= MAX_CIRCLE_DEVIATIONS * settings.sigma)


@kernel
def edge_ray(point: int, step: int, groups: int, settings: Any, scratch: Any) -> Ray:
    """The ray that touches a column beside its first (step -1) or last point (step 1).

    The beam at that point meets the column and the next one passes it, so the tangent ray lies
    between them: for thin columns that tells the radius better than the ranges do.
    `NO_RAY` where the next beam is missing, or ends before the column or on something connected.
    """
    xs, ys, beams, directions = scratch.xs, scratch.ys, scratch.beams, scratch.directions
    beam, following = beams[point] + step, point + step
    bounds = scratch.group_first[: groups + 1]
    if beam < 0 or beam >= scratch.beam_count:
        return NO_RAY
    square = xs[point] ** 2 + ys[point] ** 2
    if 0 <= following < bounds[groups]:
        border = point if step < 0 else following
        connected = bounds[np.searchsorted(bounds, border)] != border
        nearer = xs[following] ** 2 + ys[following] ** 2 < square
        if connected or (beams[following] == beam and nearer):
            return NO_RAY
    x = directions[beams[point], 0] + directions[beam, 0]
    y = directions[beams[point], 1] + directions[beam, 1]
    size = math.hypot(x, y)
    # |d1 - d2| of unit vectors is the angle between them, well enough for neighbouring beams
    gap_x = directions[beams[point], 0] - directions[beam, 0]
    gap_y = directions[beams[point], 1] - directions[beam, 1]
    noise = settings.sigma * settings.sigma
    variance = (
        square * (gap_x * gap_x + gap_y * gap_y) / 12.0 + EDGE_DEVIATION * EDGE_DEVIATION * noise
    )
    return step * y / size, -step * x / size, noise / variance


@kernel
def write_arc(
    circle: tuple[float, float, float],
    first: int,
    last: int,
    scatter: float,
    scratch: Any,
    arc: Any,
) -> None:
    """Set every field of an arc; its ends are those of its points, moved onto the circle."""
    xs, ys, beams = scratch.xs, scratch.ys, scratch.beams
    x, y, radius = circle
    arc.centre_x, arc.centre_y, arc.radius = x, y, radius
    start = radius / math.hypot(xs[first] - x, ys[first] - y)
    end = radius / math.hypot(xs[last] - x, ys[last] - y)
    arc.start_x, arc.start_y = x + start * (xs[first] - x), y + start * (ys[first] - y)
    arc.end_x, arc.end_y = x + end * (xs[last] - x), y + end * (ys[last] - y)
    middle = (first + last) // 2
    arc.convex = is_convex_at(circle, xs[middle], ys[middle])
    arc.points = last - first + 1
    arc.residual = math.sqrt(scatter / arc.points)
    arc.first, arc.last = beams[first], beams[last]
