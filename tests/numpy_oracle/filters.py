"""Ranges without veils and as medians, in plain Python; see `kernels.filters`."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from semnav_features.settings import ExtractorSettings
from tests.numpy_oracle.breakpoints import incidence_factor, threshold
from tests.numpy_oracle.constants import MOST_VEILED, ROUNDING
from tests.numpy_oracle.sweep import Sweep

At = Callable[[int], float]
"""The range of a beam; NaN if it has no return."""

Change = Callable[[int, At, float, ExtractorSettings], float]
"""What becomes of the range of a beam."""


def filtered(sweep: Sweep, turn: int, settings: ExtractorSettings) -> Sweep:
    """The sweep after the filters that are set; of a full circle if `turn` is not 0."""
    if settings.veil_angle > 0.0:
        sweep = _each(sweep, turn, _unveiled, settings)
    if settings.median_beams > 0:
        sweep = _each(sweep, turn, _median, settings)
    return sweep


def _each(sweep: Sweep, turn: int, change: Change, settings: ExtractorSettings) -> Sweep:
    """Every return of a turn changed; a beam beyond it repeats the one that it lies on."""

    def at(i: int) -> float:
        beam = i % turn if turn else i
        seen = 0 <= beam < len(sweep.ranges) and sweep.returned[beam]
        return float(sweep.ranges[beam]) if seen else math.nan

    ranges = sweep.ranges.copy()
    beams = turn if 0 < turn < len(ranges) else len(ranges)
    for i in np.flatnonzero(sweep.returned[:beams]).tolist():
        ranges[i] = change(i, at, sweep.increment, settings)
    again = np.arange(beams, len(ranges))
    again = again[sweep.returned[again - beams]]
    ranges[again] = ranges[again - beams]
    return replace(sweep, ranges=ranges, returned=sweep.returned & ~np.isnan(ranges))


def _apart(first: float, second: float, angle: float) -> float:
    return math.sqrt((first - second) ** 2 + 4.0 * first * second * math.sin(0.5 * angle) ** 2)


def _slope(first: float, second: float, angle: float, incidence: float, slack: float) -> int:
    reach = min(first, second) * incidence_factor(angle, incidence) + slack
    if not _apart(first, second, angle) > reach:
        return 0
    return 1 if second > first else -1


def _unveiled(i: int, at: At, increment: float, settings: ExtractorSettings) -> float:
    """The range of a beam, or NaN if it ended between two surfaces."""

    def sense(k: int) -> int:
        slack = 3.0 * settings.sigma
        return _slope(at(i + k), at(i + k + 1), increment, settings.veil_angle, slack)

    limits = increment, settings
    if sense(-1) == 0 or sense(0) != sense(-1):
        return at(i)
    veil = 1
    for step, k in ((-1, -2), (1, 1)):
        while veil <= MOST_VEILED and sense(k) == sense(0):
            veil, k = veil + 1, k + step
    runs_on = any(
        all(
            _goes_on(at(i + (k + 2) * way), at(i + (k + 1) * way), at(i + k * way), *limits)
            for k in (0, 1)
        )
        for way in (-1, 1)
    )
    return at(i) if veil > MOST_VEILED or runs_on else math.nan


def _goes_on(
    first: float, second: float, third: float, angle: float, settings: ExtractorSettings
) -> bool:
    """Whether the third of three beams ends on the line through the points of the other two."""
    sense = _slope(first, second, angle, 2.0 * max(settings.veil_angle, 2.0 * angle), 0.0)
    inverse = 2.0 * math.cos(angle) / second - 1.0 / first
    if sense == 0 or (third > second) != (sense > 0) or not inverse > 0.0:
        return False
    gain = 1.0 + third**2 * math.hypot(2.0 / second**2, 1.0 / first**2)
    rounding = ROUNDING * third * (1.0 + third / second)
    return abs(1.0 / inverse - third) <= 3.0 * settings.sigma * gain + rounding


def _median(i: int, at: At, increment: float, settings: ExtractorSettings) -> float:
    """The median around a beam within a surface or of an outlier, else its range."""
    half = settings.median_beams
    left, right = (_joined(i, way, at, increment, settings) for way in (-1, 1))
    if left is None or right is None or left + right not in (2 * half, *range(half)):
        return at(i)
    window = sorted(r for k in range(i - half, i + half + 1) if not math.isnan(r := at(k)))
    return window[len(window) // 2] if len(window) % 2 else at(i)


def _joined(i: int, way: int, at: At, angle: float, settings: ExtractorSettings) -> int | None:
    """How many beams are joined to beam i on one side; None if one has no return."""
    for k in range(settings.median_beams):
        here, there = at(i + way * k), at(i + way * (k + 1))
        if math.isnan(there):
            return None
        before, after = (here, there) if way > 0 else (there, here)
        if _apart(here, there, angle) > threshold(before, after, angle, settings):
            return k
    return settings.median_beams
