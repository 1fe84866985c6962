"""Clauses in which a robot stops: "stop in the doorway", "wait there for 5 seconds"."""

from __future__ import annotations

from dataclasses import replace

from semnav_env.language.clause_readings import (
    EnterMentionedDoor,
    Readings,
    Step,
    Steps,
    StopBeforeMentioned,
)
from semnav_env.language.clauses import (
    MAX_SECONDS,
    Approach,
    Follow,
    GoToDoor,
    GoToRoom,
    Stop,
    waits_of,
)
from semnav_env.language.command import MAX_CLAUSES
from semnav_env.language.references import (
    DoorReference,
    Side,
)
from semnav_env.language.rooms import plain_name
from semnav_env.language.speech.frame import (
    END,
    ClauseFrame,
    check_destinations,
    contexts_of,
    distances_of,
    replace_items,
)
from semnav_env.language.speech.items import ItemKind, Noun
from semnav_env.language.speech.moves import (
    NoMeaningError,
    is_door,
    is_this_room,
    landmark,
)
from semnav_env.language.speech.turning import read_turn


def read_wait(frame: ClauseFrame) -> Readings | None:
    """The readings of a clause with a time; None if it has none."""
    if not (amounts := frame.of(ItemKind.SECONDS)):
        return None
    seconds = sum(item.value for item in amounts)
    if seconds != int(seconds) or seconds < 1:
        raise ValueError(f"one waits for whole seconds, not {seconds:g}")
    if seconds > MAX_SECONDS * MAX_CLAUSES:
        raise ValueError(f"one waits for {MAX_SECONDS * MAX_CLAUSES} seconds at most")
    if frame.verbs - {"stop", "wait", "go", "continue", "make"} or frame.sides:
        raise NoMeaningError("a time and something else")
    if frame.verbs and not frame.verbs - {"go", "continue"}:
        raise ValueError("how long to drive is not understood: say how far, or to wait so long")
    rest = replace_items(frame, ItemKind.SECONDS)
    if any(item.value.kind == "it" and "before" in frame.roles(item) for item in rest.refs):
        raise NoMeaningError("wait in front of it")
    before = (StopBeforeMentioned(),) if frame.has(ItemKind.BEFORE_IT) else ()
    if frame.has(ItemKind.IN) and rest.refs:
        raise NoMeaningError("enter, and a time")
    there = _stop_at(rest) if rest.refs else ()
    return ((*before, *there, *waits_of(int(seconds))),)


def read_stop(frame: ClauseFrame) -> Readings | None:
    """The readings of a clause that ends in a stop; None if it does not."""
    if not frame.verbs and len(frame.items) == 1 and frame.has(ItemKind.BEFORE_IT):
        return ((StopBeforeMentioned(),),)  # "to the door, but don't go in"
    if not frame.verbs & {"stop", "wait"}:
        return None
    if frame.verbs - {"stop", "wait", "go", "continue", "in", "make", "keep"} or frame.goes_out:
        return None
    if frame.has(ItemKind.AROUND):
        return None
    if frame.sides:
        if "keep" in frame.verbs and not any(is_door(item.value) for item in frame.refs):
            return read_turn(_turned(frame))
        return _stop_on_side(frame)
    if not frame.refs and not frame.has(ItemKind.DISTANCE):
        if frame.has(ItemKind.IN):
            return ((EnterMentionedDoor(), Stop()),)
        if frame.has(ItemKind.BEFORE_IT):
            return ((StopBeforeMentioned(), Stop()),)
        if frame.has(ItemKind.TO_END):
            return ((Follow(END), Stop()),)
        return ((Stop(),),)
    return (_stopped(_stop_at(frame)),)


def _turned(frame: ClauseFrame) -> ClauseFrame:
    """Of "Halt dich rechts": the frame with a turn for what keeps to a side."""
    return ClauseFrame(
        tuple(
            replace(item, value="turn") if item.kind is ItemKind.VERB else item
            for item in frame.items
        )
    )


def _stopped(steps: Steps) -> Steps:
    """Steps with a stop behind them, unless they lead to where one stops anyway."""
    last = steps[-1] if steps else None
    inside = isinstance(last, GoToDoor) and last.approach is Approach.IN
    return steps if inside or isinstance(last, GoToRoom) else (*steps, Stop())


def _stop_on_side(frame: ClauseFrame) -> Readings:
    """Of "Stop on the left in front of a door": the side is that of the door."""
    doors = [item for item in frame.refs if is_door(item.value) and item.value.side is None]
    if len(doors) != 1 or len(frame.sides) != 1:
        raise NoMeaningError("stop at a side")
    noun = replace(doors[0].value, side=Side(frame.sides[0].value))
    items = tuple(
        replace(item, value=noun) if item is doors[0] else item
        for item in frame.items
        if item.kind is not ItemKind.SIDE
    )
    return (_stopped(_stop_at(ClauseFrame(items))),)


def _stop_at(frame: ClauseFrame) -> Steps:
    """Where one stops."""
    contexts, rest = contexts_of(frame)
    steps: list[Step] = [*contexts, *distances_of(frame)]
    for item in rest:
        noun, roles = item.value, frame.roles(item)
        if noun.kind == "it" or noun.kind == "hall":
            continue
        if noun.kind == "named":
            inside = noun.at_end and (noun.doorway or bool(roles & {"in", "into"}))
            if inside or ("near" in roles and any(is_door(r.value) for r in rest)):
                raise NoMeaningError("in the doorway of a room, or beside it")
            steps.append(GoToRoom(plain_name(noun.name), Approach.TO))
        elif is_door(noun):
            steps += _stop_at_door(noun, roles)
        else:
            steps.append(Follow(landmark(noun)))
    check_destinations(steps)
    return tuple(steps)


def _stop_at_door(noun: Noun, roles: frozenset[str]) -> Steps:
    door = landmark(noun)
    assert isinstance(door, DoorReference)
    if noun.counted:
        raise NoMeaningError("several doors")
    inside = bool(roles & {"in", "into", "through"}) or (
        noun.doorway and "to" not in roles and "before" not in roles
    )
    plain = noun.ordinal is None and noun.side is None
    if (is_this_room(noun) and roles & {"in", "into"}) or (
        noun.doorway and plain and "past" in roles
    ):
        return ()
    if inside and noun.kind == "room":
        return (GoToDoor(door),)
    if roles & {"past"} and not roles & {"near"}:
        return (Follow(door, past=True),)
    return (GoToDoor(door, Approach.IN if inside else Approach.TO),)
