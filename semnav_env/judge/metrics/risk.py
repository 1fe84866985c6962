"""The mean of the worst episodes."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

WORST_SHARES = (0.10, 0.05, 0.01)
"""Shares of the episodes over which the reports take the mean of the worst."""


def cvar(values: ArrayLike, share: float, high_is_bad: bool = False) -> float:
    """Conditional value at risk: the mean of the worst `share` of some values.

    For n equally likely values it is the mean of the worst share * n of them, where the last one
    counts by the part of it that is left (Rockafellar and Uryasev 2002, for scenarios). With fewer
    than 1 / share values it is the worst of them; with share 1 it is the mean.

    Args:
        values: one for each episode, at least one.
        share: share of the values, in (0, 1].
        high_is_bad: whether high values are the bad ones, as with collisions; low ones otherwise.

    Raises:
        ValueError: no values, or a share outside (0, 1].
    """
    ordered = np.sort(np.asarray(values, dtype=np.float64).ravel())
    if len(ordered) == 0:
        raise ValueError("no values; the mean of the worst needs at least one")
    if not 0.0 < share <= 1.0:
        raise ValueError(f"share is {share}; it must be above 0 and at most 1")
    worst = ordered[::-1] if high_is_bad else ordered
    weights = np.clip(share * len(worst) - np.arange(len(worst)), 0.0, 1.0)
    return float(weights @ worst / weights.sum())
