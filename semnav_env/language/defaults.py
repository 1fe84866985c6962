"""What goes without saying: a door that is only named at the end of a command is gone through."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from semnav_env.language.clauses import Approach, Clause, GoToDoor, Pace, Stop
from semnav_env.language.command import Command, Link, links_of


def decided(readings: Sequence[Command]) -> tuple[Command, ...]:
    """The readings of a text, with one of those that differ in how the last door is approached.

    "The second door" can mean to go to it or through it. The robot goes through it, or to it if a
    stop follows. A door before other clauses is often a remark ("the left door is not the one,
    ..."), so nothing is decided about it.
    """
    alike: dict[tuple[Clause, ...], list[Command]] = {}
    for command in readings:
        alike.setdefault(_approached(command, Approach.THROUGH).clauses, []).append(command)
    return tuple(group[0] if len(group) == 1 else _by_default(group[0]) for group in alike.values())


def _by_default(command: Command) -> Command:
    """The command with its last door approached as it goes without saying."""
    end = _end(command)
    stops = Link.NEXT in links_of(command.clauses)[end + 1 :]
    return _approached(command, Approach.TO if stops else Approach.THROUGH, by_default=not stops)


def _approached(command: Command, approach: Approach, by_default: bool = False) -> Command:
    """The command with its last door approached in a way, unless it stops in that doorway."""
    end = _end(command)
    clause = command.clauses[end]
    if not isinstance(clause, GoToDoor) or clause.approach is Approach.IN:
        return command
    last = replace(clause, approach=approach, by_default=by_default)
    return Command((*command.clauses[:end], last, *command.clauses[end + 1 :]))


def _end(command: Command) -> int:
    """Which clause is the last that does more than to stop; the first if none does."""
    still = Stop | Pace
    moving = [at for at, clause in enumerate(command.clauses) if not isinstance(clause, still)]
    return moving[-1] if moving else 0
