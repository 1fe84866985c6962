"""Groups the points of a scan that are connected, by ruptures and adaptive breakpoints."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from semnav_env.features.frames import FloatArray
from semnav_env.features.kernels.breakpoints import breakpoint_terms
from semnav_env.features.kernels.compiling import kernel

SMALLEST_FLOAT = 5e-324
"""The smallest positive number: a range of zero is no return."""


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
    """Valid points (Barbret (1.2)) and where connected groups of them begin.

    Two neighbours are joined while they are no farther apart than the breakpoint rule allows. A
    gap of a few missing returns is bridged if, besides, nothing could pass it.

    Returns:
        How many points and how many groups (int64) were written to `scratch`.
    """
    xs, ys, beams, group_first = scratch.xs, scratch.ys, scratch.beams, scratch.group_first
    longest_step = settings.dropout_beams + 1
    nearer, farther, previous, offset = breakpoint_terms(increment, settings)
    plain = farther == 0.0 and previous == 0.0
    lowest = max(range_min, SMALLEST_FLOAT)
    points = groups = np.uint64(0)  # unsigned, or every index is tested for counting from the end
    last_x = last_y = last_range = 0.0
    last_beam = -longest_step - 1
    for index in range(np.uint64(len(ranges))):
        distance = ranges[index]
        if not (distance >= lowest and distance < limit):
            continue
        x = distance * directions[index, 0]
        y = distance * directions[index, 1]
        beam = np.int64(index)
        step = beam - last_beam
        if step == 1:
            reach = nearer * min(distance, last_range) + offset
            if not plain:
                reach += farther * max(distance, last_range) + previous * last_range
        elif step <= longest_step:
            reach = bridge_reach(step * increment, last_range, distance, settings)
        else:
            reach = math.nan  # never within it
        if not (x - last_x) ** 2 + (y - last_y) ** 2 <= reach * reach:
            group_first[groups] = points
            groups += np.uint64(1)
        xs[points] = last_x = x
        ys[points] = last_y = y
        beams[points] = last_beam = beam
        last_range = distance
        points += np.uint64(1)
    group_first[groups] = points
    return np.int64(points), np.int64(groups)


@kernel
def bridge_reach(angle: float, before: float, after: float, settings: Any) -> float:
    """How far points on either side of a few missing returns may be apart, metres."""
    nearer, farther, previous, offset = breakpoint_terms(angle, settings)
    reach = nearer * min(before, after) + farther * max(before, after) + previous * before + offset
    return float(min(reach, settings.merge_gap))
