"""What the items of one clause mean, with a condition or a correction before them."""

from __future__ import annotations

from collections.abc import Sequence

from semnav_env.language.clause_readings import (
    Correction,
    EnterMentionedDoor,
    NextIfClosed,
    OtherwiseMarker,
    Readings,
    Step,
    StopBeforeMentioned,
    on_condition,
)
from semnav_env.language.clauses import Approach, Clause, GoToDoor, GoToRoom, IfThere, Stop
from semnav_env.language.references import DoorReference, PlaceReference, RoomReference
from semnav_env.language.speech.frame import ClauseFrame
from semnav_env.language.speech.frames import readings_of
from semnav_env.language.speech.items import JOINTS, Item, ItemKind, Noun
from semnav_env.language.speech.moves import is_door, landmark

VERBLESS_COST, COMMA_COST, SIDELESS_COST, LATE_PLACE_COST = 0.25, 0.15, 0.6, 0.5
"""Costs of a clause's having no verb, of a comma inside it, of a turn without a side, and of a
place behind a comma ("turn left, at the corner")."""

PREFIXES = (ItemKind.OTHERWISE, ItemKind.IN_ANY_CASE, ItemKind.FROM_THERE, ItemKind.NO)
"""Items that say how a clause belongs to those before it."""


def is_only_noun(items: Sequence[Item]) -> bool:
    """Whether a clause only names something, so that it rather belongs to the clause before."""
    return all(item.kind in (ItemKind.REF, ItemKind.HERE, ItemKind.PARTICLE) for item in items)


def read_clause(items: list[Item]) -> tuple[Readings, float] | None:
    """A clause without a condition."""
    cost = 0.0
    kept: list[Item] = []
    for index, item in enumerate(items):
        if item.kind is ItemKind.SIGN and item.value in (",", ":"):
            if (
                not (_is_context(kept) or _is_afterthought(kept, items[index + 1 :]))
                or index == len(items) - 1
            ):
                return None
            late = len(items) == index + 2 and "at" in items[index + 1].roles
            cost += LATE_PLACE_COST if late and not _is_context(kept) else COMMA_COST
        elif (
            item.kind is ItemKind.THEN
            and kept
            and kept[-1].kind is ItemKind.VERB
            and len(kept) == 1
            and item.stop <= item.start + 2
            and item.value != "once"
            and (item.value != "and then" or kept[-1].value == "go")
        ):
            continue  # "bieg dann links ab"
        elif item.kind in (
            *JOINTS,
            *PREFIXES,
            ItemKind.UNKNOWN,
            ItemKind.OR,
            ItemKind.NOT,
            ItemKind.IF,
        ):
            return None
        elif isinstance(item.value, float) and item.kind is ItemKind.DISTANCE:
            return None  # a number that corrects nothing
        elif item.kind not in (ItemKind.HERE, ItemKind.BUT, ItemKind.COULD_YOU):
            kept.append(item)
    if not kept:
        return None
    verbs = [item.value for item in kept if item.kind is ItemKind.VERB]
    if verbs == ["go"] == [item.value for item in kept] and not any(
        item.kind is ItemKind.HERE for item in items
    ):
        return None
    if len(verbs) > 1 and set(verbs) != {"be"} and not _is_verb_cluster(kept):
        return None
    if not any(item.kind is ItemKind.VERB for item in kept):
        cost += VERBLESS_COST
    turns_nowhere = verbs == ["turn"] and all(
        item.kind in (ItemKind.VERB, ItemKind.PARTICLE) for item in kept
    )
    cost += SIDELESS_COST if turns_nowhere else 0.0
    return readings_of(ClauseFrame(tuple(kept))), cost


CONTEXT_ROLES = frozenset({"at", "after", "when", "between", "until", "past"})


def _is_context(items: Sequence[Item]) -> bool:
    """Whether what stands before a comma only says where the clause behind it is done."""
    if len(items) == 1 and items[0].value == "be":
        return True
    if len(items) == 2 and items[0].value == "be":
        items = items[1:]
    return (
        len(items) == 1
        and items[0].kind is ItemKind.REF
        and bool(
            set(items[0].roles) & (CONTEXT_ROLES - {"until", "past"}) or "after" in items[0].roles
        )
    )


def _is_afterthought(before: Sequence[Item], items: Sequence[Item]) -> bool:
    """Whether what stands behind a comma only says where the door or the turn before it is."""
    if len(items) != 1:
        return False
    if items[0].kind is ItemKind.REF and "after" not in items[0].roles:
        if before and before[-1].value == "stop" and items[0].value.doorway:
            return True  # "stop, right in the doorway"
        turns = len(before) and before[-1].kind is ItemKind.SIDE and not before[-1].roles
        placed = any(item.kind is ItemKind.REF for item in before)
        at_place = "at" in items[0].roles and not is_door(items[0].value)
        return bool(turns) and at_place and not placed  # "turn right, at the corner"
    if items[0].kind is ItemKind.REF:
        return True
    if items[0].kind is not ItemKind.SIDE or any(item.kind is ItemKind.SIDE for item in before):
        return False
    doors = [item for item in before if item.kind is ItemKind.REF and is_door(item.value)]
    turns = any(item.kind is ItemKind.VERB and item.value == "turn" for item in before)
    sideless = len(doors) == 1 and doors[0].value.side is None and "on" in items[0].roles
    return sideless or (turns and not doors)


def _is_verb_cluster(items: Sequence[Item]) -> bool:
    """Whether two verbs are one: "komm ... zurück", "musst ... fahren", "bleib stehen"."""
    verbs = [index for index, item in enumerate(items) if item.kind is ItemKind.VERB]
    values = [items[index].value for index in verbs]
    if len(values) != 2:
        return False
    beside = verbs[1] == verbs[0] + 1
    last = verbs[1] == len(items) - 1
    if (
        last
        and len(items) > 2
        and items[-2].kind is ItemKind.STRAIGHT
        and items[-3].kind is ItemKind.REF
    ):
        return False  # "past the door straight, head ..."
    if values[0] == "be" and values[1] in ("stop", "wait", "keep"):
        return True
    if values[0] in ("go", "continue", "be") and (
        beside or (last and values[1] not in ("wait", "stop"))
    ):
        return True
    if "wall" in values or "away" in values or (values[0] == "make" and "stop" in values[1]):
        return True
    return len(values) == 2 and values[0].split()[0] == values[1].split()[0]


def on_premise(premise: object, readings: Readings) -> Readings:
    """The readings of a clause that depends on a condition."""
    noun: Noun | None = premise.noun  # type: ignore[attr-defined]
    if noun is None and premise.state == "closed":  # type: ignore[attr-defined]
        for steps in readings:
            if len(steps) == 1 and isinstance(steps[0], Clause):
                return ((NextIfClosed(steps[0]),),)
    what = _door_of(readings) if noun is None else landmark(noun)
    if isinstance(what, RoomReference) and premise.state:  # type: ignore[attr-defined]
        there = GoToRoom(what.name, Approach.TO)
        door = IfThere(DoorReference(), absent=premise.absent)  # type: ignore[attr-defined]
        inside = tuple(tuple(_filled(step, DoorReference()) for step in s) for s in readings)
        return tuple((there, *steps) for steps in on_condition(door, inside))
    if not isinstance(what, DoorReference | PlaceReference):
        raise ValueError("a condition is on doors and places ahead, not on rooms")
    if premise.state == "closed" and isinstance(what, DoorReference):  # type: ignore[attr-defined]
        next_door = _next_door(what, readings)
        if next_door is not None:
            return next_door
    readings = tuple(tuple(_filled(step, what) for step in steps) for steps in readings)
    return on_condition(IfThere(what, absent=premise.absent), readings)  # type: ignore[attr-defined]


def _door_of(readings: Readings) -> DoorReference:
    """The door that "it" is in "go through the door if it is open"."""
    for step in (step for steps in readings for step in steps):
        if isinstance(step, GoToDoor):
            return step.door
    raise ValueError("name the door of the condition")


def _filled(step: Step, what: DoorReference | PlaceReference) -> Step:
    if isinstance(step, EnterMentionedDoor) and isinstance(what, DoorReference):
        return GoToDoor(what)
    return step


def _next_door(closed: DoorReference, readings: Readings) -> Readings | None:
    """Of "If the first door is closed, take the next": the first open one."""
    for steps in readings:
        match steps:
            case (GoToDoor(DoorReference(ordinal, side)) as clause,) if ordinal in (
                1,
                closed.ordinal + 1,
            ) and side in (None, closed.side):
                if closed.ordinal != 1:
                    raise ValueError(
                        "closed doors look like walls and do not count: name the open one"
                    )
                return ((GoToDoor(closed, clause.approach),),)
    return None


def otherwise_of(readings: Readings) -> Readings:
    """The readings of a clause for the other case of a condition."""
    if any(len(s) > 1 and s[-1] != Stop() and StopBeforeMentioned() in s for s in readings):
        raise ValueError("one waits where one stands: a closed door is not seen")
    readings = tuple(
        tuple(step for step in steps if not isinstance(step, StopBeforeMentioned))
        for steps in readings
    )
    if any(len(steps) != 1 for steps in readings):
        raise ValueError('one thing is done otherwise; begin the next with "in any case"')
    return tuple((OtherwiseMarker(), *steps) for steps in readings)


def correcting(readings: Readings) -> Readings:
    """The readings of a clause that takes the place of the one before it."""
    return tuple(
        (Correction(steps[0]), *steps[1:]) if steps and isinstance(steps[0], Clause) else steps
        for steps in readings
    )
