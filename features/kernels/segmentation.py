"""From ranges to connected groups of points: ruptures and adaptive breakpoints."""

from __future__ import annotations

from typing import Any

from numba import njit

from semnav_env.features.frames import FloatArray
from semnav_env.features.kernels.breakpoints import breakpoint_reach


@njit(cache=True, error_model="numpy")
def is_return(distance: float, range_min: float, limit: float) -> bool:
    """Whether a range is a usable return; anything else is a rupture (Barbret (2.1))."""
    return distance >= range_min and distance < limit and distance > 0.0


@njit(cache=True, error_model="numpy")
def group_points(
    ranges: FloatArray,
    directions: FloatArray,
    increment: float,
    range_min: float,
    limit: float,
    settings: Any,
    scratch: Any,
) -> tuple[int, int]:
    """Valid points (Barbret (1.2)) and where connected groups of them begin.

    Two neighbours are joined while they are no farther apart than the breakpoint rule allows. A
    gap of a few missing returns is bridged if, besides, nothing could pass it.

    Returns:
        How many points and how many groups were written to `scratch`.
    """
    xs, ys, beams, group_first = scratch.xs, scratch.ys, scratch.beams, scratch.group_first
    longest_step = settings.dropout_beams + 1
    nearer, farther, previous, offset = breakpoint_reach(increment, settings)
    points = groups = 0
    last_x = last_y = last_range = 0.0
    last_beam = -longest_step - 1
    for beam in range(len(ranges)):
        distance = ranges[beam]
        if not is_return(distance, range_min, limit):
            continue
        x = distance * directions[beam, 0]
        y = distance * directions[beam, 1]
        step = beam - last_beam
        joined = step <= longest_step
        if joined:
            near, far = min(distance, last_range), max(distance, last_range)
            reach = nearer * near + farther * far + previous * last_range + offset
            if step > 1:
                a, b, c, d = breakpoint_reach(step * increment, settings)
                reach = min(a * near + b * far + c * last_range + d, settings.merge_gap)
            joined = (x - last_x) ** 2 + (y - last_y) ** 2 <= reach * reach
        if not joined:
            group_first[groups] = points
            groups += 1
        xs[points] = last_x = x
        ys[points] = last_y = y
        beams[points] = last_beam = beam
        last_range = distance
        points += 1
    group_first[groups] = points
    return points, groups
