"""Groups the points of a scan that are connected, by ruptures and adaptive breakpoints."""

from __future__ import annotations

from typing import Any

import numpy as np

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
def group_points(count: int, settings: Any, scratch: Any) -> tuple[Any, Any]:
    """Valid points of the first `count` beams and where connected groups of them begin.

    Two neighbours are joined while they are no farther apart than the breakpoint rule allows. A
    gap of a few missing returns is bridged if, besides, nothing could pass it.

    Returns:
        How many points and how many groups (int64) were written to `scratch`.
    """
    ranges, joined, group_first = scratch.ranges, scratch.joined, scratch.group_first
    beams, one, limit = np.uint64(count), np.uint64(1), scratch.limit
    lowest = max(scratch.range_min, SMALLEST_FLOAT)
    place_points(beams, scratch)
    join_neighbours(beams, lowest, breakpoint_terms(scratch.increment, settings), scratch)
    points = groups = first = np.uint64(0)  # unsigned: no index is tested for counting from the end
    last_beam: Any = -1
    while first < beams:
        if not lowest <= ranges[first] < limit:
            first += one
            continue
        if not is_bridged(last_beam, first, settings, scratch):
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
def place_points(beams: Any, scratch: Any) -> None:
    """Write the point of each beam, with a return or not (Barbret (1.2))."""
    xs, ys, ranges, directions = (
        scratch.beam_xs,
        scratch.beam_ys,
        scratch.ranges,
        scratch.directions,
    )
    for i in range(beams):
        xs[i], ys[i] = ranges[i] * directions[i, 0], ranges[i] * directions[i, 1]


@kernel
def join_neighbours(beams: Any, lowest: float, terms: Any, scratch: Any) -> None:
    """Write for each beam whether its point is joined to that of the beam before it.

    Without a branch, so that it is done for many beams at once. Behind the last beam is a break.
    """
    ranges, xs, ys, joined = scratch.ranges, scratch.beam_xs, scratch.beam_ys, scratch.joined
    nearer, farther, previous, offset = terms
    one, limit = np.uint64(1), scratch.limit
    for i in range(one, beams):
        before, after = ranges[i - one], ranges[i]
        less = before if before < after else after
        more = before if before > after else after
        reach = nearer * less + offset + (farther * more + previous * before)
        x, y = xs[i] - xs[i - one], ys[i] - ys[i - one]
        seen = (less >= lowest) & (more < limit)
        joined[i] = seen & (x * x + y * y <= reach * reach)
    joined[beams] = False


@kernel
def next_break(joined: Any, beam: Any) -> Any:
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
def is_bridged(last: int, new: Any, settings: Any, scratch: Any) -> Any:
    """Whether a new beam's point is joined to that of the last beam with a return (-1: none)."""
    step = np.int64(new) - last
    if last < 0 or step > settings.dropout_beams + 1:
        return False
    directions, before, after = scratch.directions, scratch.ranges[last], scratch.ranges[new]
    x = after * directions[new, 0] - before * directions[last, 0]
    y = after * directions[new, 1] - before * directions[last, 1]
    nearer, farther, previous, offset = breakpoint_terms(step * scratch.increment, settings)
    reach = nearer * min(before, after) + farther * max(before, after) + previous * before + offset
    return x * x + y * y <= min(reach, settings.merge_gap) ** 2
