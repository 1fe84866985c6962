"""The rewards of many robots: at once for `RewardWeights`, one by one for rewards of one's own."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import fields
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from semnav_env.env import SemNavEnv
from semnav_env.judge.tasks import RewardWeights, Tick, terms_of
from semnav_env.vector.judgements import Judgements
from semnav_features.frames import FloatArray

Terms = dict[str, FloatArray]
"""Reward terms by name, each of shape (n,); 0 for robots that were not driven. A masked array where
some robots have no such term."""


class TeamRewards(Protocol):
    """Says what a control period is worth to each robot."""

    def terms(self, judged: Judgements, actions: NDArray[Any]) -> Terms:
        """The terms by name; their sum is the reward."""
        ...


class WeightedTerms:
    """The terms of `RewardWeights`, computed over all robots."""

    def __init__(self, weights: Sequence[RewardWeights]) -> None:
        self._names = [field.name for field in fields(RewardWeights)]
        self._weights = np.array(
            [[float(getattr(each, name)) for each in weights] for name in self._names]
        )

    def terms(self, judged: Judgements, actions: NDArray[Any]) -> Terms:
        """As `RewardWeights.terms`."""
        return dict(zip(self._names, self._weights * judged.amounts, strict=True))


class EachTerms:
    """Terms of any rewards, asked for robot by robot."""

    def __init__(self, envs: Sequence[SemNavEnv]) -> None:
        self._envs = envs

    def terms(self, judged: Judgements, actions: NDArray[Any]) -> Terms:
        """What the rewards of each robot say."""
        terms: Terms = {}
        for k in np.flatnonzero(judged.driven).tolist():
            env, action = self._envs[k], np.asarray(actions[k])
            tick = Tick(*judged.judgement(k), env.simulator.motion, env.belief, action, env.payload)
            for name, value in terms_of(env.rewards, tick).items():
                terms.setdefault(name, np.ma.masked_all(len(self._envs)))[k] = value
        return terms


def team_rewards(envs: Sequence[SemNavEnv]) -> TeamRewards:
    """The fast way where it serves."""
    weights = [env.rewards for env in envs if type(env.rewards) is RewardWeights]
    return WeightedTerms(weights) if len(weights) == len(envs) else EachTerms(envs)
