"""What became of many robots in one control period."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from semnav_env.env import SemNavEnv
from semnav_env.features.frames import FloatArray
from semnav_env.tasks.judge import Judgement

Mask = NDArray[np.bool_]


@dataclass(frozen=True)
class Judgements:
    """One entry for each robot; zero for those that were not driven.

    Attributes:
        driven: which robots were driven.
        thought: whose judge thought.
        progress: as in `Judgement`; so are clause, success and failure.
        clause: whether a clause was completed.
        success: whether the command was completed.
        failure: whether the episode failed.
        in_contact: whether the body touches anything.
        terminated: whether the episode is over.
        truncated: whether its time is over.
    """

    driven: Mask
    thought: Mask
    progress: FloatArray
    clause: Mask
    success: Mask
    failure: Mask
    in_contact: Mask
    terminated: Mask
    truncated: Mask

    def judgement(self, index: int) -> Judgement:
        """That of one robot."""
        flags = (bool(each[index]) for each in (self.clause, self.success, self.failure))
        return Judgement(float(self.progress[index]), *flags)


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
    progress = np.where(driven, periods["progress"], 0.0)
    thought, clause, success, failure, terminated = np.zeros((5, len(envs)), dtype=bool)
    for k, judgement in judgements.items():
        thought[k] = True
        progress[k], clause[k], success[k], failure[k] = judgement
        terminated[k] = envs[k].judge.verifier.over
    truncated = driven & ~terminated & (periods["steps"] >= latest)
    in_contact = driven & periods["in_contact"]
    flags = (clause, success, failure, in_contact, terminated, truncated)
    return Judgements(driven, thought, progress, *flags)
