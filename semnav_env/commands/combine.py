"""All that a text can mean: from clauses with several readings to commands."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise, product
from typing import Any, NamedTuple

from semnav_env.commands.amend import amended
from semnav_env.commands.clauses import Approach, Clause, Follow, GoToDoor, IfThere
from semnav_env.commands.command import Command, Link, links_of, may_count_on, reference_of
from semnav_env.commands.parts import EnterIt, Found, Instead, OnThatSide, Otherwise
from semnav_env.commands.references import DoorReference

MAX_READINGS = 16
"""More ways to take a command than this are not told apart."""


class Said(NamedTuple):
    """A clause, and whether it was said that counting begins anew, and that it is for any case."""

    clause: Clause
    anew: bool = False
    in_any_case: bool = False


Program = list[Said]


class TooAmbiguousError(ValueError):
    """A text has more readings than `MAX_READINGS`."""


class OutOfPlaceError(ValueError):
    """Something speaks of what was not said before it: "go in" without a door."""

    def __init__(self, problem: str, index: int) -> None:
        super().__init__(problem)
        self.index = index


def commands_of(found: Sequence[Found]) -> tuple[Command, ...]:
    """Every command that these clauses can be, each once.

    Raises:
        OutOfPlaceError: "go in" without a door before it, and the like.
        TooAmbiguousError: too many readings.
    """
    _check_number(math.prod(len(each.readings) for each in found))
    programs = [_program(found, choice) for choice in product(*(f.readings for f in found))]
    _check_conditions(programs, found)
    counted = [clauses for program in programs if program for clauses in _countings(program)]
    if len(counted) > MAX_READINGS:
        raise TooAmbiguousError(
            f"the command can be taken in {len(counted)} ways; say it in other words"
        )
    return tuple(dict.fromkeys(Command(clauses) for clauses in counted))


def _check_conditions(programs: Sequence[Program], found: Sequence[Found]) -> None:
    """Refuse a program in which it is not clear what hangs on a condition."""
    for program in programs:
        links = links_of([said.clause for said in program])
        for said, link in zip(program, links, strict=True):
            if said.in_any_case is not (link is Link.IN_ANY_CASE):
                after = link is Link.IN_ANY_CASE
                problem = 'does this hang on the condition? say "in any case" if not'
                raise OutOfPlaceError(
                    problem if after else "in any case? there is no condition", len(found) - 1
                )


def _check_number(ways: int) -> None:
    if ways > MAX_READINGS:
        raise TooAmbiguousError(f"the command can be taken in {ways} ways; say it in other words")


def _program(found: Sequence[Found], choice: Sequence[Any]) -> Program:
    """The clauses of one reading; none if it gives a side to no door.

    Raises:
        OutOfPlaceError: something has nothing before it to speak of.
    """
    program: Program = []
    for index, (each, steps) in enumerate(zip(found, choice, strict=True)):
        for number, step in enumerate(steps):
            before = program[-1].clause if program else None
            match step:
                case EnterIt():
                    _enter(program, index)
                case OnThatSide(side):
                    if not isinstance(before, GoToDoor) or before.door.side is not None:
                        return []
                    door = replace(before.door, side=side)
                    program[-1] = program[-1]._replace(clause=replace(before, door=door))
                case Otherwise():
                    _open_condition(program, index)
                case Instead():
                    program[-1:] = [Said(_amended(before, step, index))]
                case _:
                    first = number == 0
                    program.append(Said(step, each.anew and first, each.in_any_case and first))
    return program


def _amended(before: Clause | None, instead: Instead, index: int) -> Clause:
    if before is None:
        raise OutOfPlaceError("there is nothing before it to be corrected", index)
    try:
        return amended(before, instead)
    except ValueError as error:
        raise OutOfPlaceError(str(error), index) from None


def _open_condition(program: Program, index: int) -> None:
    """Note that the condition before has an otherwise."""
    condition = program[-2].clause if len(program) > 1 else None
    if not isinstance(condition, IfThere) or condition.otherwise:
        raise OutOfPlaceError("otherwise than what? begin with a condition", index)
    program[-2] = program[-2]._replace(clause=replace(condition, otherwise=True))


def _enter(program: Program, index: int) -> None:
    """Go through the door that the last clause leads to, or that its condition speaks of."""
    before = program[-1].clause if program else None
    entered = _entered(before, index)
    if isinstance(before, IfThere):
        program.append(Said(entered))
    else:
        program[-1] = program[-1]._replace(clause=entered)


def _entered(before: Clause | None, index: int) -> Clause:
    """The clause before, taken through the door that it leads to."""
    past = isinstance(before, Follow) and before.past
    door = None if before is None else reference_of(before)
    if past or not isinstance(door, DoorReference):
        raise OutOfPlaceError("into what? name the door", index)
    return GoToDoor(door, Approach.THROUGH)


def _countings(program: Program) -> list[tuple[Clause, ...]]:
    """The program, counted anew and counted on where it does not say which."""
    ways: list[tuple[Clause, ...]] = [(program[0].clause,)]
    links = links_of([said.clause for said in program])
    for (before, said), link in zip(pairwise(program), links[1:], strict=True):
        nexts, first = [said.clause], before.clause
        if link is Link.NEXT and may_count_on(first, said.clause) and not said.anew:
            nexts.append(_counted_on(first, said.clause))
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
