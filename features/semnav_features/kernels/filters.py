"""Filters that may be applied to the ranges before anything else; all are off by default."""

from __future__ import annotations

import math
from typing import Any

from semnav_features.frames import FloatArray
from semnav_features.kernels.breakpoints import (
    ThresholdTerms,
    breakpoint_terms,
    incidence_factor,
)
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.segmentation import is_return

MAX_MIXED_PIXELS = 2
"""Mixed pixels in a row; more points in a row are a surface."""

ROUNDING_SHARE = 1e-9
"""More than rounding can add to a range, as a share of it."""


@kernel
def filter_ranges(ranges: FloatArray, settings: Any, scratch: Any) -> None:
    """Remove mixed pixels if `veil_angle` is set, and take medians if `median_beams` is.

    The result is written to `scratch.filtered`. In a full circle of `beams_per_turn` beams, the
    first comes after the last, and beams beyond it repeat the first ones. `beams_per_turn` is 0
    for other scans.

    Args:
        ranges: of the scan, metres.
        settings: of the extractor.
        scratch: with the limits of the scan.
    """
    beams_per_turn = scratch.beams_per_turn
    beams = beams_per_turn if 0 < beams_per_turn < len(ranges) else len(ranges)
    filtered, half = scratch.filtered[: len(ranges)], settings.median_beams
    if settings.veil_angle > 0.0:
        clear = scratch.clear[: len(ranges)]
        for i in range(beams):
            veiled = is_mixed_pixel(ranges, i, settings, scratch)
            clear[i] = math.nan if veiled else ranges[i]
        repeat_first_beams(ranges, beams, clear, scratch)
        ranges = clear
    for i in range(len(ranges)):
        filtered[i] = ranges[i]
    if half > 0:
        reach = breakpoint_terms(scratch.increment, settings)
        for i in range(beams):
            filtered[i] = median_range(ranges, i, half, reach, scratch)
        repeat_first_beams(ranges, beams, filtered, scratch)


@kernel
def repeat_first_beams(ranges: FloatArray, beams: int, out: FloatArray, scratch: Any) -> None:
    """Copy the filtered first beams to those beyond a full turn, which look the same way.

    Where the first beam had no return, the later one keeps its own range.
    """
    for i in range(beams, len(ranges)):
        seen = is_return(ranges[i - beams], scratch.range_min, scratch.limit)
        out[i] = out[i - beams] if seen else ranges[i]


@kernel
def return_at(ranges: FloatArray, i: int, scratch: Any) -> float:
    """The range of beam i, counted around a full circle; NaN if there is no return."""
    beam = i % scratch.beams_per_turn if scratch.beams_per_turn > 0 else i
    if beam < 0 or beam >= len(ranges):
        return math.nan
    if not is_return(ranges[beam], scratch.range_min, scratch.limit):
        return math.nan
    return float(ranges[beam])


@kernel
def point_distance(first: float, second: float, angle: float) -> float:
    """Distance between the points of two beams (law of cosines); NaN if one has no return."""
    sine = math.sin(0.5 * angle)
    return math.sqrt((first - second) ** 2 + 4.0 * first * second * sine * sine)


@kernel
def flat_slope_sign(
    first: float, second: float, angle: float, incidence: float, slack: float
) -> int:
    """The sign of the range change between two beams that meet a line at a flat angle, else 0.

    1 if the line recedes flatter than `incidence`, radians, and -1 if it comes nearer so; by the
    law of sines, with `slack` metres. 0 also if a return is missing.
    """
    reach = min(first, second) * incidence_factor(angle, incidence) + slack
    if not point_distance(first, second, angle) > reach:
        return 0
    return 1 if second > first else -1


@kernel
def is_mixed_pixel(ranges: FloatArray, i: int, settings: Any, scratch: Any) -> bool:
    """Whether a beam ended in the air, having met the edge of one surface and another one behind.

    Its range is then a mixture of both. From the near surface to the far one, the lines between
    neighbouring points lie nearly along the beams, flatter than `veil_angle`. The same holds on a
    wall that is met as flatly; but mixed pixels are one or two points, in line with no wall.
    """
    at = return_at(ranges, i, scratch)
    slack, increment = 3.0 * settings.sigma, scratch.increment
    before = return_at(ranges, i - 1, scratch)
    after = return_at(ranges, i + 1, scratch)
    sense = flat_slope_sign(before, at, increment, settings.veil_angle, slack)
    if sense == 0 or flat_slope_sign(at, after, increment, settings.veil_angle, slack) != sense:
        return False
    veil = 1
    for way in (-1, 1):
        near, k = (before, -2) if way < 0 else (after, 2)
        while veil <= MAX_MIXED_PIXELS:
            beyond = return_at(ranges, i + k, scratch)
            if way * flat_slope_sign(near, beyond, increment, settings.veil_angle, slack) != sense:
                break
            veil, near, k = veil + 1, beyond, k + way
    if veil > MAX_MIXED_PIXELS:
        return False
    return not is_on_flat_wall(ranges, i, settings, scratch)


@kernel
def is_on_flat_wall(ranges: FloatArray, i: int, settings: Any, scratch: Any) -> bool:
    """Whether a beam and the three before it or after it end on one line that is met flatly."""
    for way in (-1, 1):
        at = return_at(ranges, i, scratch)
        first = return_at(ranges, i + way, scratch)
        second = return_at(ranges, i + 2 * way, scratch)
        third = return_at(ranges, i + 3 * way, scratch)
        is_wall = continues_line(third, second, first, scratch.increment, settings)
        if is_wall and continues_line(second, first, at, scratch.increment, settings):
            return True
    return False


@kernel
def continues_line(first: float, second: float, third: float, angle: float, settings: Any) -> bool:
    """Whether three beams in a row end on one line that is met flatly, within the noise.

    On a line 1/r_1 + 1/r_3 = 2 cos(angle) / r_2.
    """
    flat = 2.0 * max(settings.veil_angle, 2.0 * angle)
    sense = flat_slope_sign(first, second, angle, flat, 0.0)
    if sense == 0 or (third > second) != (sense > 0):
        return False
    inverse = 2.0 * math.cos(angle) / second - 1.0 / first
    gain = 1.0 + third * third * math.sqrt(4.0 / second**4 + 1.0 / first**4)
    tolerance = 3.0 * settings.sigma * gain + ROUNDING_SHARE * third * (1.0 + third / second)
    return bool(inverse > 0.0 and abs(1.0 / inverse - third) <= tolerance)


@kernel
def median_range(
    ranges: FloatArray, i: int, half: int, reach: ThresholdTerms, scratch: Any
) -> float:
    """The median of a beam and the `half` beams on either side, where that moves no edge.

    It moves none within a surface, where the breakpoint rule joins all of these beams, nor for an
    outlier: a run of at most `half` beams that is joined to nothing on either side. Elsewhere the
    range stays as it is.
    """
    at = return_at(ranges, i, scratch)
    left = joined_beams(ranges, i, -half, reach, scratch)
    right = joined_beams(ranges, i, half, reach, scratch)
    within = left == half and right == half
    alone = min(left, right) >= 0 and left + right < half
    if not (within or alone):
        return float(ranges[i])
    count, window = 0, scratch.window
    for k in range(i - half, i + half + 1):
        value = return_at(ranges, k, scratch)
        if value == value:
            place = count
            while place > 0 and window[place - 1] > value:
                window[place] = window[place - 1]
                place -= 1
            window[place] = value
            count += 1
    return float(window[count // 2]) if count % 2 == 1 else at


@kernel
def joined_beams(
    ranges: FloatArray, i: int, steps: int, reach: ThresholdTerms, scratch: Any
) -> int:
    """How many of the next beams are joined to beam i and one another; -steps of those before it.

    -1 if a beam without a return follows them: what is there is not known.
    """
    nearer, farther, previous, offset = reach
    way, half = 1 if steps > 0 else -1, abs(steps)
    here = return_at(ranges, i, scratch)
    for k in range(half):
        there = return_at(ranges, i + way * (k + 1), scratch)
        if not (here == here and there == there):
            return -1
        first = here if way > 0 else there
        most = nearer * min(here, there) + farther * max(here, there) + previous * first + offset
        if point_distance(here, there, scratch.increment) > most:
            return k
        here = there
    return half
