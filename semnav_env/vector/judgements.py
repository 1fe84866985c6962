"""What became of many robots in one control period."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from semnav_env.env import SemNavEnv
from semnav_env.judge.tasks.judge import Judgement
from semnav_env.vector.tick import count_periods
from semnav_features.frames import FloatArray

Mask = NDArray[np.bool_]


@dataclass(frozen=True)
class Judgements:
    """One entry for each robot; zero for those that were not driven.

    Attributes:
        driven: which robots were driven.
        thought: whose judge thought.
        amounts: what the fields of `RewardWeights` weigh, in their order: progress in metres, as in
            `Judgement`; then 1 where a clause was completed, the command was, the episode failed,
            the body touches anything, the robot was driven; shape (6, n).
        terminated: whether the episode is over.
        truncated: whether its time is over.
    """

    driven: Mask
    thought: Mask
    amounts: FloatArray
    terminated: Mask
    truncated: Mask

    def judgement(self, index: int) -> Judgement:
        """That of one robot."""
        progress, *flags = self.amounts[:4, index].tolist()
        return Judgement(progress, *map(bool, flags))


def judge(
    envs: Sequence[SemNavEnv],
    periods: np.ndarray,
    driven: Mask,
    judgements: Mapping[int, Judgement],
    latest: NDArray[np.int64],
) -> Judgements:
    """Say what became of all robots.

    Args:
        envs: of the robots.
        periods: what the compiled calls said, dtype `PERIOD`, shape (n,).
        driven: which robots were driven.
        judgements: of those whose judge thought.
        latest: control period in which the episode of each robot is truncated, shape (n,).
    """
    amounts = np.zeros((6, len(envs)))
    thought, terminated, truncated = np.zeros((3, len(envs)), dtype=bool)
    count_periods(periods, driven, latest, amounts, truncated)
    for k, judgement in judgements.items():
        amounts[:4, k] = judgement
        thought[k], terminated[k] = True, envs[k].judge.verifier.over
        truncated[k] &= not terminated[k]
    return Judgements(driven, thought, amounts, terminated, truncated)
