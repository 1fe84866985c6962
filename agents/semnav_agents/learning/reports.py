"""Reports of a training while it runs."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, NamedTuple, TypeAlias


@dataclass(frozen=True)
class TrainingReport:
    """The state of a training; shares and means are of the last hundred episodes, NaN before any.

    Attributes:
        steps: number of decisions so far.
        rate: decisions per second in the last rollout.
        success: share of episodes in which the command was carried out.
        contact_free: share of episodes without any contact.
        spl: mean success weighted by path length, as the evaluation measures it.
        reward: mean sum of rewards of an episode.
    """

    steps: int
    rate: float
    success: float
    contact_free: float
    spl: float
    reward: float


class Preparation(NamedTuple):
    """The progress of the preparation before the first rollout.

    Attributes:
        phase: "demonstrations" are driven, or in "cloning" a policy learns from them.
        done: demonstrations driven, or passes over them.
        total: of these.
        loss: mean of the last pass; None while demonstrations are driven.
    """

    phase: Literal["demonstrations", "cloning"]
    done: int
    total: int
    loss: float | None = None


TrainingState: TypeAlias = Preparation | TrainingReport
