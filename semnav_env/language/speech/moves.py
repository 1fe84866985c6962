"""What a single noun asks for in a clause: go past it, up to it, through it."""

from __future__ import annotations

from collections.abc import Set
from dataclasses import replace

from semnav_env.language.clause_readings import EnterMentionedDoor, IntoDoorway, Step
from semnav_env.language.clauses import Approach, Follow, GoBack, GoToDoor, GoToRoom, Leave
from semnav_env.language.references import (
    ENTRY,
    LAST,
    DoorReference,
    Place,
    PlaceReference,
    RoomReference,
    Side,
)
from semnav_env.language.rooms import plain_name
from semnav_env.language.speech.items import Noun

PLACES = {place.value: place for place in Place}

Landmark = DoorReference | PlaceReference | RoomReference


class NoMeaningError(ValueError):
    """Items that together ask for nothing."""


def landmark(noun: Noun) -> Landmark:
    """The door, place or room that a noun names.

    Raises:
        NoMeaningError: it names none.
        ValueError: its ordinal is out of range.
    """
    if noun.kind == "entry":
        return DoorReference(ENTRY)
    if noun.kind in ("door", "room", "one"):
        if noun.closed:
            raise ValueError("closed doors look like walls and do not count: name an open one")
        ordinal = 1 if noun.ordinal is None else noun.ordinal
        if not noun.at_end:
            return DoorReference(ordinal, noun.side)
        if noun.side is None:
            return DoorReference(ordinal, None if ordinal == LAST else Side.AHEAD)
        return DoorReference(LAST if ordinal == 1 else ordinal, noun.side)
    if noun.kind == "named":
        return RoomReference(plain_name(noun.name))
    if noun.kind in ("end", "wall"):
        if noun.ordinal not in (None, 1, LAST):
            raise ValueError("a hallway has one end ahead")
        return PlaceReference(Place.END)
    if noun.kind in PLACES:
        return PlaceReference(PLACES[noun.kind], noun.ordinal or 1)
    raise NoMeaningError(noun.kind)


def is_door(noun: Noun) -> bool:
    """Whether a noun names a door; a room does by its door, unless it is the room around."""
    return noun.kind in ("door", "room", "one", "entry")


def is_this_room(noun: Noun) -> bool:
    """Whether a noun can be the room in which the robot is."""
    bare = noun.ordinal is None and noun.side is None and not noun.at_end
    return noun.kind in ("room", "area") and bare


def moves(noun: Noun, roles: Set[str], verbs: Set[str]) -> tuple[Step, ...]:
    """The steps of a noun in a clause without a turn.

    Args:
        noun: what is named.
        roles: what its preposition may say; empty without one.
        verbs: classes of the verbs of the clause.

    Raises:
        NoMeaningError: these do not go together.
    """
    if roles and not roles - {"of", "from", "with"}:
        raise NoMeaningError("of something else")  # "the door of the kitchen"
    if noun.offset is not None:
        return (Follow(noun.offset),)
    if noun.kind == "it":
        return _it(roles, verbs)
    if noun.kind == "start" and (not roles or roles & {"to", "until", "toward", "at", "into"}):
        return (GoBack(),)
    if noun.kind == "hall":
        return _hall(noun, roles, verbs)
    if noun.kind == "named":
        return _room(noun, roles, verbs)
    if noun.kind == "area":
        return _area(roles, verbs)
    if is_door(noun):
        return _door(noun, roles, verbs)
    return _place(noun, roles, verbs)


def _it(roles: Set[str], verbs: Set[str]) -> tuple[Step, ...]:
    if "leave" in verbs or "out" in roles:
        return (Leave(),)
    if "cross" in verbs:
        return (Follow(PlaceReference(Place.END)),)
    if roles & {"into", "through"} or verbs & {"enter", "take"}:
        return (EnterMentionedDoor(),)
    if not roles and verbs & {"follow", "continue"}:
        return (Follow(),)
    raise NoMeaningError("it")


def _hall(noun: Noun, roles: Set[str], verbs: Set[str]) -> tuple[Step, ...]:
    if noun.ordinal is not None or noun.side is not None:
        raise NoMeaningError("a hallway by its number without a side")
    if "leave" in verbs or "out" in roles:
        raise NoMeaningError("leave the hallway")
    if "cross" in verbs or "across" in roles:
        raise NoMeaningError("across the hallway")
    if verbs & {"be", "reach"}:
        raise NoMeaningError("a statement about the hallway")
    whole = "all along" in roles
    return (Follow(PlaceReference(Place.END)) if whole else Follow(),)


def _room(noun: Noun, roles: Set[str], verbs: Set[str]) -> tuple[Step, ...]:
    room = RoomReference(plain_name(noun.name))
    if noun.at_end and (noun.doorway or roles & {"in"}) and "to" not in roles:
        raise NoMeaningError("in the doorway of a room")
    if noun.at_end and roles & {"to", "toward"} and not roles & {"into", "through"}:
        return (GoToRoom(room.name, Approach.TO),)
    if roles & {"past", "after"} or verbs & {"pass"}:
        return (Follow(room, past=True),)
    if roles & {"near", "opposite", "before", "from"} and not roles & {
        "past",
        "front",
        "to",
        "into",
    }:
        raise NoMeaningError("beside a room")
    if "until" in roles and not roles & {"front", "into"}:
        return (Follow(room),)
    if "front" in roles and "into" not in roles:
        return (GoToRoom(room.name, Approach.TO),)
    if "at" in roles:
        return (GoToRoom(room.name, Approach.TO) if "be" in verbs or not verbs else Follow(room),)
    if "leave" in verbs or "out" in roles:
        return (Leave(),)
    if "cross" in verbs or ("through" in roles and "cross" in verbs):
        return (GoToRoom(room.name), Follow(PlaceReference(Place.END)))
    return (GoToRoom(room.name),)


def _area(roles: Set[str], verbs: Set[str]) -> tuple[Step, ...]:
    """A kind of room, such as a lobby, which is only known as the one around the robot."""
    if "leave" in verbs or "out" in roles:
        return (Leave(),)
    if "cross" in verbs or roles & {"through", "across"}:
        return (Follow(PlaceReference(Place.END)),)
    if roles & {"in", "into"} and verbs and not verbs - {"be", "reach"}:
        return ()  # "then you are in the lobby"
    raise NoMeaningError("area")


def _door(noun: Noun, roles: Set[str], verbs: Set[str]) -> tuple[Step, ...]:
    door = landmark(noun)
    assert isinstance(door, DoorReference)
    this_room = is_this_room(noun)
    if noun.counted and not (roles & {"past", "after"} or verbs & {"pass"}):
        raise NoMeaningError("several doors")
    if "leave" in verbs or ("out" in roles and "into" not in roles):
        bare = noun.kind != "entry" and noun.ordinal is None and noun.side is None
        return (Leave(),) if this_room or (bare and "out" in roles) else (GoToDoor(door),)
    if this_room and ("cross" in verbs or roles & {"through", "across"}):
        return (Follow(PlaceReference(Place.END)),)
    if noun.doorway and "ontop" in roles:
        return (GoToDoor(door, Approach.IN),)
    if roles & {"into", "through"} and "past" not in roles:
        inside = noun.doorway and "through" not in roles and "enter" not in verbs
        if inside and "be" in verbs:
            return (GoToDoor(door, Approach.IN),)
        return (IntoDoorway(door) if inside else GoToDoor(door),)
    if roles & {"past"} or (verbs & {"pass"} and not roles & {"into", "to"}):
        left_behind = noun.counted and door.side is Side.BEHIND
        return (Follow(replace(door, side=None) if left_behind else door, past=True),)
    if roles & {"into", "through"} or verbs & {"enter"}:
        return (GoToDoor(door),)
    if "cross" in verbs and noun.doorway:
        return (GoToDoor(door),)
    if "until" in roles:
        return (Follow(door),)
    if "take" in verbs and not roles & {"to", "at"}:
        return (GoToDoor(door),)
    if roles & {"to", "toward"} or verbs & {"find", "reach"}:
        approach = Approach.THROUGH if noun.kind == "room" else Approach.TO
        return (GoToDoor(door, approach),)
    if not roles and not verbs - {"go", "be"}:
        raise MentionError(door, noun)
    raise NoMeaningError("door")


class MentionError(NoMeaningError):
    """A door that is only mentioned: to it, or through it?

    Attributes:
        door: which door.
        noun: as it was named.
    """

    def __init__(self, door: DoorReference, noun: Noun) -> None:
        super().__init__("mention")
        self.door, self.noun = door, noun


def _place(noun: Noun, roles: Set[str], verbs: Set[str]) -> tuple[Step, ...]:
    place = landmark(noun)
    if not isinstance(place, PlaceReference):
        raise NoMeaningError("place")
    at_end = place.place is Place.END
    going_on = roles & {"past", "after", "over", "across", "through", "around"}
    if (going_on or verbs & {"pass", "cross"}) and not roles & {"to", "until"}:
        if at_end and "across" not in roles:
            raise NoMeaningError("past the end")
        if place.place is Place.CORNER and roles & {"through"}:
            raise NoMeaningError("through a corner")
        return (Follow(place, past=not at_end),)
    if roles & {"to", "until", "toward", "at"} or not roles:
        if noun.counted and noun.ordinal:
            return (Follow(place),)
        return (Follow(place),)
    if at_end and roles & {"along", "all along"}:
        return (Follow(place),)
    raise NoMeaningError("place")


def with_side(door: DoorReference, side: Side) -> DoorReference:
    """A door with a side that is said elsewhere in its clause.

    Raises:
        NoMeaningError: it has another side.
    """
    if door.side not in (None, side):
        raise NoMeaningError("two sides")
    return replace(door, side=side)
