"""The table of agents: means of kept results, with intervals."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from math import isnan
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from semnav_agents.evaluation.attempts import Attempt
from semnav_agents.evaluation.intervals import wilson_interval
from semnav_env.judge.metrics import cvar
from semnav_features.frames import FloatArray

RESAMPLES = 2000
"""Resamples of a bootstrap."""

INTERVAL = (2.5, 97.5)
"""Percentiles of the resampled means between which a mean lies, of 95 %."""

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
        version: of semnav-env with which it drove; several are joined by commas.
        commit: of its checkout, likewise; empty without one.
        rules: fingerprint of the rules under which it drove, or `UNKNOWN`.
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
    version: str
    commit: str
    rules: str


def standings(attempts: Iterable[Attempt]) -> list[Standing]:
    """The rows of the leaderboard, by split and body, the highest success first.

    Results of an agent under other rules are a separate row.

    Raises:
        ValueError: an episode that the same agent drove twice.
    """
    groups: dict[tuple[str, ...], list[Attempt]] = {}
    for attempt in sorted(attempts):
        key = attempt.split, attempt.robot, attempt.agent, attempt.rules
        groups.setdefault(key, []).append(attempt)
    rows = [_standing(group) for group in groups.values()]
    return sorted(
        rows, key=lambda row: (row.split, row.robot, -row.success.mean, row.agent, row.rules)
    )


def check_one_rules(rows: Iterable[Standing]) -> None:
    """Refuse rows that were driven under different rules: they are no comparison of agents.

    Raises:
        ValueError: there are several fingerprints; names the rows of each.
    """
    under: dict[str, list[str]] = {}
    for row in rows:
        named = f"{row.agent} ({row.split}, {row.robot})"
        under.setdefault(row.rules, []).append(named)
    if len(under) > 1:
        told = "; ".join(f"rules {rules}: {', '.join(named)}" for rules, named in under.items())
        raise ValueError(f"different rules are not compared unless --mixed is given: {told}")


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
        version=_joined(each.version for each in attempts),
        commit=_joined(each.commit for each in attempts),
        rules=first.rules,
    )


def _joined(texts: Iterable[str]) -> str:
    return ", ".join(sorted({text for text in texts if text}))


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
