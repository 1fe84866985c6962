"""Breakpoint rules: how far apart two neighbouring points may be and still belong together.

Weerakoon, Ishii and Forough Nassiraei (section II.B) compare seven thresholds for the distance D
of two successive points at ranges r_n and r_n+1, da apart in angle. Every one of them, as
corrected below, is linear in the ranges:

    D = nearer min(r_n, r_n+1) + farther max(r_n, r_n+1) + previous r_n + offset,

with coefficients that depend on the angle and the settings alone. So a rule is a function that
gives four numbers, computed once per scan, and every rule costs the same per beam.
"""

from __future__ import annotations

import math
from typing import Any, TypeAlias

from semnav_features.kernels.compiling import kernel
from semnav_features.strategies import BreakpointRule

ThresholdTerms: TypeAlias = tuple[float, float, float, float]
"""The coefficients (nearer, farther, previous, offset); the offset in metres."""

_CONSTANT = int(BreakpointRule.CONSTANT)
_BORGES_ALDON = int(BreakpointRule.BORGES_ALDON)
_DIETMAYER = int(BreakpointRule.DIETMAYER)
_SANTOS = int(BreakpointRule.SANTOS)
_LEE = int(BreakpointRule.LEE)
_WEERAKOON = int(BreakpointRule.WEERAKOON)


@kernel
def breakpoint_terms(angle: float, settings: Any) -> ThresholdTerms:
    """The coefficients of the rule in the settings, for two beams that are `angle` apart."""
    rule = settings.breakpoint_rule
    if rule == _CONSTANT:
        return constant(settings)
    if rule == _BORGES_ALDON:
        return borges_aldon(angle, settings)
    if rule == _DIETMAYER:
        return dietmayer(angle, settings)
    if rule == _SANTOS:
        return santos(angle, settings)
    if rule == _LEE:
        return lee(angle, settings)
    if rule == _WEERAKOON:
        return weerakoon(angle, settings)
    return certad(angle, settings)


@kernel
def incidence_factor(angle: float, breakpoint_angle: float) -> float:
    """sin(da) / sin(lambda - da): the law of sines in the triangle of two beams and a wall.

    It grows without bound as the angle between two beams nears lambda, so lambda is taken as
    at least twice that angle; beams 45 degrees and more apart do not reach each other.
    """
    if angle >= math.pi / 4:
        return 0.0
    return math.sin(angle) / math.sin(max(breakpoint_angle, 2.0 * angle) - angle)


@kernel
def constant(settings: Any) -> ThresholdTerms:
    """D = C0: what the papers start from (Weerakoon (3))."""
    return 0.0, 0.0, 0.0, settings.breakpoint_distance


@kernel
def borges_aldon(angle: float, settings: Any) -> ThresholdTerms:
    """D = r_n sin(da) / sin(lambda - da) + 3 sigma (Weerakoon (5), Barbret (2.3)).

    Weerakoon calls sigma a variance and Barbret writes the point P_n-1 for its range; both can
    only mean the standard deviation and the range, as the terms are lengths. The rule asks for
    the range of the earlier point, so a mirrored scan may be cut elsewhere.
    """
    return 0.0, 0.0, incidence_factor(angle, settings.breakpoint_angle), 3.0 * settings.sigma


@kernel
def certad(angle: float, settings: Any) -> ThresholdTerms:
    """D = min(r_n, r_n+1) sin(da) / sin(lambda - da) + 3 sigma (Weerakoon (6)).

    The worst case of Borges and Aldon seen from either side, the same in both directions.
    Weerakoon says under (6) that results depend on the direction; that is true of (5) only.
    """
    return incidence_factor(angle, settings.breakpoint_angle), 0.0, 0.0, 3.0 * settings.sigma


@kernel
def dietmayer(angle: float, settings: Any) -> ThresholdTerms:
    """D = C0 + C1 min(r_n, r_n+1), C1 = sqrt(2 (1 - cos da)) (Weerakoon (7)).

    C1 is the chord of da. Weerakoon adds C1 = D(r_n, r_n+1) / r_n, which holds only where both
    ranges are the same, on a wall met squarely; taken for any pair it would join all points.
    """
    return 2.0 * abs(math.sin(0.5 * angle)), 0.0, 0.0, settings.breakpoint_distance


@kernel
def santos(angle: float, settings: Any) -> ThresholdTerms:
    """D = C0 + C1 min(r_n, r_n+1) / (cot(beta) (cos(da / 2) - sin(da / 2))) (Weerakoon (8)).

    Beta is how far from square a wall may be met: 90 degrees less lambda. The bracket is kept as
    printed; the triangle itself has cos(beta) cos(da / 2) - sin(beta) sin(da / 2) in place of
    the divisor, which is the same in the limit of flat incidence and fine beams. Beams 90
    degrees and more apart, where the bracket changes its sign, have C0 alone.
    """
    half = 0.5 * angle
    if half >= math.pi / 4:
        return 0.0, 0.0, 0.0, settings.breakpoint_distance
    divisor = math.tan(settings.breakpoint_angle) * (math.cos(half) - math.sin(half))
    return 2.0 * math.sin(half) / divisor, 0.0, 0.0, settings.breakpoint_distance


@kernel
def lee(angle: float, settings: Any) -> ThresholdTerms:
    """|r_n - r_n+1| / (r_n + r_n+1) <= k (after Weerakoon (9)).

    (9) is printed as a threshold for the distance D. That compares metres with a ratio, and cuts
    every wall met squarely, where the ratio is zero. The ratio is what is measured, and the
    threshold is a constant k. It allows a farther range of q = (1 + k) / (1 - k) times the
    nearer, at a distance of sqrt(1 + q^2 - 2 q cos da) times the nearer: the form returned here.
    """
    ratio = (1.0 + settings.breakpoint_ratio) / (1.0 - settings.breakpoint_ratio)
    squared = 1.0 + ratio * ratio - 2.0 * ratio * math.cos(angle)
    return math.sqrt(max(squared, 0.0)), 0.0, 0.0, 0.0


@kernel
def weerakoon(angle: float, settings: Any) -> ThresholdTerms:
    """D = min (1 - 3 s) sin(da) / sin(lambda - da) + 3 s max (Weerakoon (12)).

    (12) writes sigma for s, but where (5) and (6) add a length, s is a share of the range (the
    paper gives its lidar's "residual variance" as 3 %). It is taken as sigma per metre: a sensor
    of 20 mm counts as one of 2 %.
    """
    share = 3.0 * settings.sigma
    factor = incidence_factor(angle, settings.breakpoint_angle)
    return max(1.0 - share, 0.0) * factor, share, 0.0, 0.0
