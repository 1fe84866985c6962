"""Clauses that are defined outside this package."""

from __future__ import annotations

from abc import abstractmethod

from semnav_env.language.own_clause import OwnClause
from semnav_env.mind.grounding.goal import Goal
from semnav_env.mind.grounding.situation import Situation


class GroundedClause(OwnClause):
    """A clause of your own, which makes its own goal; derive a frozen dataclass from it.

    Robot and judge call the same object, the robot with its remembered scene and the judge with
    the floor plan, so `goal` may depend only on the situation.
    """

    __slots__ = ()

    @abstractmethod
    def goal(self, situation: Situation) -> Goal:
        """The goal of the clause, in the frame of the situation's scene.

        Raises:
            GroundingError: the clause cannot be carried out there; says why.
        """
