"""All that a text can mean: from clauses with several readings to commands."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise, product
from typing import Any

from semnav_env.commands.clauses import Approach, Clause, Follow, GoToDoor
from semnav_env.commands.command import Command, may_count_on, reference_of
from semnav_env.commands.parts import EnterIt, Found, OnThatSide
from semnav_env.commands.references import DoorReference

MAX_READINGS = 16
"""More ways to take a command than this are not told apart."""

Program = list[tuple[Clause, bool]]
"""Clauses, each with whether it says that counting begins anew."""


class TooAmbiguousError(ValueError):
    """A text has more readings than `MAX_READINGS`."""


class NoDoorSpokenOfError(ValueError):
    """One is to go in where no door has been spoken of."""

    def __init__(self, index: int) -> None:
        super().__init__("into what? name the door")
        self.index = index


def commands_of(found: Sequence[Found]) -> tuple[Command, ...]:
    """Every command that these clauses can be, each once.

    Raises:
        NoDoorSpokenOfError: "go in" without a door before it.
        TooAmbiguousError: too many readings.
    """
    _check_number(math.prod(len(each.readings) for each in found))
    programs = [_program(found, choice) for choice in product(*(f.readings for f in found))]
    counted = [clauses for program in programs if program for clauses in _countings(program)]
    if len(counted) > MAX_READINGS:
        raise TooAmbiguousError(
            f"the command can be taken in {len(counted)} ways; say it in other words"
        )
    return tuple(dict.fromkeys(Command(clauses) for clauses in counted))


def _check_number(ways: int) -> None:
    if ways > MAX_READINGS:
        raise TooAmbiguousError(f"the command can be taken in {ways} ways; say it in other words")


def _program(found: Sequence[Found], choice: Sequence[Any]) -> Program:
    """The clauses of one reading; none if it gives a side to no door."""
    program: Program = []
    for index, (each, steps) in enumerate(zip(found, choice, strict=True)):
        for number, step in enumerate(steps):
            if isinstance(step, EnterIt):
                program[-1:] = [_entered(program, index)]
            elif isinstance(step, OnThatSide):
                before = program[-1][0] if program else None
                if not isinstance(before, GoToDoor) or before.door.side is not None:
                    return []
                door = replace(before.door, side=step.side)
                program[-1:] = [(replace(before, door=door), program[-1][1])]
            else:
                program.append((step, each.anew and number == 0))
    return program


def _entered(program: Program, index: int) -> tuple[Clause, bool]:
    """The last clause of a program, taken through the door that it leads to."""
    before, anew = program[-1] if program else (None, False)
    past = isinstance(before, Follow) and before.past
    door = None if before is None else reference_of(before)
    if past or not isinstance(door, DoorReference):
        raise NoDoorSpokenOfError(index)
    return GoToDoor(door, Approach.THROUGH), anew


def _countings(program: Program) -> list[tuple[Clause, ...]]:
    """The program, counted anew and counted on where it does not say which."""
    ways: list[tuple[Clause, ...]] = [(program[0][0],)]
    for (before, _), (clause, anew) in pairwise(program):
        nexts = [clause]
        if may_count_on(before, clause) and not anew:
            nexts.append(_counted_on(before, clause))
        ways = [(*way, each) for way in ways for each in nexts]
    return ways


def _counted_on(before: Clause, clause: Clause) -> Clause:
    first, second = reference_of(before), reference_of(clause)
    assert first is not None
    assert second is not None
    reference: Any = replace(second, ordinal=second.ordinal - first.ordinal)
    name = {GoToDoor: "door", Follow: "until"}.get(type(clause), "at")
    changed: Any = replace(clause, **{name: reference})
    return changed  # type: ignore[no-any-return]
