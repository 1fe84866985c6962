"""One reading of a command: its clauses in order, with all marks applied to them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple, TypeAlias

from semnav_env.language.clause_readings import (
    ClauseReadings,
    Correction,
    EnterMentionedDoor,
    IntoDoorway,
    NextIfClosed,
    OtherwiseMarker,
    SideOfMentionedDoor,
    Steps,
    StopBeforeMentioned,
    TurnBack,
    TurnIntoHall,
)
from semnav_env.language.clauses import (
    Approach,
    Clause,
    Follow,
    GoBack,
    GoToDoor,
    GoToRoom,
    IfThere,
    Leave,
    Stop,
    Turn,
    Turning,
)
from semnav_env.language.command import reference_of
from semnav_env.language.references import (
    DoorReference,
    Place,
    PlaceReference,
    RoomReference,
    Side,
)


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
    doorway = -2
    for index, (each, steps) in enumerate(zip(found, choice, strict=True)):
        for number, step in enumerate(steps):
            match step:
                case EnterMentionedDoor():
                    if _has_entered(reading):
                        return []
                    _enter(reading, index)
                case StopBeforeMentioned():
                    _stop_before(reading, index)
                case IntoDoorway(DoorReference(1, None)) if _is_at_door(reading):
                    inside = replace(reading[-1].clause, approach=Approach.IN)  # type: ignore[type-var]
                    reading[-1] = reading[-1]._replace(clause=inside)
                case IntoDoorway(door):
                    doorway = len(reading)
                    reading.append(ReadingClause(GoToDoor(door)))
                case Stop() if doorway == len(reading) - 1:
                    entered = reading[-1].clause
                    assert isinstance(entered, GoToDoor)
                    inside = replace(entered, approach=Approach.IN)
                    reading[-1:] = [ReadingClause(inside), ReadingClause(step)]
                case TurnIntoHall(way):
                    reading.append(ReadingClause(_into_hall(way, reading)))
                case TurnBack():
                    _turn_back(reading)
                case NextIfClosed(clause):
                    _unless_closed(reading, clause, index)
                case SideOfMentionedDoor(side):
                    if not _add_side(reading, side):
                        return []
                case OtherwiseMarker():
                    _open_otherwise(reading, index)
                case Correction(clause):
                    if not reading:
                        problem = "there is nothing before it to be corrected"
                        raise OutOfPlaceError(problem, index)
                    reading[-1:] = [ReadingClause(clause)]
                case _:
                    adverbs = (each.anew, each.in_any_case) if number == 0 else (False, False)
                    reading.append(ReadingClause(step, *adverbs))
    return reading


def _is_at_door(reading: Reading) -> bool:
    return bool(reading) and isinstance(reading[-1].clause, GoToDoor)


def _stop_before(reading: Reading, index: int) -> None:
    """Go to the last clause's door or room and not in."""
    before = reading[-1].clause if reading else None
    if isinstance(before, Stop) and len(reading) > 1 and _stops_in_front(reading[-2].clause):
        return
    if isinstance(before, Stop) and len(reading) > 1 and _leads_to_door(reading[-2].clause):
        reading.pop()
        before = reading[-1].clause
    if isinstance(before, Follow) and not before.past:
        if isinstance(before.until, DoorReference):
            before = GoToDoor(before.until)
        elif isinstance(before.until, RoomReference):
            before = GoToRoom(before.until.name)
        reading[-1] = ReadingClause(before)
    if not isinstance(before, GoToDoor | GoToRoom):
        raise OutOfPlaceError("in front of what? name the door", index)
    reading[-1] = reading[-1]._replace(clause=replace(before, approach=Approach.TO))


def _stops_in_front(clause: Clause) -> bool:
    return isinstance(clause, GoToDoor | GoToRoom) and clause.approach is Approach.TO


def _leads_to_door(clause: Clause) -> bool:
    """Whether a clause leads along the hallway to a door or a room."""
    until = clause.until if isinstance(clause, Follow) and not clause.past else None
    return isinstance(until, DoorReference | RoomReference)


def _into_hall(way: Turning, reading: Reading) -> Turn:
    """A turn into the hallway in front of the robot, or into one that leads off."""
    match reading[-1].clause if reading else None:
        case Leave() | GoToDoor(_, Approach.THROUGH):
            return Turn(way)
    return Turn(way, PlaceReference(Place.TURNING))


def _turn_back(reading: Reading) -> None:
    """Turn around, once; "the way you came" says nothing more."""
    before = reading[-1].clause if reading else None
    if isinstance(before, GoBack):
        reading.pop()
    if before != Turn(Turning.AROUND):
        reading.append(ReadingClause(Turn(Turning.AROUND)))


def _unless_closed(reading: Reading, clause: Clause, index: int) -> None:
    """Make the last clause, which leads through a door, hang on whether that is open."""
    before = reading[-1].clause if reading else None
    if not isinstance(before, GoToDoor):
        raise OutOfPlaceError("if what is closed? name the door", index)
    first, other = before.door, getattr(clause, "door", None)
    if other is not None and other.side in (None, first.side):
        if other.ordinal not in (1, first.ordinal + 1) or first.ordinal != 1:
            problem = "closed doors look like walls and do not count: name the open one"
            raise OutOfPlaceError(problem, index)
        return  # the first open door is meant
    condition = IfThere(first, otherwise=True)
    reading[-1:] = [ReadingClause(each) for each in (condition, before, clause)]


def _add_side(reading: Reading, side: Side) -> bool:
    """Give a side to the last clause's door; False if it has no door, or one on another side."""
    before = reading[-1].clause if reading else None
    if not isinstance(before, GoToDoor) or before.door.side not in (None, side):
        return False
    door = replace(before.door, side=side)
    reading[-1] = reading[-1]._replace(clause=replace(before, door=door))
    return True


def _open_otherwise(reading: Reading, index: int) -> None:
    """Note in the condition, which stands before the last clause, that it has an otherwise."""
    condition = reading[-2].clause if len(reading) > 1 else None
    before = reading[-1].clause if reading else None
    if not isinstance(condition, IfThere) and isinstance(before, GoToDoor):
        reading.insert(-1, ReadingClause(IfThere(before.door, otherwise=True)))
        return
    if not isinstance(condition, IfThere) or condition.otherwise:
        raise OutOfPlaceError("otherwise than what? begin with a condition", index)
    reading[-2] = reading[-2]._replace(clause=replace(condition, otherwise=True))


def _has_entered(reading: Reading) -> bool:
    """Whether one waits behind the door already: "through the door, wait, and then go in"."""
    last = [each.clause for each in reading[-2:]]
    match last:
        case [GoToDoor(_, Approach.THROUGH), Stop()]:
            return True
    return False


def _enter(reading: Reading, index: int) -> None:
    """Go through the door that the last clause leads to, or that its condition names."""
    before = reading[-1].clause if reading else None
    if isinstance(before, GoToRoom) or _is_at_turning(before):
        return
    if isinstance(before, Stop) and len(reading) > 1:
        there = reading[-2].clause
        if isinstance(there, GoToDoor) and there.approach is not Approach.THROUGH:
            reading.append(ReadingClause(GoToDoor(DoorReference())))
            return
    condition = reading[-2].clause if len(reading) > 1 else None
    if (
        isinstance(condition, IfThere)
        and isinstance(condition.what, DoorReference)
        and condition.otherwise
    ):
        reading.append(ReadingClause(GoToDoor(condition.what)))
        return
    entered = _through_door_of(before, index)
    if isinstance(before, IfThere):
        reading.append(ReadingClause(entered))
    else:
        reading[-1] = reading[-1]._replace(clause=entered)


def _is_at_turning(before: Clause | None) -> bool:
    """Whether a clause is "turn left at the turning", which says it all: "take that"."""
    at = before.at if isinstance(before, Turn) else None
    return at is not None and at.place is Place.TURNING


def _through_door_of(before: Clause | None, index: int) -> GoToDoor:
    past = isinstance(before, Follow) and before.past
    door = None if before is None else reference_of(before)
    if past or not isinstance(door, DoorReference):
        raise OutOfPlaceError("into what? name the door", index)
    return GoToDoor(door, Approach.THROUGH)
