"""Implicit steps: a robot in a room leaves it before it counts the doors of the corridor.

MacMahon, Stankiewicz and Kuipers, "Walk the Talk" (AAAI 2006), infer such actions from what route
instructions leave out.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

from semnav_env.language import (
    MAX_CLAUSES,
    Approach,
    Clause,
    Command,
    DoorReference,
    Follow,
    GoToDoor,
    GoToRoom,
    Leave,
    Pace,
    Side,
    Turn,
    Turning,
)
from semnav_env.language.command import reference_of
from semnav_env.mind.grounding import UnclearError

Feasible = Callable[[Command], bool]


def with_implicit_steps(command: Command, feasible: Feasible, *, in_room: bool) -> Command:
    """Add the implicit steps to a command that cannot be carried out without them.

    The robot leaves the room in which it is, or into which a clause has led it, and turns to the
    side that the next clause names. If this clause names no side, the robot turns to the only side
    on which the clause can be carried out.

    Args:
        command: as it was said.
        feasible: whether a command can be carried out.
        in_room: whether the robot begins in a room.

    Raises:
        UnclearError: it can be carried out on both sides; says so.
    """
    if feasible(command):
        return command
    for index in _places_to_leave(command, in_room):
        fuller = [c for c in _leaving(command, index) if feasible(c)]
        if len(fuller) > 1:
            ways = " or ".join(f'"{each}"' for each in fuller)
            raise UnclearError(f"from inside the room this can mean {ways}; say which")
        if fuller:
            return fuller[0]
    return command


def _places_to_leave(command: Command, in_room: bool) -> Iterator[int]:
    """The clauses before which the robot is in a room."""
    before: Clause | None = None
    for index, clause in enumerate(command.clauses):
        if isinstance(clause, Pace):
            continue
        entered = isinstance(before, GoToRoom) or (
            isinstance(before, GoToDoor) and before.approach is Approach.THROUGH
        )
        begins = entered or (in_room and before is None)
        if begins and isinstance(clause, Follow | Turn | GoToDoor):
            yield index
        before = clause


def _leaving(command: Command, index: int) -> Iterator[Command]:
    """The command with the room left before a clause, for each side to turn to then."""
    clauses = command.clauses
    for turns in _turns(clauses[index]):
        fuller = (*clauses[:index], Leave(), *turns, *clauses[index:])
        if len(fuller) <= MAX_CLAUSES:
            yield Command(fuller)


def _turns(clause: Clause) -> tuple[tuple[Turn, ...], ...]:
    """The ways to turn outside before a clause."""
    left, right = (Turn(Turning.LEFT),), (Turn(Turning.RIGHT),)
    reference = reference_of(clause)
    side = reference.side if isinstance(reference, DoorReference) else None
    if side is Side.LEFT:
        return (left,)
    if side is Side.RIGHT:
        return (right,)
    return ((),) if side is not None else (left, right)
