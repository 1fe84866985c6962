"""Finds where a step crosses the line of a doorway."""

from __future__ import annotations

import math

from semnav_features.frames import FloatArray
from semnav_features.kernels.compiling import kernel


@kernel
def first_crossed(doors: FloatArray, x1: float, y1: float, x2: float, y2: float) -> int:
    """The index of the first of `doors`, shape (n, 4), that the step from 1 to 2 crosses, or -1.

    All coordinates are in metres, in one frame; a row of `doors` is x1, y1, x2, y2 of its jambs.
    """
    for i in range(len(doors)):
        share = crossing_share(doors[i, 0], doors[i, 1], doors[i, 2], doors[i, 3], x1, y1, x2, y2)
        if 0.0 <= share <= 1.0:
            return i
    return -1


@kernel
def crossing_share(
    ax: float, ay: float, bx: float, by: float, x1: float, y1: float, x2: float, y2: float
) -> float:
    """Place on the line a-b where the step from 1 to 2 crosses it: 0 at a, 1 at b; NaN if nowhere.

    `before` and `after` are the cross products of a-b with the step's ends: they change their
    sign where the step changes the side of the line, and are as far from zero as it is from it.
    """
    dx, dy = bx - ax, by - ay
    before = dx * (y1 - ay) - dy * (x1 - ax)
    after = dx * (y2 - ay) - dy * (x2 - ax)
    if (before > 0.0) == (after > 0.0):
        return math.nan
    share = before / (before - after)
    x, y = x1 + share * (x2 - x1), y1 + share * (y2 - y1)
    return ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy)
