"""The order in which the clauses of a command are done, and how one clause completes the next."""

from __future__ import annotations

from collections.abc import Container, Sequence
from dataclasses import replace

from semnav_env.language.clauses import (
    Clause,
    Follow,
    GoToDoor,
    IfThere,
    Pace,
    Speed,
    Turn,
    Turning,
)
from semnav_env.language.references import SOME, Distance, PlaceReference, Side


def after(clauses: Sequence[Clause], index: int, met: bool | None = None) -> int:
    """Index of the clause after this one; beyond the end if there is none.

    Args:
        clauses: the clauses of the command.
        index: index of the clause that is done, or of the condition that is decided.
        met: how the condition was decided; None for another clause.
    """
    clause = clauses[index]
    if isinstance(clause, IfThere):
        return index + 1 + (0 if met else clause.then)
    at = _condition_over(clauses, index)
    if at is None:
        return index + 1
    match clauses[at]:
        case IfThere(otherwise=otherwise, then=then) if index == at + then:
            return index + 1 + otherwise
    return index + 1


def in_context(clauses: Sequence[Clause], index: int) -> Clause:
    """The clause, completed by the one before it.

    A left turn after "if there is an intersection" is one at that intersection.
    """
    before = clauses[index - 1] if index else None
    match before, clauses[index]:
        case IfThere(PlaceReference() as at, absent=False), Turn(turning, None, None):
            return Turn(turning, at)
    return clauses[index]


def is_only_a_direction(clauses: Sequence[Clause], index: int) -> bool:
    """Whether a clause is "go down the hallway" or "go a bit" and the next one says where it ends.

    To turn around and to go so many metres does not end "go a bit".
    """
    clauses, index = _without_paces(clauses, index)
    clause = _anywhere_across(clauses[index])
    if clause not in (Follow(), Follow(SOME)) or index + 1 == len(clauses):
        return False
    if _case(clauses, index) != _case(clauses, index + 1):
        return False
    match clauses[index + 1]:
        case Turn(turning, _, degrees):
            around = turning is Turning.AROUND and clause == Follow(SOME)
            return degrees is None and not around
        case Follow(Distance()):
            return clause == Follow()
        case following:
            return isinstance(following, Follow | GoToDoor)


def comes_after_corridor(clauses: Sequence[Clause], index: int) -> bool:
    """Whether a turn without a place is made at the next place that allows it, and not on the spot.

    This is so after "go down the hallway" and after "go past the second door".
    """
    clauses, index = _without_paces(clauses, index)
    if index == 0 or _case(clauses, index - 1) != _case(clauses, index):
        return False  # what hangs on a condition may not have been done
    before, clause = clauses[index - 1 : index + 1]
    aside = isinstance(clause, Turn) and clause.turning is not Turning.AROUND
    passed = isinstance(before, Follow) and before.past and aside
    return passed or is_only_a_direction(clauses, index - 1)


def _case(clauses: Sequence[Clause], index: int) -> bool | None:
    """The case of a condition for which a clause is; None if it depends on none."""
    at = _condition_over(clauses, index)
    condition = None if at is None else clauses[at]
    return index <= (at or 0) + condition.then if isinstance(condition, IfThere) else None


def _condition_over(clauses: Sequence[Clause], index: int) -> int | None:
    """Index of the condition on which a clause depends; None if there is none."""
    for at in range(min(index, len(clauses)) - 1, -1, -1):
        before = clauses[at]
        if isinstance(before, IfThere):
            return at if index <= at + before.then + before.otherwise else None
    return None


def wall_beside(clauses: Sequence[Clause], index: int) -> Side | None:
    """The side along whose wall a clause is carried out, said in it or in the direction before."""
    clauses, index = _without_paces(clauses, index)
    if index and is_only_a_direction(clauses, index - 1):
        said = wall_beside(clauses, index - 1)
    else:
        said = None
    clause = clauses[index]
    return (clause.along if isinstance(clause, Follow) else None) or said


def pace_at(clauses: Sequence[Clause], index: int, skipped: Container[int]) -> Speed | None:
    """The pace at a clause: the last one that was said before it and not ruled out."""
    said = [
        clause.speed
        for k, clause in enumerate(clauses[:index])
        if isinstance(clause, Pace) and k not in skipped
    ]
    return said[-1] if said else None


def _without_paces(clauses: Sequence[Clause], index: int) -> tuple[Sequence[Clause], int]:
    """The clauses but those that say a pace in any case, and the index among them of a clause.

    They stand between clauses that complete each other: "go down the hallway, slowly, turn left".
    """
    if not any(isinstance(clause, Pace) for clause in clauses):
        return clauses, index
    kept = [
        k
        for k, clause in enumerate(clauses)
        if k == index or not isinstance(clause, Pace) or _case(clauses, k) is not None
    ]
    return [clauses[k] for k in kept], kept.index(index)


def _anywhere_across(clause: Clause) -> Clause:
    """The clause without the wall along which to keep."""
    return replace(clause, along=None) if isinstance(clause, Follow) and clause.along else clause
