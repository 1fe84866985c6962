"""The table of agents: means of kept results, with intervals."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from math import isnan, sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from semnav_env.agents.evaluation.attempts import Attempt
from semnav_env.features.frames import FloatArray
from semnav_env.metrics import cvar

RESAMPLES = 2000
"""Resamples of a bootstrap."""

INTERVAL = (2.5, 97.5)
"""Percentiles of the resampled means between which a mean lies, of 95 %."""

DEVIATIONS = 1.96
"""Standard deviations of a normal distribution on each side of the mean that hold 95 %."""

WORST_SHARE = 0.05
"""Share of the episodes over which the worst are averaged."""


class Estimate(NamedTuple):
    """A mean and its interval of 95 %."""

    mean: float
    low: float
    high: float


@dataclass(frozen=True)
class Standing:
    """A row of the leaderboard: one agent on one split with one body.

    Attributes:
        agent: its name.
        split: where it drove.
        robot: name of the body.
        episodes: number of episodes, of all trainings together.
        seeds: number of trainings, which differ in their seed; 1 for an agent that is not trained.
        success: share of episodes in which the command was carried out.
        contact_free: share of episodes without any contact.
        spl: success weighted by path length; None where an episode has none.
        worst: mean success over the worst twentieth of the episodes (CVaR).
        interquartile: mean success of the trainings without the best and the worst quarter of
            them; None for one training.
    """

    agent: str
    split: str
    robot: str
    episodes: int
    seeds: int
    success: Estimate
    contact_free: Estimate
    spl: Estimate | None
    worst: float
    interquartile: float | None


def standings(attempts: Iterable[Attempt]) -> list[Standing]:
    """The rows of the leaderboard, by split and body, the highest success first.

    Raises:
        ValueError: an episode that the same agent drove twice.
    """
    groups: dict[tuple[str, str, str], list[Attempt]] = {}
    for attempt in sorted(attempts):
        key = attempt.split, attempt.robot, attempt.agent
        groups.setdefault(key, []).append(attempt)
    rows = [_standing(group) for group in groups.values()]
    return sorted(rows, key=lambda row: (row.split, row.robot, -row.success.mean, row.agent))


def _standing(attempts: Sequence[Attempt]) -> Standing:
    trainings: dict[int, list[Attempt]] = {}
    for before, attempt in zip((None, *attempts), attempts, strict=False):
        if before and (before.training_seed, before.episode) == (
            attempt.training_seed,
            attempt.episode,
        ):
            raise ValueError(f"{attempt.agent} drove {attempt.episode!r:.80} twice; leave one out")
        trainings.setdefault(attempt.training_seed, []).append(attempt)
    means = sorted(np.mean([each.success for each in group]) for group in trainings.values())
    cut = len(means) // 4
    first, groups = attempts[0], list(trainings.values())
    return Standing(
        agent=first.agent,
        split=first.split,
        robot=first.robot,
        episodes=len(attempts),
        seeds=len(trainings),
        success=_estimate(groups, "success"),
        contact_free=_estimate(groups, "contact_free"),
        spl=None if any(isnan(each.spl) for each in attempts) else _estimate(groups, "spl"),
        worst=cvar([each.success for each in attempts], WORST_SHARE),
        interquartile=float(np.mean(means[cut : len(means) - cut])) if len(means) > 1 else None,
    )


def _estimate(trainings: Sequence[Sequence[Attempt]], name: str) -> Estimate:
    """The mean of a measure over trainings, and its interval.

    The interval is a percentile bootstrap. A resample draws as many trainings as there are, and of
    each as many episodes of each number of clauses as it has (stratified; Agarwal et al. 2021).
    Resamples of episodes that all agree have no spread; then the interval is Wilson's.
    """
    rng = np.random.default_rng(0)
    resampled = np.array([_resampled(training, name, rng) for training in trainings])
    drawn = rng.integers(len(trainings), size=(len(trainings), RESAMPLES))
    means = np.take_along_axis(resampled, drawn, axis=0).mean(axis=0)
    low, high = np.percentile(means, INTERVAL).tolist()
    mean = float(np.mean([np.mean(_values(training, name)) for training in trainings]))
    if low == high:
        low, high = wilson_interval(mean, sum(map(len, trainings)))
    return Estimate(mean, low, high)


def wilson_interval(share: float, count: int) -> tuple[float, float]:
    """Interval of 95 % of a share that was measured on `count` episodes (Wilson 1927)."""
    weight = DEVIATIONS**2 / count
    centre = (share + weight / 2.0) / (1.0 + weight)
    half = sqrt(share * (1.0 - share) * weight + weight**2 / 4.0) / (1.0 + weight)
    return max(0.0, centre - half), min(1.0, centre + half)


def _resampled(
    training: Sequence[Attempt], name: str, rng: np.random.Generator
) -> NDArray[np.float64]:
    """Means of a measure over resamples of the episodes of one training, shape (RESAMPLES,)."""
    sums = np.zeros(RESAMPLES)
    for clauses in sorted({each.clauses for each in training}):
        stratum = _values([each for each in training if each.clauses == clauses], name)
        sums += stratum[rng.integers(len(stratum), size=(RESAMPLES, len(stratum)))].sum(axis=1)
    return sums / len(training)


def _values(attempts: Sequence[Attempt], name: str) -> FloatArray:
    return np.array([getattr(each, name) for each in attempts], np.float64)
