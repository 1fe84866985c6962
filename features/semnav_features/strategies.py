"""The named strategies of the feature extractor; a kernel sees the number of a strategy."""

from __future__ import annotations

from enum import IntEnum


class BreakpointRule(IntEnum):
    """The rule for the largest distance of two neighbouring points that are joined.

    The equations are in `semnav_features.kernels.breakpoints`.
    """

    CONSTANT = 0
    BORGES_ALDON = 1
    CERTAD = 2
    DIETMAYER = 3
    SANTOS = 4
    LEE = 5
    WEERAKOON = 6


class Segmentation(IntEnum):
    """Settings for the cut of a connected group of points into straight pieces."""

    END_POINT_FIT = 0
    DYNAMIC = 1
    CURVATURE = 2


def strategy_names(strategies: type[IntEnum]) -> tuple[str, ...]:
    """The names of the strategies in the settings."""
    return tuple(strategy.name.lower() for strategy in strategies)
