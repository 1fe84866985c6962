"""Says once what a speaker says twice: "to the end, to the last door", "a bit, two metres"."""

from __future__ import annotations

from dataclasses import replace

from semnav_env.language.clauses import (
    Approach,
    Clause,
    Follow,
    GoToDoor,
    GoToRoom,
    IfThere,
)
from semnav_env.language.command import Command
from semnav_env.language.references import (
    LAST,
    SOME,
    Distance,
    DoorReference,
    Place,
    PlaceReference,
)

_END = Follow(PlaceReference(Place.END))


def told_once(command: Command) -> Command:
    """A command without clauses that say again what the one before them says.

    What depends on a condition is left as it is.
    """
    found: list[Clause] = []
    for clause in command.clauses:
        after_condition = any(isinstance(each, IfThere) for each in found)
        merged = None if after_condition or not found else _merged(found[-1], clause)
        if merged is None:
            found.append(clause)
        else:
            found[-1:] = merged
    return Command(tuple(found))


def _merged(before: Clause, clause: Clause) -> list[Clause] | None:
    """What two clauses say together, if the second one adds only how or where; else None."""
    match before, clause:
        case Follow(PlaceReference() as place, False), Follow(same) if place == same and (
            clause == _END or clause.past
        ):
            return [clause]
        case Follow(Distance() as first), Follow(Distance()) if first == SOME:
            return [clause]
        case Follow(PlaceReference(Place.END)), GoToDoor(DoorReference(ordinal)) if ordinal == LAST:
            return [clause]
        case GoToDoor(_, Approach.TO | Approach.THROUGH), GoToDoor(
            DoorReference(1, None) as door, Approach.IN
        ) if before.door != door:
            return [replace(before, approach=Approach.IN)]
        case GoToDoor(door, Approach.TO), GoToDoor(same, Approach.TO) if door == same:
            return [clause]
        case GoToRoom(), GoToDoor(DoorReference(1, None), Approach.TO):
            return [replace(before, approach=Approach.TO)]
        case GoToRoom(), IfThere(DoorReference(1)):
            return [replace(before, approach=Approach.TO), clause]
    return None
