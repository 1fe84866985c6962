"""What hangs on a condition, and whether the condition is met."""

from __future__ import annotations

from collections.abc import Sequence

from semnav_env.commands.clauses import Clause, IfThere, Turn
from semnav_env.commands.references import OTHER, DoorReference, Place, PlaceReference, Side
from semnav_env.grounding.doors import doors_named
from semnav_env.grounding.goal import Goal
from semnav_env.grounding.junctions import junctions_ahead
from semnav_env.grounding.opposite import OF_ONE, doors_opposite
from semnav_env.grounding.situation import Situation


def is_met(condition: IfThere, situation: Situation) -> bool | Goal:
    """Whether a condition is met, or the goal of looking for what it speaks of.

    What is there is known as soon as it is seen; that nothing is there, at the end of the corridor,
    or where there can be no more.
    """
    situation = situation.towards(condition.what)
    if isinstance(condition.what, DoorReference) and condition.what.side is Side.OPPOSITE:
        found = doors_opposite(condition.what, situation)
        if not isinstance(found, dict):
            return found
        return (bool(found) and condition.what.ordinal in OF_ONE) is not condition.absent
    (count, more), wanted = _count(condition.what, situation), condition.what.ordinal
    from_start, all_known = wanted > OTHER, situation.seen_to_end or not more
    if (from_start or all_known) and count >= max(1, abs(wanted)):
        there = wanted != OTHER or count == 1
    elif all_known:
        there = False
    else:
        return situation.seek(condition.what)
    return there is not condition.absent


def _count(what: DoorReference | PlaceReference, situation: Situation) -> tuple[int, bool]:
    """How many of the kind have been seen so far, and whether there may be more farther on."""
    if isinstance(what, DoorReference):
        doors, more = doors_named(what, situation)
        return len(doors), more
    if what.place is Place.END:
        return int(situation.seen_to_end), True
    return len(junctions_ahead(situation.corridor, what.place)), True


def after(clauses: Sequence[Clause], index: int, met: bool | None = None) -> int:
    """The index of the clause to do after this one; beyond the end if there is none.

    Args:
        clauses: of the command.
        index: of the clause that is done with, or of the condition that is decided.
        met: how the condition was decided; None for another clause.
    """
    clause = clauses[index]
    if isinstance(clause, IfThere):
        return index + 1 if met else index + 2
    condition = clauses[index - 1] if index else None
    skips = isinstance(condition, IfThere) and condition.otherwise
    return index + (2 if skips else 1)


def in_context(clauses: Sequence[Clause], index: int) -> Clause:
    """A clause as the one before has it: who sees an intersection and turns left, does so there."""
    before = clauses[index - 1] if index else None
    match before, clauses[index]:
        case IfThere(PlaceReference() as at, absent=False), Turn(turning, None, None):
            return Turn(turning, at)
    return clauses[index]


def hangs_on_condition(clauses: Sequence[Clause], index: int) -> bool:
    """Whether a clause is one of the two that a condition chooses from."""
    then = index > 0 and isinstance(clauses[index - 1], IfThere)
    condition = clauses[index - 2] if index > 1 else None
    return then or (isinstance(condition, IfThere) and condition.otherwise)
