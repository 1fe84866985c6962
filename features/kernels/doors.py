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
    jambs = find_jambs(pieces, settings, scratch)
    found = 0
    for i in range(jambs):
        start = scratch.start_jambs[i]
        for j in range(i + 1, jambs):
            end = scratch.end_jambs[j]
            if not has_door_width(start, end, increment, settings):
                continue
            misfit = alignment(start, end, pieces, settings, scratch)
            if misfit >= NO_SUPPORT or found == len(scratch.candidates):
                continue
            clear = clear_fraction(ranges, directions, range_min, limit, start, end, settings)
            if clear >= settings.door_clear_fraction:
                scratch.candidates[found].score = clear - misfit
                place_jambs(start, end, increment, scratch.candidates[found])
                found += 1
    return keep_best(found, settings.door_width_min, scratch.candidates, doors)


@njit(cache=True, error_model="numpy")
def find_jambs(pieces: int, settings: Any, scratch: Any) -> int:
    """An opening may start where a piece ends and end where a piece starts; returns how many."""
    beams = scratch.beams
    count = 0
    for k in range(pieces):
        piece = scratch.pieces[k]
        if piece.points >= settings.jamb_beams and count < len(scratch.start_jambs):
            start, end = scratch.start_jambs[count], scratch.end_jambs[count]
            write_jamb(start, piece.end_x, piece.end_y, beams[piece.last], k)
            write_jamb(end, piece.start_x, piece.start_y, beams[piece.first], k)
            count += 1
    return count


@njit(cache=True, error_model="numpy")
def write_jamb(jamb: Any, x: float, y: float, beam: int, piece: int) -> None:
    """Set every field of a jamb."""
    jamb.x, jamb.y, jamb.beam, jamb.piece = x, y, beam, piece


@njit(cache=True, error_model="numpy")
def has_door_width(start: Any, end: Any, increment: float, settings: Any) -> bool:
    """Whether the gap between two jambs can be a door.

    A jamb lies up to one beam spacing past the last point that was seen, so the width is only
    known as an interval; it must meet the interval of door widths.
    """
    x, y = end.x - start.x, end.y - start.y
    square = x * x + y * y
    widest = settings.door_width_max + settings.door_width_tolerance
    narrowest = settings.door_width_min - settings.door_width_tolerance
    fits = (square >= narrowest**2) & (square <= (widest + 2.0 * LONGEST_SPACING) ** 2)
    if not fits & (end.beam - start.beam > settings.door_beams):
        return False
    width = math.sqrt(square)
    x, y = x / width, y / width
    width -= beam_spacing(start.x, start.y, x, y, increment)
    width -= beam_spacing(end.x, end.y, x, y, increment)
    return bool(width <= widest)


@njit(cache=True, error_model="numpy")
def beam_spacing(x: float, y: float, along_x: float, along_y: float, increment: float) -> float:
    """Distance along a line between the hits of neighbouring beams near (x, y), metres."""
    across = abs(along_x * y - along_y * x)
    square = x * x + y * y
    if square * increment >= across * LONGEST_SPACING:
        return LONGEST_SPACING
    return square * increment / across


@njit(cache=True, error_model="numpy")
def place_jambs(start: Any, end: Any, increment: float, candidate: Any) -> None:
    """Put the jambs where they are expected: half a beam spacing past the last points seen."""
    x, y = end.x - start.x, end.y - start.y
    width = math.sqrt(x * x + y * y)
    x, y = x / width, y / width
    shift = 0.5 * beam_spacing(start.x, start.y, x, y, increment)
    candidate.start_x, candidate.start_y = start.x + shift * x, start.y + shift * y
    shift = 0.5 * beam_spacing(end.x, end.y, x, y, increment)
    candidate.end_x, candidate.end_y = end.x - shift * x, end.y - shift * y


@njit(cache=True, error_model="numpy")
def alignment(start: Any, end: Any, pieces: int, settings: Any, scratch: Any) -> float:
    """How well the walls beside the gap from one jamb to another are in line with it.

    Returns:
        0 (perfect) to 1 with a wall on both sides, 1 to 2 with one, `NO_SUPPORT` otherwise.
    """
    before = after = NO_SUPPORT
    for k in range(start.piece, max(start.piece - SUPPORT_PIECES, -1), -1):
        wall = scratch.pieces[k]
        if wall.wall >= 0 and before >= NO_SUPPORT:
            before = support(wall, wall.end_x, wall.end_y, start, end, 1.0, settings)
    for k in range(end.piece, min(end.piece + SUPPORT_PIECES, pieces)):
        wall = scratch.pieces[k]
        if wall.wall >= 0 and after >= NO_SUPPORT:
            after = support(wall, wall.start_x, wall.start_y, end, start, -1.0, settings)
    if before < NO_SUPPORT and after < NO_SUPPORT:
        return max(before, after)
    if settings.one_sided_doors and min(before, after) < NO_SUPPORT:
        return 1.0 + min(before, after)
    return NO_SUPPORT


@njit(cache=True, error_model="numpy")
def support(
    wall: Any,
    wall_end_x: float,
    wall_end_y: float,
    near: Any,
    far: Any,
    sense: float,
    settings: Any,
) -> float:
    """How far the far jamb is from a wall's line, as a share of what its fit allows.

    Allowed is `confidence` standard deviations of the fitted line there, plus the allowances
    for real walls, which are no straight lines.

    Returns:
        0 to 1, or `NO_SUPPORT` if the wall ends elsewhere or is not in line with the gap.
    """
    if (near.x - wall_end_x) ** 2 + (near.y - wall_end_y) ** 2 > settings.door_wall_gap**2:
        return NO_SUPPORT
    gap_x, gap_y = far.x - near.x, far.y - near.y
    if sense * (gap_x * wall.along_x + gap_y * wall.along_y) <= 0.0:
        return NO_SUPPORT
    near_error = settings.confidence * line_deviation(wall, near.x, near.y, settings.sigma)
    if abs(offset(wall, near.x, near.y)) > settings.door_offset_tolerance + near_error:
        return NO_SUPPORT
    far_error = settings.confidence * line_deviation(wall, far.x, far.y, settings.sigma)
    if far_error > settings.door_line_error:
        return NO_SUPPORT
    allowed = settings.door_point_tolerance + far_error
    allowed += math.tan(settings.door_angle_tolerance) * math.sqrt(gap_x * gap_x + gap_y * gap_y)
    misfit = abs(offset(wall, far.x, far.y)) / allowed if allowed > 0.0 else NO_SUPPORT
    return misfit if misfit <= 1.0 else NO_SUPPORT


@njit(cache=True, error_model="numpy")
def line_deviation(piece: Any, x: float, y: float, sigma: float) -> float:
    """Standard deviation of a fitted line beside (x, y), metres.

    sigma sqrt(1/n + t^2 / sum t_i^2) with t along the line from the mean of its n points: the
    prediction of a straight-line regression.
    """
    along = piece.along_x * (x - piece.mean_x) + piece.along_y * (y - piece.mean_y)
    return float(sigma * math.sqrt(1.0 / piece.points + along * along / piece.spread))


@njit(cache=True, error_model="numpy")
def clear_fraction(
    ranges: FloatArray,
    directions: FloatArray,
    range_min: float,
    limit: float,
    start: Any,
    end: Any,
    settings: Any,
) -> float:
    """Share of the beams between the jambs that reach well beyond the chord or return nothing.

    Returns:
        0 to 1; 0 also where too few beams pass, or where a beam beside a jamb ends in front of
        the chord: then the jamb is only the edge of a shadow.
    """
    gap_x, gap_y = end.x - start.x, end.y - start.y
    jamb = start.x * gap_y - start.y * gap_x
    first, last = start.beam + 1, end.beam - 1
    if jamb <= 0.0:
        return 0.0
    across = settings.door_recess * math.sqrt(gap_x * gap_x + gap_y * gap_y)
    clear = deep = 0
    for beam in range(first, last + 1):
        distance = ranges[beam]
        if not is_return(distance, range_min, limit):
            clear += 1
            deep += 1
            continue
        slant = directions[beam, 0] * gap_y - directions[beam, 1] * gap_x
        beyond = distance * slant - jamb
        clear += beyond >= settings.door_depth * slant
        deep += beyond >= across
        if beam in (first, last) and beyond < -settings.door_depth * slant:
            return 0.0
    beams_through = last - first + 1
    if deep < settings.door_deep_fraction * beams_through:
        return 0.0
    return float(clear / beams_through)


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
