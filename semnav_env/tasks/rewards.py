"""Rewards as named terms; the reward of a step is their weighted sum."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple


@dataclass(frozen=True)
class RewardWeights:
    """What each term is worth.

    Attributes:
        progress: per metre by which the shortest way to the active clause's goal gets shorter.
        clause: for each clause carried out.
        success: once, for the whole command.
        failure: once, for a wrong door, a wrong turn or stopping short.
        contact: per step in contact.
        time: per step.
    """

    progress: float = 1.0
    clause: float = 2.0
    success: float = 10.0
    failure: float = -5.0
    contact: float = -0.1
    time: float = -0.01

    def apply(self, terms: RewardTerms) -> dict[str, float]:
        """Each term times its weight, by name."""
        progress, clause, success, failure, contact = terms
        return {
            "progress": self.progress * progress,
            "clause": self.clause * clause,
            "success": self.success * success,
            "failure": self.failure * failure,
            "contact": self.contact * contact,
            "time": self.time,
        }


class RewardTerms(NamedTuple):
    """One step before weighting; see `RewardWeights` for the meaning of each term."""

    progress: float
    clause: float
    success: float
    failure: float
    contact: float
