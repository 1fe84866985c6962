"""Corrections: "no, the left one"."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from semnav_env.commands.clauses import Clause, Follow, GoToDoor, Turn, Turning
from semnav_env.commands.command import reference_of
from semnav_env.commands.parts import Instead
from semnav_env.commands.references import DoorReference, PlaceReference, Side


def amended(before: Clause, instead: Instead) -> Clause:
    """The clause that a correction makes of the one before it.

    Raises:
        ValueError: that has nothing of the kind to correct.
    """
    if instead.clause is not None:
        return instead.clause
    reference = reference_of(before)
    turned = isinstance(before, Turn) and before.turning is not Turning.AROUND
    turning = turned and instead.side in (Side.LEFT, Side.RIGHT)
    if instead.ordinal is not None and reference is None:
        raise ValueError("the corrected number counts nothing; say again what to do")
    if instead.side is not None and not turning and not isinstance(reference, DoorReference):
        raise ValueError("the corrected side is of nothing; say again what to do")
    changed: Any = before
    if reference is not None:
        changed = _with(before, _renumbered(reference, instead))
    if turning and instead.side is not None:
        changed = replace(changed, turning=Turning(instead.side.value))
    return changed  # type: ignore[no-any-return]


def _renumbered(
    reference: DoorReference | PlaceReference, instead: Instead
) -> DoorReference | PlaceReference:
    ordinal = reference.ordinal if instead.ordinal is None else instead.ordinal
    if isinstance(reference, PlaceReference):
        return replace(reference, ordinal=ordinal)
    return DoorReference(ordinal, instead.side or reference.side)


def _with(clause: Any, reference: DoorReference | PlaceReference) -> Any:
    names: dict[type, str] = {GoToDoor: "door", Follow: "until", Turn: "at"}
    return replace(clause, **{names[type(clause)]: reference})
