"""Reward terms of your own, added to other rewards."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, fields

from semnav_env.judge.tasks.rewards import Rewards, RewardTerm, RewardWeights, Tick


@dataclass(frozen=True)
class AddedTerms:
    """Rewards with terms of your own added to them.

        AddedTerms({"smooth": lambda tick: -0.1 * abs(tick.motion.yaw_rate)})

    Attributes:
        added: the terms by name; functions of a module, where the environment is to be pickled.
        base: the rewards that they are added to.

    Raises:
        ValueError: a name is taken by the base.
    """

    added: Mapping[str, RewardTerm]
    base: Rewards = field(default_factory=RewardWeights)

    def __post_init__(self) -> None:
        base = self.base
        while isinstance(base, AddedTerms):
            self._refuse(base.added)
            base = base.base
        if isinstance(base, RewardWeights):
            self._refuse(each.name for each in fields(RewardWeights))

    def terms(self, tick: Tick) -> dict[str, float]:
        """The terms of the base and the added ones."""
        terms = self.base.terms(tick)
        self._refuse(terms)
        return terms | {name: term(tick) for name, term in self.added.items()}

    def _refuse(self, names: Iterable[str]) -> None:
        if taken := self.added.keys() & set(names):
            raise ValueError(f"reward terms {sorted(taken)} exist already; choose other names")
