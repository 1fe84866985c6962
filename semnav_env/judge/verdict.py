"""Verdicts of the judge on clauses and commands."""

from __future__ import annotations

from enum import StrEnum
from functools import lru_cache


class Verdict(StrEnum):
    """The verdict on a clause or a command; it is printed as a plain word, also within a tuple."""

    __repr__ = str.__repr__

    PENDING = "pending"
    ACTIVE = "active"
    DONE = "done"
    SKIPPED = "skipped"
    WRONG_DOOR = "wrong door"
    WRONG_TURN = "wrong turn"
    STOPPED_SHORT = "stopped short"
    INCOMPLETE = "incomplete"
    OUT_OF_TIME = "out of time"


FAILURES = (
    *(Verdict.WRONG_DOOR, Verdict.WRONG_TURN, Verdict.STOPPED_SHORT),
    *(Verdict.INCOMPLETE, Verdict.OUT_OF_TIME),
)
"""Verdicts that end an episode without success."""


@lru_cache(maxsize=256)
def verdicts(
    clauses: int, active: int, failure: Verdict | None, skipped: frozenset[int] = frozenset()
) -> tuple[Verdict, ...]:
    """One verdict for each clause: done or skipped, then that of the active clause, then pending.

    A failure in the same step that carries out the last clause is the verdict on that clause.

    Args:
        clauses: number of clauses.
        active: index of the active clause; `clauses` when none is left.
        failure: failure of the command, if it failed.
        skipped: indices of the clauses that a condition ruled out.
    """
    found = [Verdict.DONE] * active + [Verdict.ACTIVE] + [Verdict.PENDING] * (clauses - active - 1)
    found = [Verdict.SKIPPED if i in skipped else v for i, v in enumerate(found[:clauses])]
    if failure is not None:
        found[max(i for i in range(clauses) if i <= active and i not in skipped)] = failure
    return tuple(found)
