"""One reading of a command: its clauses in order, with all marks applied to them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple, TypeAlias

from semnav_env.commands.clause_readings import (
    ClauseReadings,
    Correction,
    EnterMentionedDoor,
    OtherwiseMarker,
    SideOfMentionedDoor,
    Steps,
)
from semnav_env.commands.clauses import Approach, Clause, Follow, GoToDoor, IfThere
from semnav_env.commands.command import reference_of
from semnav_env.commands.corrections import corrected
from semnav_env.commands.references import DoorReference, Side


class ReadingClause(NamedTuple):
    """A clause of one reading, with the adverbs that stood before it.

    Attributes:
        clause: what to do.
        anew: counting begins anew here ("from there").
        in_any_case: it depends on no condition ("in any case").
    """

    clause: Clause
    anew: bool = False
    in_any_case: bool = False


Reading: TypeAlias = list[ReadingClause]


class OutOfPlaceError(ValueError):
    """Words refer to something that was not mentioned before: "go in" without a door.

    Attributes:
        index: which stretch of the text holds these words.
    """

    def __init__(self, problem: str, index: int) -> None:
        super().__init__(problem)
        self.index = index


def one_reading(found: Sequence[ClauseReadings], choice: Sequence[Steps]) -> Reading:
    """The clauses of one reading; empty if it gives a side to something that takes none.

    Args:
        found: the stretches of the text.
        choice: the reading of each stretch.

    Raises:
        OutOfPlaceError: a mark has nothing before it to change.
    """
    reading: Reading = []
    for index, (each, steps) in enumerate(zip(found, choice, strict=True)):
        for number, step in enumerate(steps):
            match step:
                case EnterMentionedDoor():
                    _enter(reading, index)
                case SideOfMentionedDoor(side):
                    if not _add_side(reading, side):
                        return []
                case OtherwiseMarker():
                    _open_otherwise(reading, index)
                case Correction():
                    reading[-1:] = [ReadingClause(_corrected(reading, step, index))]
                case _:
                    adverbs = (each.anew, each.in_any_case) if number == 0 else (False, False)
                    reading.append(ReadingClause(step, *adverbs))
    return reading


def _add_side(reading: Reading, side: Side) -> bool:
    """Give a side to the last clause's door; False if it has no door or the side is known."""
    before = reading[-1].clause if reading else None
    if not isinstance(before, GoToDoor) or before.door.side is not None:
        return False
    door = replace(before.door, side=side)
    reading[-1] = reading[-1]._replace(clause=replace(before, door=door))
    return True


def _corrected(reading: Reading, correction: Correction, index: int) -> Clause:
    if not reading:
        raise OutOfPlaceError("there is nothing before it to be corrected", index)
    try:
        return corrected(reading[-1].clause, correction)
    except ValueError as error:
        raise OutOfPlaceError(str(error), index) from None


def _open_otherwise(reading: Reading, index: int) -> None:
    """Note in the condition, which stands before the last clause, that it has an otherwise."""
    condition = reading[-2].clause if len(reading) > 1 else None
    if not isinstance(condition, IfThere) or condition.otherwise:
        raise OutOfPlaceError("otherwise than what? begin with a condition", index)
    reading[-2] = reading[-2]._replace(clause=replace(condition, otherwise=True))


def _enter(reading: Reading, index: int) -> None:
    """Go through the door that the last clause leads to, or that its condition names."""
    before = reading[-1].clause if reading else None
    entered = _through_door_of(before, index)
    if isinstance(before, IfThere):
        reading.append(ReadingClause(entered))
    else:
        reading[-1] = reading[-1]._replace(clause=entered)


def _through_door_of(before: Clause | None, index: int) -> GoToDoor:
    past = isinstance(before, Follow) and before.past
    door = None if before is None else reference_of(before)
    if past or not isinstance(door, DoorReference):
        raise OutOfPlaceError("into what? name the door", index)
    return GoToDoor(door, Approach.THROUGH)
