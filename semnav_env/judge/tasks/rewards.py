"""Rewards as named terms; the reward of a step is their sum."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields
from functools import cached_property
from typing import TYPE_CHECKING, Annotated, NamedTuple, Protocol, TypeAlias, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from semnav_env.mind.belief import Belief
from semnav_env.world.simulator.sensed import Motion
from semnav_features.checked_fields import Bounds, check_fields

if TYPE_CHECKING:
    from semnav_env.judge.payload import Payload


class Tick(NamedTuple):
    """What a reward may depend on: one control period as it was judged.

    Attributes:
        progress: by how much the shortest way to the active clause's goal got shorter, metres.
        clause: whether a clause was completed.
        success: whether the whole command was completed.
        failure: whether the episode failed, but for running out of time.
        motion: true pose, speed and contact.
        belief: what the robot believes now.
        action: that the agent gave, as it gave it.
        payload: that the robot carries; None without one.
    """

    progress: float
    clause: bool
    success: bool
    failure: bool
    motion: Motion
    belief: Belief
    action: NDArray[np.floating]
    payload: Payload | None = None


@runtime_checkable
class Rewards(Protocol):
    """Says what a step is worth."""

    def terms(self, tick: Tick) -> dict[str, float]:
        """The terms of a step by name; their sum is the reward."""
        ...


Weight: TypeAlias = Annotated[float, Bounds(-1e6, 1e6)]

RewardTerm = Callable[[Tick], float]
"""One term of a reward."""


@dataclass(frozen=True)
class RewardWeights:
    """The rewards of `SemNav-v0`: what each term is worth.

    Attributes:
        progress: per metre by which the shortest way to the active clause's goal gets shorter.
        clause: for each clause carried out.
        success: once, for the whole command.
        failure: once, for a wrong door, a wrong turn or stopping short.
        contact: per step in contact.
        time: per step.

    Raises:
        ValueError: a weight is no number, not finite or too large; names it.
    """

    progress: Weight = 1.0
    clause: Weight = 2.0
    success: Weight = 10.0
    failure: Weight = -5.0
    contact: Weight = -0.1
    time: Weight = -0.01

    def __post_init__(self) -> None:
        check_fields(self)

    def terms(self, tick: Tick) -> dict[str, float]:
        """The terms of a step by name, each times its weight."""
        return self.weigh(*tick[:4], tick.motion.in_contact)

    def weigh(
        self, progress: float, clause: bool, success: bool, failure: bool, in_contact: bool
    ) -> dict[str, float]:
        """The terms, given all that they depend on; see `Tick`."""
        if not (clause or success or failure or in_contact):
            return self._uneventful | {"progress": self.progress * progress}
        return {
            "progress": self.progress * progress,
            "clause": self.clause * clause,
            "success": self.success * success,
            "failure": self.failure * failure,
            "contact": self.contact * in_contact,
            "time": self.time,
        }

    @cached_property
    def _uneventful(self) -> dict[str, float]:
        """The terms of nearly every step, but for its progress."""
        weights = {each.name: getattr(self, each.name) for each in fields(RewardWeights)}
        return {name: False * weight for name, weight in weights.items()} | {"time": self.time}


def as_rewards(value: object) -> Rewards:
    """What `rewards=` takes, as it is.

    Raises:
        ValueError: an object without `terms(tick)`.
    """
    if isinstance(value, Rewards) and not isinstance(value, type):
        return value
    raise ValueError(
        f"rewards is {value!r:.80}; it must be a semnav_env.judge.tasks.RewardWeights or have "
        "terms(tick); AddedTerms adds terms of your own by name"
    )
