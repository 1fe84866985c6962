"""Says once what a speaker says twice: "to the end, to the last door"."""

from __future__ import annotations

from dataclasses import replace

from semnav_env.commands.clauses import (
    Approach,
    Clause,
    Follow,
    GoToDoor,
    GoToRoom,
    IfThere,
)
from semnav_env.commands.command import Command
from semnav_env.commands.references import LAST, DoorReference, Place, PlaceReference, RoomReference

_END = Follow(PlaceReference(Place.END))


def told_once(command: Command) -> Command:
    """A command without clauses that say again what the one before them says.

    What depends on a condition is left as it is.
    """
    found: list[Clause] = []
    for number, clause in enumerate(command.clauses, 1):
        after_condition = any(isinstance(each, IfThere) for each in found)
        ends = number == len(command.clauses)
        merged = None if after_condition or not found else _merged(found[-1], clause, ends)
        if merged is None:
            found.append(clause)
        else:
            found[-1:] = merged
    return Command(tuple(found))


def _merged(before: Clause, clause: Clause, ends: bool) -> list[Clause] | None:
    """What two clauses say together, if the second one adds only how or where; else None.

    Args:
        before: the first one.
        clause: the second one.
        ends: nothing comes behind it.
    """
    match before, clause:
        case Follow(PlaceReference() as place, False), Follow(same) if place == same and (
            clause == _END or clause.past
        ):
            return [clause]
        case Follow(PlaceReference(Place.INTERSECTION)), Follow(None) if not ends and not before.past:
            return [replace(before, past=True)]
        case Follow(PlaceReference(Place.END)), GoToDoor(DoorReference(ordinal)) if ordinal == LAST:
            return [clause]
        case GoToDoor(_, Approach.TO | Approach.THROUGH), GoToDoor(
            DoorReference(1, None) as door, Approach.IN
        ) if before.door != door:
            return [replace(before, approach=Approach.IN)]
        case GoToDoor(door, Approach.TO), GoToDoor(same, Approach.TO) if door == same:
            return [clause]
        case Follow(RoomReference(), _), Follow() if before == clause:
            return [clause]
        case GoToRoom(name), GoToRoom(same) if name == same:
            return [clause]
        case GoToRoom(name, Approach.THROUGH), Follow(RoomReference(same), True) if name == same:
            return [clause]
        case GoToRoom(), GoToDoor(DoorReference(1, None), Approach.TO):
            return [replace(before, approach=Approach.TO)]
        case GoToRoom(), IfThere(DoorReference(1)):
            return [replace(before, approach=Approach.TO), clause]
    return None
