"""Clauses that are defined outside this package."""

from __future__ import annotations

from abc import abstractmethod

from semnav_env.language.own_clause import OwnClause
from semnav_env.mind.grounding.goal import Goal
from semnav_env.mind.grounding.situation import Situation


class GroundedClause(OwnClause):
    """A clause of one's own, which says itself where it leads; derive a frozen dataclass.

    Robot and judge ask the same object, the robot in what it remembers and the judge in the floor
    plan, so `goal` depends on nothing but the situation.
    """

    __slots__ = ()

    @abstractmethod
    def goal(self, situation: Situation) -> Goal:
        """Where the clause leads, in the frame of the situation's scene.

        Raises:
            GroundingError: it cannot be carried out there; says why.
        """
