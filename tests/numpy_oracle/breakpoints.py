"""The breakpoint rules as their equations stand, one pair of points at a time."""

from __future__ import annotations

import math
from collections.abc import Callable

from semnav_features.settings import ExtractorSettings

Threshold = Callable[[float, float, float, ExtractorSettings], float]
"""From both ranges in beam order, the angle between them and the settings to a distance."""


def threshold(before: float, after: float, angle: float, settings: ExtractorSettings) -> float:
    """The largest distance at which two points still belong together, metres.

    Args:
        before: range of the earlier point, metres.
        after: range of the later point, metres.
        angle: between their beams, radians.
        settings: which rule, and its constants.
    """
    return _THRESHOLDS[settings.breakpoint_rule](before, after, angle, settings)


def _constant(before: float, after: float, angle: float, s: ExtractorSettings) -> float:
    return s.breakpoint_distance


def _borges_aldon(before: float, after: float, angle: float, s: ExtractorSettings) -> float:
    return before * incidence_factor(angle, s.breakpoint_angle) + 3.0 * s.sigma


def _certad(before: float, after: float, angle: float, s: ExtractorSettings) -> float:
    return min(before, after) * incidence_factor(angle, s.breakpoint_angle) + 3.0 * s.sigma


def _dietmayer(before: float, after: float, angle: float, s: ExtractorSettings) -> float:
    return s.breakpoint_distance + min(before, after) * math.sqrt(2.0 * (1.0 - math.cos(angle)))


def _santos(before: float, after: float, angle: float, s: ExtractorSettings) -> float:
    if angle >= math.pi / 2:
        return s.breakpoint_distance
    chord = min(before, after) * math.sqrt(2.0 * (1.0 - math.cos(angle)))
    cotangent = 1.0 / math.tan(math.pi / 2 - s.breakpoint_angle)
    divisor = cotangent * (math.cos(angle / 2) - math.sin(angle / 2))
    return s.breakpoint_distance + chord / divisor


def _lee(before: float, after: float, angle: float, s: ExtractorSettings) -> float:
    """How far apart points may be whose ratio is k, if the nearer is where it is."""
    near = min(before, after)
    far = near * (1.0 + s.breakpoint_ratio) / (1.0 - s.breakpoint_ratio)
    return math.sqrt(max(near**2 + far**2 - 2.0 * near * far * math.cos(angle), 0.0))


def _weerakoon(before: float, after: float, angle: float, s: ExtractorSettings) -> float:
    near = min(before, after) * max(1.0 - 3.0 * s.sigma, 0.0)
    return near * incidence_factor(angle, s.breakpoint_angle) + 3.0 * s.sigma * max(before, after)


def incidence_factor(angle: float, breakpoint_angle: float) -> float:
    """sin(da) / sin(lambda - da), with lambda at least twice the angle between the beams."""
    if angle >= math.pi / 4:
        return 0.0
    return math.sin(angle) / math.sin(max(breakpoint_angle, 2.0 * angle) - angle)


_THRESHOLDS: dict[str, Threshold] = {
    "constant": _constant,
    "borges_aldon": _borges_aldon,
    "certad": _certad,
    "dietmayer": _dietmayer,
    "santos": _santos,
    "lee": _lee,
    "weerakoon": _weerakoon,
}
