"""From ranges to connected groups of points: ruptures and adaptive breakpoints."""

from __future__ import annotations

import math
from typing import Any

from numba import njit

from semnav_env.features.frames import FloatArray


@njit(cache=True, error_model="numpy")
def is_return(distance: float, range_min: float, limit: float) -> bool:
    """Whether a range is a usable return; anything else is a rupture (Barbret (2.1))."""
    return distance >= range_min and distance < limit and distance > 0.0


@njit(cache=True, error_model="numpy")
def breakpoint_factor(angle: float, breakpoint_angle: float) -> float:
    """sin(dphi) / sin(lambda - dphi) of the adaptive breakpoint distance (Barbret (2.3)).

    It grows without bound as the angle between two beams nears lambda, so lambda is taken as
    at least twice that angle; beams 45 degrees and more apart are never joined.
    """
    if angle >= math.pi / 4:
        return 0.0
    return math.sin(angle) / math.sin(max(breakpoint_angle, 2.0 * angle) - angle)


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

    Two neighbours are joined while they are no farther apart than r sin(dphi) / sin(lambda -
    dphi) + 3 sigma, with r the nearer range: the worst case of (2.3) seen from either side. A
    gap of a few missing returns is bridged if, besides, nothing could pass it.

    Returns:
        How many points and how many groups were written to `scratch`.
    """
    xs, ys, beams, group_first = scratch.xs, scratch.ys, scratch.beams, scratch.group_first
    noise = 3.0 * settings.sigma
    longest_step = settings.dropout_beams + 1
    factor = breakpoint_factor(increment, settings.breakpoint_angle)
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
            reach = min(distance, last_range) * factor + noise
            if step > 1:
                wide = breakpoint_factor(step * increment, settings.breakpoint_angle)
                reach = min(min(distance, last_range) * wide + noise, settings.merge_gap)
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
