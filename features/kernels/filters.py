"""Filters of the ranges before anything else, each only on request."""

from __future__ import annotations

import math
from typing import Any

from numba import njit

from semnav_env.features.frames import FloatArray
from semnav_env.features.kernels.breakpoints import Reach, breakpoint_reach, incidence_factor
from semnav_env.features.kernels.segmentation import is_return

MOST_VEILED = 2
"""A veil of more beams in a row is a surface."""

ROUNDING = 1e-9
"""More than rounding can add to a range, as a share of it."""


@njit(cache=True, error_model="numpy")
def filter_ranges(
    ranges: FloatArray,
    increment: float,
    range_min: float,
    limit: float,
    turn: int,
    settings: Any,
    scratch: Any,
) -> FloatArray:
    """The ranges, without veils if `veil_angle` is set and as medians if `median_beams` is.

    In a full circle of `turn` beams the first comes after the last; else turn is 0. Beams beyond
    it repeat others.
    """
    beams = turn if 0 < turn < len(ranges) else len(ranges)
    if settings.veil_angle > 0.0:
        clear = scratch.clear[: len(ranges)]
        for i in range(beams):
            veiled = is_veiled(ranges, i, increment, range_min, limit, turn, settings)
            clear[i] = math.nan if veiled else ranges[i]
        repeat(ranges, beams, range_min, limit, clear)
        ranges = clear
    if settings.median_beams > 0:
        smooth, half = scratch.smooth[: len(ranges)], settings.median_beams
        reach = breakpoint_reach(increment, settings)
        for i in range(beams):
            smooth[i] = median(
                ranges, i, increment, range_min, limit, turn, half, reach, scratch.window
            )
        repeat(ranges, beams, range_min, limit, smooth)
        ranges = smooth
    return ranges


@njit(cache=True, error_model="numpy")
def repeat(ranges: FloatArray, beams: int, range_min: float, limit: float, out: FloatArray) -> None:
    """Let beams beyond a full turn be what the same beam of the turn is now, if it returned."""
    for i in range(beams, len(ranges)):
        seen = is_return(ranges[i - beams], range_min, limit)
        out[i] = out[i - beams] if seen else ranges[i]


@njit(cache=True, error_model="numpy")
def return_at(ranges: FloatArray, i: int, range_min: float, limit: float, turn: int) -> float:
    """The range of beam i, counted around a full circle; NaN if there is no return."""
    beam = i % turn if turn > 0 else i
    if beam < 0 or beam >= len(ranges) or not is_return(ranges[beam], range_min, limit):
        return math.nan
    return float(ranges[beam])


@njit(cache=True, error_model="numpy")
def apart(first: float, second: float, angle: float) -> float:
    """Distance between the points of two beams (law of cosines); NaN if one has no return."""
    sine = math.sin(0.5 * angle)
    return math.sqrt((first - second) ** 2 + 4.0 * first * second * sine * sine)


@njit(cache=True, error_model="numpy")
def slope(first: float, second: float, angle: float, incidence: float, slack: float) -> int:
    """1 if a line through two points recedes flatter than `incidence`, -1 if it comes nearer so.

    0 if it is met less flatly, by the law of sines with `slack` metres, or a return is missing.
    """
    reach = min(first, second) * incidence_factor(angle, incidence) + slack
    if not apart(first, second, angle) > reach:
        return 0
    return 1 if second > first else -1


@njit(cache=True, error_model="numpy")
def is_veiled(
    ranges: FloatArray,
    i: int,
    increment: float,
    range_min: float,
    limit: float,
    turn: int,
    settings: Any,
) -> bool:
    """Whether a beam ended between two surfaces, having met the edge of one and the other behind.

    Such mixed pixels hang in the air as a veil. From the near surface to the far one, the lines
    between neighbours lie nearly along the beams, flatter than `veil_angle`. So they do on a wall
    that is met as flatly; but a veil has one or two points, which are in line with no wall.
    """
    at = return_at(ranges, i, range_min, limit, turn)
    slack = 3.0 * settings.sigma
    before = return_at(ranges, i - 1, range_min, limit, turn)
    after = return_at(ranges, i + 1, range_min, limit, turn)
    sense = slope(before, at, increment, settings.veil_angle, slack)
    if sense == 0 or slope(at, after, increment, settings.veil_angle, slack) != sense:
        return False
    veil = 1
    for way in (-1, 1):
        near, k = (before, -2) if way < 0 else (after, 2)
        while veil <= MOST_VEILED:
            beyond = return_at(ranges, i + k, range_min, limit, turn)
            if way * slope(near, beyond, increment, settings.veil_angle, slack) != sense:
                break
            veil, near, k = veil + 1, beyond, k + way
    if veil > MOST_VEILED:
        return False
    return not any_wall_goes_on(ranges, i, increment, range_min, limit, turn, settings)


@njit(cache=True, error_model="numpy")
def any_wall_goes_on(
    ranges: FloatArray,
    i: int,
    increment: float,
    range_min: float,
    limit: float,
    turn: int,
    settings: Any,
) -> bool:
    """Whether a beam and the three before it or after it end on one line that is met flatly."""
    for way in (-1, 1):
        at = return_at(ranges, i, range_min, limit, turn)
        first = return_at(ranges, i + way, range_min, limit, turn)
        second = return_at(ranges, i + 2 * way, range_min, limit, turn)
        third = return_at(ranges, i + 3 * way, range_min, limit, turn)
        is_wall = goes_on(third, second, first, increment, settings)
        if is_wall and goes_on(second, first, at, increment, settings):
            return True
    return False


@njit(cache=True, error_model="numpy")
def goes_on(first: float, second: float, third: float, angle: float, settings: Any) -> bool:
    """Whether three beams in a row end on one line that is met flatly, as far as noise lets tell.

    On a line 1/r_1 + 1/r_3 = 2 cos(angle) / r_2.
    """
    flat = 2.0 * max(settings.veil_angle, 2.0 * angle)
    sense = slope(first, second, angle, flat, 0.0)
    if sense == 0 or (third > second) != (sense > 0):
        return False
    inverse = 2.0 * math.cos(angle) / second - 1.0 / first
    gain = 1.0 + third * third * math.sqrt(4.0 / second**4 + 1.0 / first**4)
    tolerance = 3.0 * settings.sigma * gain + ROUNDING * third * (1.0 + third / second)
    return bool(inverse > 0.0 and abs(1.0 / inverse - third) <= tolerance)


@njit(cache=True, error_model="numpy")
def median(
    ranges: FloatArray,
    i: int,
    increment: float,
    range_min: float,
    limit: float,
    turn: int,
    half: int,
    reach: Reach,
    window: FloatArray,
) -> float:
    """The median of a beam and the `half` beams on either side, where that moves no edge.

    That is within a surface, where all of these are joined by the breakpoint rule, and in a run
    of at most `half` joined to nothing on either side: an outlier.
    """
    at = return_at(ranges, i, range_min, limit, turn)
    left = joined_beams(ranges, i, -1, increment, range_min, limit, turn, half, reach)
    right = joined_beams(ranges, i, 1, increment, range_min, limit, turn, half, reach)
    within = left == half and right == half
    alone = min(left, right) >= 0 and left + right < half
    if not (within or alone):
        return float(ranges[i])
    count = 0
    for k in range(i - half, i + half + 1):
        value = return_at(ranges, k, range_min, limit, turn)
        if value == value:
            place = count
            while place > 0 and window[place - 1] > value:
                window[place] = window[place - 1]
                place -= 1
            window[place] = value
            count += 1
    return float(window[count // 2]) if count % 2 == 1 else at


@njit(cache=True, error_model="numpy")
def joined_beams(
    ranges: FloatArray,
    i: int,
    way: int,
    increment: float,
    range_min: float,
    limit: float,
    turn: int,
    half: int,
    reach: Reach,
) -> int:
    """How many of the next `half` beams one way are joined to beam i and one another.

    -1 if a beam without a return follows them: what is there is not known.
    """
    nearer, farther, previous, offset = reach
    here = return_at(ranges, i, range_min, limit, turn)
    for k in range(half):
        there = return_at(ranges, i + way * (k + 1), range_min, limit, turn)
        if not (here == here and there == there):
            return -1
        first = here if way > 0 else there
        most = nearer * min(here, there) + farther * max(here, there) + previous * first + offset
        if apart(here, there, increment) > most:
            return k
        here = there
    return half
