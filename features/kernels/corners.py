"""Corners: where neighbouring walls meet, and where a wall may turn out of sight."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numba import njit

from semnav_env.features.kernels.layout import END_BREAK, END_RUPTURE, START_BREAK, START_RUPTURE

OUTER, INNER, POTENTIAL = 0, 1, 2


@njit(cache=True, error_model="numpy")
def find_corners(count: int, settings: Any, scratch: Any, corners: np.ndarray) -> int:
    """Full corners between neighbouring walls and potential corners at loose wall ends.

    Writes to `scratch.corner_ends` which wall ends and which starts at each corner (or -1).

    Returns:
        How many corners were written, in beam order.
    """
    found = 0
    start_is_free = True
    for k in range(count):
        wall = scratch.pieces[scratch.wall_piece[k]]
        if start_is_free and wall.flags & (START_BREAK | START_RUPTURE):
            found = write_corner(
                found, wall.start_x, wall.start_y, POTENTIAL, -1, k, scratch, corners
            )
        start_is_free = True
        if k + 1 < count:
            following = scratch.pieces[scratch.wall_piece[k + 1]]
            kind, x, y = full_corner(wall, following, settings)
            if kind >= 0:
                found = write_corner(found, x, y, kind, k, k + 1, scratch, corners)
                start_is_free = False
        if start_is_free and wall.flags & (END_BREAK | END_RUPTURE):
            found = write_corner(found, wall.end_x, wall.end_y, POTENTIAL, k, -1, scratch, corners)
    return found


@njit(cache=True, error_model="numpy")
def full_corner(a: Any, b: Any, settings: Any) -> tuple[int, float, float]:
    """Kind and place of the corner of two successive walls; kind -1 if there is none.

    The place is the intersection of the lines, which must be near the end of the first and
    the start of the second. Both walls have the scanner on their left, so a left turn is a
    corner that points away from it (outer) and a right turn one that points at it (inner):
    what Barbret (3.1) decides by distances.
    """
    sine = a.along_x * b.along_y - a.along_y * b.along_x
    cosine = a.along_x * b.along_x + a.along_y * b.along_y
    gap_x, gap_y = b.start_x - a.end_x, b.start_y - a.end_y
    reach = settings.corner_gap
    if gap_x * gap_x + gap_y * gap_y > 4.0 * reach * reach:
        return -1, 0.0, 0.0
    if math.atan2(abs(sine), cosine) < settings.corner_angle or abs(sine) < 1e-3:
        return -1, 0.0, 0.0
    past_a = (gap_x * b.along_y - gap_y * b.along_x) / sine
    past_b = (gap_x * a.along_y - gap_y * a.along_x) / sine
    if abs(past_a) > reach or abs(past_b) > reach:
        return -1, 0.0, 0.0
    kind = OUTER if sine > 0.0 else INNER
    return kind, a.end_x + past_a * a.along_x, a.end_y + past_a * a.along_y


@njit(cache=True, error_model="numpy")
def write_corner(
    found: int,
    x: float,
    y: float,
    kind: int,
    ending: int,
    starting: int,
    scratch: Any,
    corners: np.ndarray,
) -> int:
    """Append a corner if there is room; returns how many there are now."""
    if found == min(len(corners), len(scratch.corner_ends)):
        return found
    corners[found].x, corners[found].y, corners[found].kind = x, y, kind
    scratch.corner_ends[found, 0], scratch.corner_ends[found, 1] = ending, starting
    return found + 1
