"""Every command that a text can mean, from the readings of its clauses."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise, product
from typing import Any

from semnav_env.language.clause_readings import ClauseReadings
from semnav_env.language.clauses import (
    Approach,
    Clause,
    Face,
    Follow,
    GoToDoor,
    IfThere,
    Leave,
    Turn,
    Turning,
)
from semnav_env.language.command import (
    Command,
    Link,
    links_of,
    may_count_on,
    reference_of,
)
from semnav_env.language.one_reading import OutOfPlaceError, Reading, one_reading
from semnav_env.language.references import DoorReference, PlaceReference

MAX_READINGS = 16
"""The most readings of a command; nobody would choose among more, so the text is refused."""


class TooAmbiguousError(ValueError):
    """A text has more readings than `MAX_READINGS`."""

    def __init__(self, number: int) -> None:
        super().__init__(f"the command can be taken in {number} ways; say it in other words")


def commands_of(found: Sequence[ClauseReadings]) -> tuple[Command, ...]:
    """Every command that the stretches of a text can mean together, each once.

    Raises:
        OutOfPlaceError: "go in" without a door before it, and the like.
        TooAmbiguousError: too many readings.
    """
    _check_number(math.prod(len(each.readings) for each in found))
    readings = [one_reading(found, choice) for choice in product(*(f.readings for f in found))]
    readings = [_with_dependent_turn(reading) for reading in readings]
    _check_conditions(readings, last=len(found) - 1)
    commands = [clauses for reading in readings if reading for clauses in _countings(reading)]
    _check_number(len(commands))
    return tuple(dict.fromkeys(Command(clauses) for clauses in commands))


def _with_dependent_turn(reading: Reading) -> Reading:
    """Of "If there is no door, go to the end and turn right": one turn, at the end."""
    match [each.clause for each in reading]:
        case [
            *_,
            IfThere(_, _, False),
            Follow(PlaceReference() as place, False),
            Turn(Turning.LEFT | Turning.RIGHT as way, None, None),
        ] if not reading[-1].in_any_case:
            return [*reading[:-2], reading[-2]._replace(clause=Turn(way, place))]
    return reading


def _check_number(readings: int) -> None:
    if readings > MAX_READINGS:
        raise TooAmbiguousError(readings)


def _check_conditions(readings: Sequence[Reading], last: int) -> None:
    """Refuse readings in which it is not clear which clauses depend on a condition.

    Args:
        readings: of the whole text.
        last: index of the last stretch, which is where the error points.
    """
    for reading in readings:
        links = links_of([each.clause for each in reading])
        for each, link in zip(reading, links, strict=True):
            after_condition = link is Link.IN_ANY_CASE
            if each.in_any_case is not after_condition:
                unclear = 'does this depend on the condition? if not, say "in any case"'
                needless = "in any case? there is no condition"
                raise OutOfPlaceError(unclear if after_condition else needless, last)


def _countings(reading: Reading) -> list[tuple[Clause, ...]]:
    """The clauses of a reading, counted anew and counted on where it does not say which.

    "Past the first door, then through the second" can mean the second door from here, or from
    the first one.
    """
    countings: list[tuple[Clause, ...]] = [(reading[0].clause,)]
    links = links_of([each.clause for each in reading])
    pairs = zip(pairwise(reading), links[1:], strict=True)
    for number, ((before, each), link) in enumerate(pairs, 1):
        if link in (Link.THEN, Link.OTHERWISE):
            countings = [(*all_, _in_case(all_, reading, link)) for all_ in countings]
            continue
        choices, first = [each.clause], before.clause
        if link is Link.NEXT and may_count_on(first, each.clause) and not each.anew:
            choices.append(_counted_on(first, each.clause))
        elif link is Link.NEXT and not each.anew and _is_next_door(reading, number):
            choices.append(_as_first(each.clause))
        countings = [(*clauses, choice) for clauses in countings for choice in choices]
    return countings


def _in_case(clauses: Sequence[Clause], reading: Reading, link: Link) -> Clause:
    """The next clause, which depends on a condition, counted from where that is counted."""
    at, clause = len(clauses) - (1 if link is Link.THEN else 2), reading[len(clauses)].clause
    counts_on = clauses[at] != reading[at].clause
    first = reading[at - 1].clause
    return _counted_on(first, clause) if counts_on and may_count_on(first, clause) else clause


def _is_next_door(reading: Reading, number: int) -> bool:
    """Whether it can lead to the next door: "into the second room, out, and into the third"."""
    match [each.clause for each in reading[max(0, number - 2) : number + 1]]:
        case [GoToDoor(DoorReference(int(n), same), Approach.THROUGH), Leave(), GoToDoor(door)]:
            return door.side == same and door.ordinal == n + 1 > 1
    return False


def _as_first(clause: Any) -> Clause:
    """The clause with the first door of its side."""
    first: Clause = replace(clause, door=replace(clause.door, ordinal=1))
    return first


def _counted_on(before: Clause, clause: Any) -> Clause:
    """The clause with its ordinal counted from where the clause before began."""
    first, second = reference_of(before), reference_of(clause)
    assert first is not None
    assert second is not None
    reference: Any = replace(second, ordinal=second.ordinal - first.ordinal)
    names: dict[type, str] = {GoToDoor: "door", Follow: "until", IfThere: "what", Face: "what"}
    changed: Any = replace(clause, **{names.get(type(clause), "at"): reference})
    return changed  # type: ignore[no-any-return]
