"""Corrections of the clause before: "no, the left one"."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from semnav_env.commands.clause_readings import Correction
from semnav_env.commands.clauses import Clause, Follow, GoToDoor, Turn, Turning
from semnav_env.commands.command import reference_of
from semnav_env.commands.references import DoorReference, PlaceReference, Side


def corrected(before: Clause, correction: Correction) -> Clause:
    """The clause that a correction makes of the one before it.

    Raises:
        ValueError: that clause has no ordinal or side that could be corrected.
    """
    if correction.clause is not None:
        return correction.clause
    reference = reference_of(before)
    turns_aside = isinstance(before, Turn) and before.turning is not Turning.AROUND
    corrects_turn = turns_aside and correction.side in (Side.LEFT, Side.RIGHT)
    if correction.ordinal is not None and reference is None:
        raise ValueError("nothing before it has a number to correct; say again what to do")
    if (
        correction.side is not None
        and not corrects_turn
        and not isinstance(reference, DoorReference)
    ):
        raise ValueError("no door or turn before it has a side to correct; say again what to do")
    changed: Any = before
    if reference is not None:
        changed = _with_referent(before, _corrected_referent(reference, correction))
    if corrects_turn and correction.side is not None:
        changed = replace(changed, turning=Turning(correction.side.value))
    return changed  # type: ignore[no-any-return]


def _corrected_referent(
    reference: DoorReference | PlaceReference, correction: Correction
) -> DoorReference | PlaceReference:
    ordinal = reference.ordinal if correction.ordinal is None else correction.ordinal
    if isinstance(reference, PlaceReference):
        return replace(reference, ordinal=ordinal)
    return DoorReference(ordinal, correction.side or reference.side)


def _with_referent(clause: Any, reference: DoorReference | PlaceReference) -> Any:
    names: dict[type, str] = {GoToDoor: "door", Follow: "until", Turn: "at"}
    return replace(clause, **{names[type(clause)]: reference})
