"""Clauses that are defined outside this package."""

from __future__ import annotations

import inspect
from abc import ABC, abstractmethod

from semnav_env.language.clause_kinds import CLAUSE_KINDS
from semnav_env.language.clauses import Clause
from semnav_env.language.declarations import said_in_english


class OwnClause(Clause, ABC):
    """Base of clauses that are defined outside this package, see docs/guides/extending.md.

    `semnav_env.mind.grounding.GroundedClause` derives from it and adds where a clause leads. The
    reader has no words for such a clause: a command with it is given as a `Command`.
    """

    __slots__ = ()

    def __init_subclass__(cls, **kwargs: object) -> None:
        super().__init_subclass__(**kwargs)
        if cls.__name__ in CLAUSE_KINDS:
            raise TypeError(f"{cls.__name__} is a clause of this package; give yours another name")

    @property
    @abstractmethod
    def stand_in(self) -> Clause:
        """The clause of this package that a learner sees in its place, as its token."""

    def __str__(self) -> str:
        return said_in_english(self)  # not kept, as it may have no hash


def own_clause_kinds() -> dict[str, type[OwnClause]]:
    """The clauses from outside that can be made, by their names; the latest of a name."""
    found, waiting = {}, OwnClause.__subclasses__()
    while waiting:
        kind = waiting.pop(0)
        waiting += kind.__subclasses__()
        if not inspect.isabstract(kind):
            found[kind.__name__] = kind
    return found
