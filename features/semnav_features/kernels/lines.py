"""Fits straight pieces to a group of points: iterative end-point fit, total least squares."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from semnav_features.frames import FloatArray
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.lanes import (
    WIDTH,
    Lanes,
    first_lanes,
    larger,
    largest,
    load,
    select,
    spread,
)


@kernel
def split(
    xs: FloatArray,
    ys: FloatArray,
    first: int,
    last: int,
    limit: float,
    stack: NDArray[np.int64],
    vertices: NDArray[np.int64],
) -> int:
    """Iterative end-point fit (Barbret section 2.4.4), with a stack instead of recursion.

    Points first to last are cut at the point farthest from the chord until none is farther
    than `limit`.

    Returns:
        How many indices were written to `vertices`: first, every cut, last.
    """
    stack[0] = last
    return int(split_further(xs, ys, first, 1, limit, stack, vertices))


@kernel
def split_further(
    xs: FloatArray,
    ys: FloatArray,
    first: int,
    height: int,
    limit: float,
    stack: NDArray[np.int64],
    vertices: NDArray[np.int64],
) -> int:
    """Split further what has been cut already at the `height` points on the stack.

    The stack holds the cuts that are still ahead, the nearest on top and the last point lowest;
    `start` is the last vertex that is settled. Each round either cuts the stretch from `start` to
    the top of the stack once more, or settles it.
    """
    vertices[0] = start = first
    count = 1
    while height > 0:
        end = stack[height - 1]
        cut = farthest(xs, ys, start, end, limit)
        if cut > 0:
            stack[height] = cut
            height += 1
        else:
            height -= 1
            vertices[count] = start = end
            count += 1
    return count


@kernel
def farthest(xs: FloatArray, ys: FloatArray, first: int, last: int, limit: float) -> int:
    """The inner point farthest from the chord (Barbret (1.4)), or -1 if all are within limit.

    The arrays must go on for `WIDTH` numbers after the last point; these may be anything.
    """
    dx, dy = xs[last] - xs[first], ys[last] - ys[first]
    chord = dx, dy, dx * ys[first] - dy * xs[first]
    most = spread(0.0)
    for i in range(first + 1, last, WIDTH):
        most = larger(off_chord(xs, ys, i, last, chord), most)
    # Distances are compared before they are divided by the length of the chord, the same for all.
    best, found = largest(most), first + 1
    if not best > limit * math.sqrt(dx * dx + dy * dy):
        return -1
    while largest(off_chord(xs, ys, found, last, chord)) != best:
        found += WIDTH
    while abs(dx * ys[found] - dy * xs[found] - chord[2]) != best:
        found += 1
    return found


@kernel
def off_chord(xs: FloatArray, ys: FloatArray, first: int, last: int, chord: Any) -> Lanes:
    """Distances of eight points from a chord, times its length; 0 from point `last` on.

    Args:
        xs: of the points, metres; eight must stand from `first` on, like ys.
        ys: the same.
        first: the first of the eight.
        last: the end of the chord.
        chord: x and y of its direction, and its level: dx y - dy x of its points.
    """
    dx, dy, level = chord
    distances = abs(dx * load(ys, first) - dy * load(xs, first) - level)
    return select(first_lanes(last - first), distances, spread(0.0))


@kernel
def gather(xs: FloatArray, ys: FloatArray, first: int, last: int, piece: Any) -> None:
    """Mean and central second-moment sums of points first to last (inclusive)."""
    x0, y0 = xs[first], ys[first]
    sx = sy = sxx = sxy = syy = 0.0
    for i in range(np.uint64(first), np.uint64(last + 1)):
        dx, dy = xs[i] - x0, ys[i] - y0
        sx += dx
        sy += dy
        sxx += dx * dx
        sxy += dx * dy
        syy += dy * dy
    count = last - first + 1
    piece.points, piece.first, piece.last = count, first, last
    piece.fitted_first, piece.fitted_last = first, last
    piece.mean_x, piece.mean_y = x0 + sx / count, y0 + sy / count
    piece.xx = sxx - sx * sx / count
    piece.xy = sxy - sx * sy / count
    piece.yy = syy - sy * sy / count


@kernel
def refit(xs: FloatArray, ys: FloatArray, piece: Any) -> None:
    """Bring moments and line up to date after `first` or `last` moved by a few points.

    Adds the points that came in at either end and takes out those that left.
    """
    if piece.first == piece.fitted_first and piece.last == piece.fitted_last:
        return
    for i in range(piece.first, piece.fitted_first):
        count_point(xs[i], ys[i], 1, piece)
    for i in range(piece.fitted_last + 1, piece.last + 1):
        count_point(xs[i], ys[i], 1, piece)
    for i in range(piece.fitted_first, piece.first):
        count_point(xs[i], ys[i], -1, piece)
    for i in range(piece.last + 1, piece.fitted_last + 1):
        count_point(xs[i], ys[i], -1, piece)
    piece.fitted_first, piece.fitted_last = piece.first, piece.last
    fit(xs, ys, piece)


@kernel
def count_point(x: float, y: float, sign: int, piece: Any) -> None:
    """Add a point to the moments of a piece (sign 1) or take it out (-1)."""
    dx, dy = x - piece.mean_x, y - piece.mean_y
    count = piece.points + sign
    weight = sign * piece.points / count
    piece.xx += weight * dx * dx
    piece.xy += weight * dx * dy
    piece.yy += weight * dy * dy
    piece.mean_x += sign * dx / count
    piece.mean_y += sign * dy / count
    piece.points = count


@kernel
def absorb(piece: Any, other: Any) -> None:
    """Add the points of `other` to the moments of `piece` (the parallel-axis theorem)."""
    count = piece.points + other.points
    dx, dy = other.mean_x - piece.mean_x, other.mean_y - piece.mean_y
    weight = piece.points * other.points / count
    piece.xx += other.xx + weight * dx * dx
    piece.xy += other.xy + weight * dx * dy
    piece.yy += other.yy + weight * dy * dy
    piece.mean_x += dx * other.points / count
    piece.mean_y += dy * other.points / count
    piece.points = count
    piece.first = min(piece.first, other.first)
    piece.last = max(piece.last, other.last)


@kernel
def fit(xs: FloatArray, ys: FloatArray, piece: Any) -> None:
    """Total least squares line through a piece, and its ends projected on that line.

    The direction is the major axis of the second moments, pointing from the first point to
    the last: beams run counter-clockwise, so the scanner is on its left.
    """
    difference, double = piece.xx - piece.yy, 2.0 * piece.xy
    size = math.sqrt(difference * difference + double * double)
    along_x, along_y = 1.0, 0.0
    if size > 0.0 and difference >= 0.0:
        along_x = math.sqrt(0.5 * (1.0 + difference / size))
        along_y = piece.xy / (size * along_x)
    elif size > 0.0:
        along_y = math.sqrt(0.5 * (1.0 - difference / size))
        along_x = piece.xy / (size * along_y)
    first, last = piece.first, piece.last
    if (xs[last] - xs[first]) * along_x + (ys[last] - ys[first]) * along_y < 0.0:
        along_x, along_y = -along_x, -along_y
    piece.along_x, piece.along_y = along_x, along_y
    piece.spread = 0.5 * (piece.xx + piece.yy + size)
    piece.scatter = max(0.5 * (piece.xx + piece.yy - size), 0.0)
    mean_x, mean_y = piece.mean_x, piece.mean_y
    start = (xs[first] - mean_x) * along_x + (ys[first] - mean_y) * along_y
    end = (xs[last] - mean_x) * along_x + (ys[last] - mean_y) * along_y
    piece.start_x, piece.start_y = mean_x + start * along_x, mean_y + start * along_y
    piece.end_x, piece.end_y = mean_x + end * along_x, mean_y + end * along_y


@kernel
def offset(piece: Any, x: float, y: float) -> float:
    """Signed distance of a point from a piece's line, metres; positive on its left."""
    return float(piece.along_x * (y - piece.mean_y) - piece.along_y * (x - piece.mean_x))
