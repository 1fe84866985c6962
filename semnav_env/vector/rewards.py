"""The rewards of many robots: at once for `RewardWeights`, one by one for user-defined rewards."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from semnav_env.env import SemNavEnv
from semnav_env.judge import Period
from semnav_env.judge.tasks.rewards import RewardWeights, weigh
from semnav_features.frames import FloatArray

Mask = NDArray[np.bool_]

Terms = dict[str, FloatArray]
"""Reward terms by name, each of shape (n,); 0 for robots that were not driven. A masked array
where some robots have no such term."""


class TeamRewards:
    """Computes the reward terms of each robot for a control period.

    Args:
        envs: environments of the robots, with their rewards.
    """

    def __init__(self, envs: Sequence[SemNavEnv]) -> None:
        self._envs = envs
        each = [env.rewards.each for env in envs if type(env.rewards) is RewardWeights]
        self._weights = np.array(each, float).T if len(each) == len(envs) else None

    def terms(self, period: Period, actions: NDArray[Any], driven: Mask) -> Terms:
        """The terms by name, see `RobotLoop.terms`; their sum is the reward.

        Args:
            period: of all robots.
            actions: of all robots.
            driven: which robots were driven.
        """
        if self._weights is None:
            return self._one_by_one(actions, driven)
        amounts = *period.judged, period.in_contact
        if driven.all():
            return weigh(self._weights, *amounts)
        done = [np.where(driven, each, 0.0) for each in amounts]
        return weigh(self._weights, *done, driven=driven)

    def _one_by_one(self, actions: NDArray[Any], driven: Mask) -> Terms:
        terms: Terms = {}
        for k in np.flatnonzero(driven).tolist():
            env = self._envs[k]
            own = env.loop.terms(env.rewards, env.judge.period, actions[k])
            for name, value in own.items():
                terms.setdefault(name, np.ma.masked_all(len(self._envs)))[k] = value
        return terms
