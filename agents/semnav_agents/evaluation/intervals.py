"""The interval of a share that was measured on some episodes."""

from __future__ import annotations

from math import sqrt

DEVIATIONS = 1.96
"""Standard deviations of a normal distribution on each side of the mean that hold 95 %."""


def wilson_interval(share: float, count: int) -> tuple[float, float]:
    """Interval of 95 % of a share that was measured on `count` episodes (Wilson 1927)."""
    weight = DEVIATIONS**2 / count
    centre = (share + weight / 2.0) / (1.0 + weight)
    half = sqrt(share * (1.0 - share) * weight + weight**2 / 4.0) / (1.0 + weight)
    return max(0.0, centre - half), min(1.0, centre + half)
