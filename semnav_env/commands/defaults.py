"""What goes without saying: a door that is only named is gone through."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import replace
from typing import TypeVar

from semnav_env.commands.clauses import Approach, Clause, GoToDoor, Stop
from semnav_env.commands.command import Command
from semnav_env.commands.references import DoorReference

ClauseOrMark = TypeVar("ClauseOrMark")
"""A clause, or another step of a reading, which is left as it is."""


def decided(readings: Sequence[Command]) -> tuple[Command, ...]:
    """The readings of a text, with one of those that differ only in how a door is approached.

    "The second door" can mean to go to it or through it. The robot goes through it, unless the
    clause behind it is to stop. Nothing is decided if that clause may name the same door again:
    "there is a door on the left, that is the one to go through".
    """
    alike: defaultdict[tuple[Clause, ...], list[Command]] = defaultdict(list)
    for command in readings:
        alike[tuple(map(through, command.clauses))].append(command)
    return tuple(command for group in alike.values() for command in _decided(group))


def through(clause: ClauseOrMark) -> ClauseOrMark:
    """The clause with its door gone through instead of up to."""
    if isinstance(clause, GoToDoor) and clause.approach is Approach.TO:
        return replace(clause, approach=Approach.THROUGH)
    return clause


def _decided(group: Sequence[Command]) -> Sequence[Command]:
    """The reading that goes without saying; all of them if none does."""
    if len(group) == 1:
        return group
    columns = [set(column) for column in zip(*(each.clauses for each in group), strict=True)]
    clauses = list(group[0].clauses)
    for at, choices in enumerate(columns):
        if len(choices) == 1:
            continue
        following = columns[at + 1] if at + 1 < len(columns) else set()
        if _may_be_same_door(group[0].clauses[at], following):
            return group
        stops = any(isinstance(clause, Stop) for clause in following)
        clauses[at] = _approached(clauses[at], to_it=stops)
    command = Command(tuple(clauses))
    return (command,) if command in group else group


def _may_be_same_door(clause: Clause, following: set[Clause]) -> bool:
    """Whether the next clause says to go through a door that may be the one named here."""
    if len(following) != 1 or not isinstance(clause, GoToDoor):
        return False  # at the end, or named without a verb itself
    (after,) = following
    nearest = (DoorReference(), DoorReference(1, clause.door.side), clause.door)
    return isinstance(after, GoToDoor) and after.door in nearest


def _approached(clause: Clause, *, to_it: bool) -> Clause:
    assert isinstance(clause, GoToDoor)
    approach = Approach.TO if to_it else Approach.THROUGH
    return replace(clause, approach=approach, by_default=not to_it)
