"""What can become of a clause."""

from __future__ import annotations

from enum import StrEnum
from functools import lru_cache


class Verdict(StrEnum):
    """What became of a clause or of a command."""

    PENDING = "pending"
    ACTIVE = "active"
    DONE = "done"
    WRONG_DOOR = "wrong door"
    WRONG_TURN = "wrong turn"
    STOPPED_SHORT = "stopped short"
    OUT_OF_TIME = "out of time"


FAILURES = (Verdict.WRONG_DOOR, Verdict.WRONG_TURN, Verdict.STOPPED_SHORT, Verdict.OUT_OF_TIME)


@lru_cache(maxsize=256)
def verdicts(clauses: int, active: int, failure: Verdict | None) -> tuple[Verdict, ...]:
    """Done, then what became of the active clause, then pending.

    A failure in the very step that carries out the last clause is that clause's.
    """
    if failure is not None:
        active = min(active, clauses - 1)
    rest = clauses - active - 1
    done = (Verdict.DONE,) * active
    return done if rest < 0 else (*done, failure or Verdict.ACTIVE, *(Verdict.PENDING,) * rest)
