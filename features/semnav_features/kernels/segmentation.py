"""Groups the points of a scan that are connected, by ruptures and adaptive breakpoints."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from semnav_features.frames import FloatArray
from semnav_features.kernels.breakpoints import breakpoint_terms
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.lanes import WIDTH, load, store

SMALLEST_FLOAT = 5e-324
"""The smallest positive number: a range of zero is no return."""

EIGHT, ALL_JOINED = np.uint64(8), np.uint64(0x0101010101010101)
"""Number of beams that are looked at together, and eight bytes that say that all are joined."""


@kernel
def is_return(distance: float, range_min: float, limit: float) -> bool:
    """Whether a range is a usable return; anything else is a rupture (Barbret (2.1))."""
    return distance >= range_min and distance < limit and distance > 0.0


@kernel
def group_points(
    ranges: FloatArray,
    directions: FloatArray,
    increment: float,
    range_min: float,
    limit: float,
    settings: Any,
    scratch: Any,
) -> tuple[Any, Any]:
    """Valid points and where connected groups of them begin.

    Two neighbours are joined while they are no farther apart than the breakpoint rule allows. A
    gap of a few missing returns is bridged if, besides, nothing could pass it.

    Returns:
        How many points and how many groups (int64) were written to `scratch`.
    """
    lowest, one = max(range_min, SMALLEST_FLOAT), np.uint64(1)
    beams, joined, group_first = np.uint64(len(ranges)), scratch.joined, scratch.group_first
    terms = breakpoint_terms(increment, settings)
    place_points(ranges, directions, scratch.beam_xs, scratch.beam_ys)
    join_neighbours(ranges, scratch.beam_xs, scratch.beam_ys, lowest, limit, terms, joined)
    points = groups = first = np.uint64(0)  # unsigned: no index is tested for counting from the end
    last_beam: Any = -1
    while first < beams:
        if not lowest <= ranges[first] < limit:
            first += one
            continue
        if not is_bridged(ranges, directions, increment, settings, last_beam, first):
            group_first[groups] = points
            groups += one
        end = next_break(joined, first + one)
        while end < beams and lowest <= ranges[end] < limit:
            group_first[groups] = points + (end - first)
            groups += one
            end = next_break(joined, end + one)
        write_points(first, end, points, scratch)
        points += end - first
        last_beam, first = np.int64(end) - 1, end + one
    group_first[groups] = points
    return np.int64(points), np.int64(groups)


@kernel
def place_points(
    ranges: FloatArray, directions: FloatArray, xs: FloatArray, ys: FloatArray
) -> None:
    """Write the point of each beam, with a return or not (Barbret (1.2))."""
    flat = directions.reshape(-1)  # the compiler must know how far the rows are apart
    for i in range(np.uint64(len(ranges))):
        xs[i], ys[i] = ranges[i] * flat[i + i], ranges[i] * flat[i + i + np.uint64(1)]


@kernel
def join_neighbours(
    ranges: FloatArray,
    xs: FloatArray,
    ys: FloatArray,
    lowest: float,
    limit: float,
    terms: Any,
    joined: Any,
) -> None:
    """Write for each beam whether its point is joined to that of the beam before it.

    Without a branch, so that it is done for many beams at once. Behind the last beam is a break.
    """
    nearer, farther, previous, offset = terms
    one = np.uint64(1)
    for i in range(one, np.uint64(len(ranges))):
        before, after = ranges[i - one], ranges[i]
        less = before if before < after else after
        more = before if before > after else after
        reach = nearer * less + offset + (farther * more + previous * before)
        x, y = xs[i] - xs[i - one], ys[i] - ys[i - one]
        seen = (less >= lowest) & (more < limit)
        joined[i] = seen & (x * x + y * y <= reach * reach)
    joined[len(ranges)] = False


@kernel
def next_break(joined: NDArray[np.bool_], beam: Any) -> Any:
    """The first beam from a beam on that is not joined to the one before it."""
    eights = joined.view(np.uint64)
    while joined[beam]:
        is_whole = beam % EIGHT == 0 and eights[beam // EIGHT] == ALL_JOINED
        beam += EIGHT if is_whole else np.uint64(1)
    return beam


@kernel
def write_points(first: Any, end: Any, points: Any, scratch: Any) -> None:
    """Write the points of the beams first to end (exclusive), the first one as number `points`.

    What is written beyond the last one, up to seven entries, the next points are written over.
    """
    xs, ys, beams = scratch.xs, scratch.ys, scratch.beams
    shift = points - first
    for i in range(first, end, np.uint64(WIDTH)):
        store(xs, i + shift, load(scratch.beam_xs, i))
        store(ys, i + shift, load(scratch.beam_ys, i))
        for k in range(i, i + np.uint64(WIDTH)):
            beams[k + shift] = np.int64(k)


@kernel
def is_bridged(
    ranges: FloatArray, directions: FloatArray, increment: float, settings: Any, last: int, new: Any
) -> Any:
    """Whether a new beam's point is joined to that of the last beam with a return (-1: none)."""
    step = np.int64(new) - last
    if last < 0 or step > settings.dropout_beams + 1:
        return False
    before, after = ranges[last], ranges[new]
    x = after * directions[new, 0] - before * directions[last, 0]
    y = after * directions[new, 1] - before * directions[last, 1]
    nearer, farther, previous, offset = breakpoint_terms(step * increment, settings)
    reach = nearer * min(before, after) + farther * max(before, after) + previous * before + offset
    return x * x + y * y <= min(reach, settings.merge_gap) ** 2
