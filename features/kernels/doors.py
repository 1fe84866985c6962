"""Doors: gaps of door width in line with a wall, with nothing close behind."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numba import njit

from semnav_env.features.frames import FloatArray
from semnav_env.features.kernels.lines import offset
from semnav_env.features.kernels.segmentation import is_return

OPEN, KEPT, SUPPRESSED = 0, 1, 2
NO_SUPPORT = 3.0
SUPPORT_PIECES = 3
"""So many pieces before (after) a jamb are tried as the wall that ends (starts) there."""
LONGEST_SPACING = 0.3
"""Metres; a jamb seen at a grazing angle is still taken to lie this close to the last point."""


@njit(cache=True, error_model="numpy")
def find_doors(
    ranges: FloatArray,
    directions: FloatArray,
    increment: float,
    range_min: float,
    limit: float,
    pieces: int,
    settings: Any,
    scratch: Any,
    doors: np.ndarray,
) -> int:
    """Every pair of jambs, tested; overlapping finds reduced to the best. Returns how many."""
    found = 0
    for a in range(pieces):
        for b in range(a + 1, pieces):
            before, after = scratch.pieces[a], scratch.pieces[b]
            if not has_door_width(before, after, increment, settings):
                continue
            misfit = alignment(a, b, pieces, settings, scratch)
            if misfit >= NO_SUPPORT or found == len(scratch.candidates):
                continue
            clear = clear_fraction(
                ranges, directions, range_min, limit, before, after, settings, scratch.beams
            )
            if clear >= settings.door_clear_fraction:
                candidate = scratch.candidates[found]
                candidate.start_x, candidate.start_y = before.end_x, before.end_y
                candidate.end_x, candidate.end_y = after.start_x, after.start_y
                candidate.score = clear - misfit
                found += 1
    return keep_best(found, settings.door_width_min, scratch.candidates, doors)


@njit(cache=True, error_model="numpy")
def has_door_width(before: Any, after: Any, increment: float, settings: Any) -> bool:
    """Whether the gap from the end of one piece to the start of another can be a door.

    A jamb lies up to one beam spacing past the last point that was seen, so the width is only
    known as an interval; it must meet the interval of door widths.
    """
    x, y = after.start_x - before.end_x, after.start_y - before.end_y
    square = x * x + y * y
    widest = settings.door_width_max + settings.door_width_tolerance
    if square > (widest + 2.0 * LONGEST_SPACING) ** 2:
        return False
    if square < (settings.door_width_min - settings.door_width_tolerance) ** 2:
        return False
    if min(before.points, after.points) < settings.jamb_beams:
        return False
    width = math.sqrt(square)
    width -= beam_spacing(before.end_x, before.end_y, x / width, y / width, increment)
    hypotenuse = math.sqrt(square)
    width -= beam_spacing(after.start_x, after.start_y, x / hypotenuse, y / hypotenuse, increment)
    return width <= widest


@njit(cache=True, error_model="numpy")
def beam_spacing(x: float, y: float, along_x: float, along_y: float, increment: float) -> float:
    """Distance along a line between the hits of neighbouring beams near (x, y), metres."""
    across = abs(along_x * y - along_y * x)
    square = x * x + y * y
    if square * increment >= across * LONGEST_SPACING:
        return LONGEST_SPACING
    return square * increment / across


@njit(cache=True, error_model="numpy")
def alignment(a: int, b: int, pieces: int, settings: Any, scratch: Any) -> float:
    """How well the walls beside the gap from piece a to piece b are in line with it.

    Returns:
        0 (perfect) to 1 with a wall on both sides, 1 to 2 with one, `NO_SUPPORT` otherwise.
    """
    start_x, start_y = scratch.pieces[a].end_x, scratch.pieces[a].end_y
    end_x, end_y = scratch.pieces[b].start_x, scratch.pieces[b].start_y
    left = right = NO_SUPPORT
    for k in range(a, max(a - SUPPORT_PIECES, -1), -1):
        wall = scratch.pieces[k]
        if wall.wall >= 0 and right >= NO_SUPPORT:
            right = support(
                wall, wall.end_x, wall.end_y, start_x, start_y, end_x, end_y, 1.0, settings
            )
    for k in range(b, min(b + SUPPORT_PIECES, pieces)):
        wall = scratch.pieces[k]
        if wall.wall >= 0 and left >= NO_SUPPORT:
            left = support(
                wall, wall.start_x, wall.start_y, end_x, end_y, start_x, start_y, -1.0, settings
            )
    if left < NO_SUPPORT and right < NO_SUPPORT:
        return max(left, right)
    if settings.one_sided_doors and min(left, right) < NO_SUPPORT:
        return 1.0 + min(left, right)
    return NO_SUPPORT


@njit(cache=True, error_model="numpy")
def support(
    wall: Any,
    wall_end_x: float,
    wall_end_y: float,
    near_x: float,
    near_y: float,
    far_x: float,
    far_y: float,
    sense: float,
    settings: Any,
) -> float:
    """How far the far jamb is from a wall's line, as a share of what its fit allows.

    Allowed is `confidence` standard deviations of the fitted line there, plus the allowances
    for real walls, which are no straight lines.

    Returns:
        0 to 1, or `NO_SUPPORT` if the wall ends elsewhere or is not in line with the gap.
    """
    if (near_x - wall_end_x) ** 2 + (near_y - wall_end_y) ** 2 > settings.door_wall_gap**2:
        return NO_SUPPORT
    gap_x, gap_y = far_x - near_x, far_y - near_y
    if sense * (gap_x * wall.along_x + gap_y * wall.along_y) <= 0.0:
        return NO_SUPPORT
    near_error = settings.confidence * line_deviation(wall, near_x, near_y, settings.sigma)
    if abs(offset(wall, near_x, near_y)) > settings.door_offset_tolerance + near_error:
        return NO_SUPPORT
    far_error = settings.confidence * line_deviation(wall, far_x, far_y, settings.sigma)
    if far_error > settings.door_line_error:
        return NO_SUPPORT
    allowed = settings.door_point_tolerance + far_error
    allowed += math.tan(settings.door_angle_tolerance) * math.sqrt(gap_x * gap_x + gap_y * gap_y)
    misfit = abs(offset(wall, far_x, far_y)) / allowed if allowed > 0.0 else NO_SUPPORT
    return misfit if misfit <= 1.0 else NO_SUPPORT


@njit(cache=True, error_model="numpy")
def line_deviation(piece: Any, x: float, y: float, sigma: float) -> float:
    """Standard deviation of a fitted line beside (x, y), metres.

    sigma sqrt(1/n + t^2 / sum t_i^2) with t along the line from the mean of its n points: the
    prediction of a straight-line regression.
    """
    along = piece.along_x * (x - piece.mean_x) + piece.along_y * (y - piece.mean_y)
    return sigma * math.sqrt(1.0 / piece.points + along * along / piece.spread)


@njit(cache=True, error_model="numpy")
def clear_fraction(
    ranges: FloatArray,
    directions: FloatArray,
    range_min: float,
    limit: float,
    before: Any,
    after: Any,
    settings: Any,
    beams: np.ndarray,
) -> float:
    """Share of the beams between the jambs that reach well beyond the chord or return nothing.

    Returns:
        0 to 1; 0 also where too few beams pass, or where a beam beside a jamb ends in front of
        the chord: then the jamb is only the edge of a shadow.
    """
    x, y = before.end_x, before.end_y
    gap_x, gap_y = after.start_x - x, after.start_y - y
    jamb = x * gap_y - y * gap_x
    first, last = beams[before.last] + 1, beams[after.first] - 1
    if last - first + 1 < settings.door_beams or jamb <= 0.0:
        return 0.0
    clear = 0
    for beam in range(first, last + 1):
        distance = ranges[beam]
        if not is_return(distance, range_min, limit):
            clear += 1
            continue
        slant = directions[beam, 0] * gap_y - directions[beam, 1] * gap_x
        beyond = distance * slant - jamb
        clear += beyond >= settings.door_depth * slant
        if beam in (first, last) and beyond < -settings.door_depth * slant:
            return 0.0
    return clear / (last - first + 1)


@njit(cache=True, error_model="numpy")
def keep_best(found: int, nearest: float, candidates: np.ndarray, doors: np.ndarray) -> int:
    """Keep the best of every set of candidates whose midpoints are closer than `nearest`.

    Candidates are compared by place and not by angle, so that a door seen through a door stays.
    Doors are written in beam order.
    """
    for i in range(found):
        candidates[i].state = OPEN
    while True:
        best = -1
        for i in range(found):
            if candidates[i].state == OPEN and (
                best < 0 or candidates[i].score > candidates[best].score
            ):
                best = i
        if best < 0:
            break
        suppress_near(candidates, found, best, nearest)
        candidates[best].state = KEPT
    count = 0
    for i in range(found):
        if candidates[i].state == KEPT and count < len(doors):
            door, candidate = doors[count], candidates[i]
            door.start_x, door.start_y = candidate.start_x, candidate.start_y
            door.end_x, door.end_y = candidate.end_x, candidate.end_y
            count += 1
    return count


@njit(cache=True, error_model="numpy")
def suppress_near(candidates: np.ndarray, found: int, best: int, nearest: float) -> None:
    """Suppress the open candidates near the best one."""
    chosen = candidates[best]
    for i in range(found):
        other = candidates[i]
        dx = chosen.start_x + chosen.end_x - other.start_x - other.end_x
        dy = chosen.start_y + chosen.end_y - other.start_y - other.end_y
        if other.state == OPEN and dx * dx + dy * dy < (2.0 * nearest) ** 2:
            other.state = SUPPRESSED
