"""Names of the doors and junctions of a corridor by the rules of reference."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from semnav_env.language import (
    MAX_FROM_END,
    MAX_ORDINAL,
    DoorReference,
    Place,
    PlaceReference,
    Turning,
)
from semnav_env.mind.grounding.counted_doors import CountedDoor
from semnav_env.mind.grounding.junctions import junctions_ahead
from semnav_features.corridor import Corridor, Junction

JUNCTION_KINDS = (Place.CORNER, Place.T_JUNCTION, Place.INTERSECTION, Place.TURNING, Place.END)
"""Words for a junction, the simplest word first."""


def names_of_door(target: CountedDoor, doors: Sequence[CountedDoor]) -> Iterator[DoorReference]:
    """The names of a door among the doors of a corridor.

    The side is left out only where it makes no difference: where the door has the same number on
    its side as among all doors.
    """
    beside = [door for door in doors if door.side is target.side]
    own, of_all = (
        _ordinals(beside.index(target), len(beside)),
        _ordinals(doors.index(target), len(doors)),
    )
    for ordinal, among_all in zip(own, of_all, strict=True):
        if ordinal == among_all and _can_be_said(ordinal):
            yield DoorReference(ordinal)
        if _can_be_said(ordinal):
            yield DoorReference(ordinal, target.side)


def names_of_junction(
    target: Junction, corridor: Corridor, turning: Turning | None = None
) -> Iterator[PlaceReference]:
    """The names of a junction of a corridor, for a turn to one side or for none."""
    for kind in JUNCTION_KINDS:
        junctions = junctions_ahead(corridor, kind, turning)
        if target not in junctions:
            continue
        for ordinal in _ordinals(junctions.index(target), len(junctions)):
            if ordinal == 1 or (kind is not Place.END and _can_be_said(ordinal)):
                yield PlaceReference(kind, ordinal)


def _ordinals(index: int, count: int) -> tuple[int, int]:
    """The ordinals of a thing counted from the start and from the end."""
    return index + 1, index - count


def _can_be_said(ordinal: int) -> bool:
    return -MAX_FROM_END <= ordinal <= MAX_ORDINAL
