"""Turns whose side stands at a noun: "the second hallway on the left"."""

from __future__ import annotations

from dataclasses import replace

from semnav_env.language.clause_readings import (
    Readings,
    TurnIntoHall,
    at_reference,
)
from semnav_env.language.clauses import (
    Follow,
    GoToDoor,
    Turn,
    Turning,
)
from semnav_env.language.references import (
    DoorReference,
    Place,
    PlaceReference,
    Side,
)
from semnav_env.language.speech.frame import ClauseFrame, before_turn, contexts_of
from semnav_env.language.speech.items import Item
from semnav_env.language.speech.moves import (
    PLACES,
    is_door,
    landmark,
    moves,
)


def read_turn_into(frame: ClauseFrame) -> Readings | None:
    """A turn whose side is that of a noun: "take the second hallway on the left"."""
    found = [item for item in frame.refs if _is_turn_noun(item, frame)]
    if len(found) != 1:
        if "turn" in frame.verbs or "make" in frame.verbs:
            return _turn_at_sided_door(frame)
        return None
    noun = found[0].value
    if frame.verbs - {
        "turn",
        "go",
        "take",
        "make",
        "enter",
        "follow",
        "continue",
        "be",
    } or frame.roles(found[0]) & {"until", "past"}:
        return None
    contexts, rest = contexts_of(frame)
    if found[0] not in rest:
        return None
    ways = [Turning(noun.side.value)] if noun.side else [Turning.LEFT, Turning.RIGHT]
    if noun.side is None and not (frame.verbs & {"take", "turn"} and noun.ordinal):
        return None
    kind = PLACES.get(noun.kind, Place.TURNING)
    at = PlaceReference(kind, noun.ordinal or 1)
    others = [item for item in rest if item is not found[0]]
    first = contexts + tuple(
        s for item in others if item.start < found[0].start for s in before_turn(item, frame)
    )
    later = tuple(
        s
        for item in others
        if item.start > found[0].start
        for s in moves(item.value, frame.roles(item), frozenset({"go"}))
    )
    is_first = noun.ordinal in (None, 1)
    plain = noun.ordinal is None and not noun.definite and "be" not in frame.verbs
    place = (
        landmark(others[0].value)
        if len(others) == 1
        and "at" in frame.roles(others[0])
        and not is_door(others[0].value)
        and others[0].value.kind not in ("it", "hall", "start", "way back")
        else None
    )
    if is_first and kind is Place.TURNING and isinstance(place, PlaceReference):
        return tuple((*contexts, Turn(way, place)) for way in ways)
    follows = (Follow(),) if "follow" in frame.verbs else ()
    into_hall = noun.kind == "hall" and noun.ordinal is None and not plain and not first
    return tuple(
        (*first, _turn(way, None if plain else at, into_hall), *follows, *later) for way in ways
    )


def _turn(way: Turning, at: PlaceReference | None, into_hall: bool) -> Turn | TurnIntoHall:
    return TurnIntoHall(way) if into_hall else Turn(way, at)


def _is_turn_noun(item: Item, frame: ClauseFrame) -> bool:
    noun = item.value
    if noun.kind == "turning":
        return noun.side in (Side.LEFT, Side.RIGHT) or bool(frame.verbs & {"take"})
    if noun.kind in ("intersection", "corner", "t_junction"):
        return noun.side in (Side.LEFT, Side.RIGHT)
    if noun.kind == "one":
        return noun.side in (Side.LEFT, Side.RIGHT) and False
    return noun.kind == "hall" and (
        noun.side in (Side.LEFT, Side.RIGHT) or noun.ordinal is not None
    )


def _turn_at_sided_door(frame: ClauseFrame) -> Readings | None:
    """Of "An der zweiten Tür links abbiegen": the side is that of the turn."""
    contexts, _ = contexts_of(frame)
    doors = [
        item
        for item in frame.refs
        if is_door(item.value) and item.value.side in (Side.LEFT, Side.RIGHT)
    ]
    if "turn" not in frame.verbs or len(doors) != 1:
        return None
    noun = doors[0].value
    turn = Turn(Turning(noun.side.value))
    door = DoorReference(noun.ordinal or 1)
    roles = frame.roles(doors[0])
    if "after" in roles:
        return (
            (
                *[s for s in contexts if s != Follow(replace(door, side=noun.side), past=True)],
                Follow(door, past=True),
                turn,
            ),
        )
    if roles & {"into", "through"}:
        return ((*contexts, GoToDoor(replace(door, side=noun.side))),)
    return tuple((*contexts, *each) for each in at_reference(door, (turn,)))
