"""Words beside a door that say where it is: "at the end", "opposite", "vorne"."""

from __future__ import annotations

from dataclasses import replace

from semnav_env.language.references import (
    LAST,
    Side,
)
from semnav_env.language.speech.frame import ClauseFrame
from semnav_env.language.speech.items import ItemKind, Noun
from semnav_env.language.speech.moves import (
    PLACES,
    is_door,
)


def _is_before_end(frame: ClauseFrame) -> bool:
    """Whether a clause names what is before a place at which the hallway ends."""
    return any(
        item.value.kind in ("corner", "end", "t_junction", "wall")
        and "before" in item.roles
        and item.value.ordinal in (None, 1)
        for item in frame.refs
    )


def with_places_of_doors(frame: ClauseFrame) -> ClauseFrame:
    """The frame with "at the end there is a door" and "vorne" as parts of the door's noun."""
    doors = [item for item in frame.refs if is_door(item.value) and "opposite" not in item.roles]
    facing = [
        item for item in doors if item.value == Noun("door", 1, Side.OPPOSITE) and not item.roles
    ]
    if len(doors) == 2 and facing:
        (other,) = [item for item in doors if item is not facing[0]] or [facing[0]]
        if other.value.side is None:
            faced = replace(other, value=replace(other.value, side=Side.OPPOSITE))
            return ClauseFrame(
                tuple(faced if i is other else i for i in frame.items if i is not facing[0])
            )
    if len(doors) != 1:
        return frame
    door = doors[0]
    ends = [
        item
        for item in frame.refs
        if item.value.kind == "end"
        and frame.roles(item) & {"at", "toward"}
        and not frame.roles(item) & {"until"}
        and (frame.roles(item) & {"at"} or "be" in frame.verbs)
    ]
    noun: Noun = door.value
    if "be" in frame.verbs and any(
        item.value.kind in PLACES and item not in ends and "at" in item.roles for item in frame.refs
    ):
        raise ValueError("doors beside a place are not known: count them, or say before or after")
    if ends:
        noun = replace(noun, at_end=True)
    elif noun.ordinal is None and noun.definite and _is_before_end(frame):
        noun = replace(noun, ordinal=LAST)  # "the door before the corner"
    for item in frame.of(ItemKind.PARTICLE):
        if item.value in ("ahead", "behind") and noun.side is None and not frame.sides:
            noun = replace(noun, side=Side(item.value))
    sides = frame.of(ItemKind.SIDE) if "be" in frame.verbs and noun.side is None else ()
    if len(sides) == 1:
        noun = replace(noun, side=Side(sides[0].value.value))
        ends = [*ends, *sides]
    items = (
        replace(each, value=noun) if each is door else each
        for each in frame.items
        if each not in ends
    )
    return ClauseFrame(tuple(items))
