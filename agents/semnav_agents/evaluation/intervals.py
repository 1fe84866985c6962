"""Intervals of shares that were measured on some episodes, and the sign test of two agents."""

from __future__ import annotations

from math import comb, sqrt

DEVIATIONS = 1.96
"""Standard deviations of a normal distribution on each side of the mean that hold 95 %."""


def wilson_interval(share: float, count: int) -> tuple[float, float]:
    """Interval of 95 % of a share that was measured on `count` episodes (Wilson 1927)."""
    weight = DEVIATIONS**2 / count
    centre = (share + weight / 2.0) / (1.0 + weight)
    half = sqrt(share * (1.0 - share) * weight + weight**2 / 4.0) / (1.0 + weight)
    return max(0.0, centre - half), min(1.0, centre + half)


def paired_interval(both: int, first: int, second: int, neither: int) -> tuple[float, float]:
    """Interval of 95 % of the difference of two shares on the same episodes, first minus second.

    It joins the Wilson intervals of both shares by their correlation (Newcombe 1998, "Improved
    confidence intervals for the difference between binomial proportions based on paired data",
    method 10), so that it is valid for few episodes and for shares of 0 and 1.

    Args:
        both: number of episodes in which both succeeded.
        first: in which only the first did.
        second: in which only the second did.
        neither: in which none did.
    """
    count = both + first + second + neither
    p, q = (both + first) / count, (both + second) / count
    (p_low, p_high), (q_low, q_high) = wilson_interval(p, count), wilson_interval(q, count)
    twice = 2.0 * _correlation(both, first, second, neither)
    low = (p - p_low) ** 2 - twice * (p - p_low) * (q_high - q) + (q_high - q) ** 2
    high = (p_high - p) ** 2 - twice * (p_high - p) * (q - q_low) + (q - q_low) ** 2
    return p - q - sqrt(max(0.0, low)), p - q + sqrt(max(0.0, high))


def sign_test(first: int, second: int) -> float:
    """Two-sided p-value of the exact sign test: McNemar's test, of successes.

    Args:
        first: number of episodes in which the first agent was better.
        second: in which the second was; ties do not count.
    """
    decided = first + second
    tail = sum(comb(decided, k) for k in range(min(first, second) + 1))
    return min(1.0, float(2 * tail / 2**decided))


def _correlation(both: int, first: int, second: int, neither: int) -> float:
    """Correlation of two outcomes, corrected for continuity where it is positive."""
    sizes = (both + first) * (second + neither) * (both + second) * (first + neither)
    covariance = float(both * neither - first * second)
    if covariance > 0:
        covariance = max(0.0, covariance - (both + first + second + neither) / 2)
    return covariance / sqrt(sizes) if sizes else 0.0
