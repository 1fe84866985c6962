"""Results of many robots while one action is held."""

from __future__ import annotations

from typing import Any

import numpy as np

from semnav_env.vector.rewards import Mask, Terms
from semnav_features.frames import FloatArray


class HeldAction:
    """Sums up the control periods for which an action holds.

    Args:
        driven: which robots are driven.

    Attributes:
        going: which robots are driven in the next control period: those whose episode is not over.
        rewards: sums over the control periods, shape (n,).
        terms: the same for each reward term.
        terminated: which episodes have terminated.
        truncated: which episodes are out of time.
        ends: final infos of the episodes that are over, by robot.
    """

    def __init__(self, driven: Mask) -> None:
        self.going = driven
        self.rewards = np.zeros(len(driven))
        self.terms: Terms = {}
        self.terminated, self.truncated = np.zeros((2, len(driven)), dtype=bool)
        self.ends: dict[int, dict[str, Any]] = {}

    def add(self, terms: Terms, terminated: Mask, truncated: Mask) -> None:
        """Count a control period.

        Args:
            terms: of the rewards of the robots that were driven.
            terminated: which episodes have terminated by now.
            truncated: which episodes are out of time by now.
        """
        total = np.zeros(len(self.rewards))
        for amount in terms.values():
            total += amount.filled(0.0) if isinstance(amount, np.ma.MaskedArray) else amount
        self.rewards += total
        if self.terms:
            terms = self.terms | {
                name: _added(self.terms[name], amount) if name in self.terms else amount
                for name, amount in terms.items()
            }
        self.terms = terms
        self.terminated |= terminated
        self.truncated |= truncated
        self.going = self.going & ~self.over

    @property
    def over(self) -> Mask:
        """Mask of the episodes that are terminated or truncated."""
        return self.terminated | self.truncated


def _added(one: FloatArray, other: FloatArray) -> FloatArray:
    """The sum of two amounts, of which one may be masked where there is none."""
    if not np.ma.isMaskedArray(one) and not np.ma.isMaskedArray(other):
        return one + other
    absent = np.ma.getmaskarray(one) & np.ma.getmaskarray(other)
    return np.ma.array(np.ma.filled(one, 0.0) + np.ma.filled(other, 0.0), mask=absent)
