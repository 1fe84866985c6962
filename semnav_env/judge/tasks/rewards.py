"""Rewards as named terms; the reward of a step is their sum."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import astuple, dataclass, fields
from functools import cached_property
from numbers import Real
from operator import mul
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple, Protocol, TypeAlias, runtime_checkable

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
        failure: once, for a wrong door, a wrong turn, an incomplete clause or stopping short.
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
        return weigh(self.each, *tick[:4], tick.motion.in_contact)

    @cached_property
    def each(self) -> tuple[float, ...]:
        """The weights, in the order of `TERMS`."""
        return astuple(self)


TERMS = tuple(each.name for each in fields(RewardWeights))
"""Names of the terms."""


def weigh(
    weights: Iterable[Any],
    progress: Any,
    clause: Any,
    success: Any,
    failure: Any,
    in_contact: Any,
    *,
    driven: Any = 1,
) -> dict[str, Any]:
    """The terms by name: each weight times what it is the weight of, see `RewardWeights`.

    Args:
        weights: in the order of `TERMS`. For many robots each is an array, and so are the others.
        progress: in metres, see `Tick`, like the next three.
        clause: whether a clause was completed.
        success: whether the whole command was completed.
        failure: whether the episode failed.
        in_contact: whether the body touches anything.
        driven: whether the robot was driven, which takes time.
    """
    amounts = progress, clause, success, failure, in_contact, driven
    weighed = map(mul, weights, amounts)
    return dict(zip(TERMS, weighed, strict=True))


def terms_of(rewards: Rewards, tick: Tick) -> dict[str, float]:
    """The terms of a step, of rewards that may give anything; a `ValueError` names no number."""
    terms = rewards.terms(tick)
    for name, value in terms.items():
        if not isinstance(value, Real | np.bool_) or not math.isfinite(value):
            raise ValueError(f"reward term {name!r} is {value!r:.80}; it must be a finite number")
    return terms


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
