"""What the items of one clause mean together.

People say the parts of a clause in any order, and languages differ in theirs: "turn left at the
corner", "at the corner left", "an der Ecke links abbiegen". So a clause is read as a frame: its
verbs, its sides and what it names, each with its preposition.
"""

from __future__ import annotations

from dataclasses import replace

from semnav_env.language.clause_readings import (
    Readings,
    Steps,
)
from semnav_env.language.clauses import (
    Approach,
    BackUp,
    Face,
    GoToDoor,
    SearchHouse,
    Turn,
    Turning,
)
from semnav_env.language.references import (
    DoorReference,
    PlaceReference,
    Side,
)
from semnav_env.language.speech.doorplaces import with_places_of_doors
from semnav_env.language.speech.frame import (
    KNOWN_VERBS,
    ClauseFrame,
    contexts_of,
    distances_of,
    goes_around,
)
from semnav_env.language.speech.going import read_go
from semnav_env.language.speech.items import Item, ItemKind, Noun
from semnav_env.language.speech.leaving import read_back, read_in, read_leave
from semnav_env.language.speech.moves import (
    NoMeaningError,
    is_door,
    landmark,
    moves,
    with_side,
)
from semnav_env.language.speech.stopping import read_stop, read_wait
from semnav_env.language.speech.turning import read_degrees, read_turn

_MOVING = (ItemKind.STRAIGHT, ItemKind.TO_END, ItemKind.IN, ItemKind.OUT)


def readings_of(frame: ClauseFrame) -> Readings:
    """The readings of a clause.

    Raises:
        NoMeaningError: its items have no meaning together.
        ValueError: they have one that no robot can carry out; the message says why.
    """
    if frame.verbs - KNOWN_VERBS:
        raise NoMeaningError("verb")
    if frame.has(ItemKind.SLIGHT) and frame.sides and not frame.has(ItemKind.DEGREES):
        raise ValueError('by how much? say "turn left by 30 degrees"')
    if frame.has(ItemKind.BEFORE_IT) and any(_is_doorway_of_room(item) for item in frame.refs):
        raise NoMeaningError("in the doorway of a room")
    frame = with_places_of_doors(frame)
    for read in (
        _search,
        _reverse,
        read_degrees,
        read_wait,
        read_stop,
        _face,
        _around,
        read_back,
        read_leave,
        read_in,
        read_turn,
        read_go,
    ):
        found = read(frame)
        if found is not None:
            _check_all_is_read(frame, read.__name__)
            return found
    raise NoMeaningError("nothing")


def _is_doorway_of_room(item: Item) -> bool:
    return item.value.kind == "named" and item.value.at_end and "into" in item.roles


LEFT_UNREAD = {
    "read_degrees": (*_MOVING, ItemKind.BACK, ItemKind.SECONDS),
    "read_wait": (ItemKind.STRAIGHT, ItemKind.OUT, ItemKind.BACK, ItemKind.AROUND),
    "read_stop": (ItemKind.STRAIGHT, ItemKind.BACK, ItemKind.AROUND, ItemKind.DEGREES),
    "_face": (*_MOVING, ItemKind.DISTANCE, ItemKind.SECONDS, ItemKind.BACK),
    "_around": (ItemKind.OUT, ItemKind.IN, ItemKind.TO_END, ItemKind.DEGREES),
    "read_back": (ItemKind.IN, ItemKind.STRAIGHT),
    "read_leave": (ItemKind.DISTANCE, ItemKind.TO_END, ItemKind.BACK, ItemKind.AROUND),
    "read_in": (ItemKind.BACK, ItemKind.AROUND, ItemKind.SECONDS),
}
"""Kinds of items that a reader takes no notice of, although they say something."""


def _check_all_is_read(frame: ClauseFrame, reader: str) -> None:
    """Refuse a clause of which a part would be dropped without a word.

    Raises:
        NoMeaningError: some part would be.
    """
    unread = [item.kind for item in frame.items if item.kind in LEFT_UNREAD.get(reader, ())]
    if unread and "away" not in frame.verbs:
        raise NoMeaningError(f"{unread[0]} is not read")


def _reverse(frame: ClauseFrame) -> Readings | None:
    """Of "reverse two metres" and "go two metres backwards"."""
    if "reverse" not in frame.verbs:
        return None
    distances = frame.of(ItemKind.DISTANCE)
    known = (ItemKind.VERB, ItemKind.DISTANCE, ItemKind.STRAIGHT, ItemKind.BACK)
    has_more = any(item.kind not in known for item in frame.items)
    if len(distances) != 1 or has_more or frame.verbs - {"reverse", "go", "continue", "back"}:
        raise NoMeaningError("backwards and something else")
    return ((BackUp(distances[0].value),),)


_FACED = ("named", "wall", "intersection", "corner", "t_junction", "end")


def _search(frame: ClauseFrame) -> Readings | None:
    """The verb "search the house" holds its object."""
    if "search" not in frame.verbs:
        return None
    if len(frame.items) > 1:
        raise NoMeaningError("search and something else")
    return ((SearchHouse(),),)


def _face(frame: ClauseFrame) -> Readings | None:
    faced = [item for item in frame.refs if "faced" in item.roles]
    if faced:
        return _faced(frame, faced[0])
    if "wall" in frame.verbs:
        if len(frame.sides) != 1 or frame.refs:
            raise NoMeaningError("the wall on which side")
        return ((Face(Side(frame.sides[0].value)),),)
    if "away" in frame.verbs:
        return _turned_away(frame)
    turns_to = (
        frame.verbs == {"turn"}
        and not frame.sides
        and len(frame.refs) == 1
        and bool(frame.roles(frame.refs[0]) & {"to", "toward"})
        and (is_door(frame.refs[0].value) or frame.refs[0].value.kind in _FACED)
    )
    if "face" not in frame.verbs and not turns_to:
        return None
    if len(frame.refs) != 1:
        raise NoMeaningError("face")
    noun = frame.refs[0].value
    if noun.kind in ("it", "hall", "start") or (noun.kind == "wall" and frame.sides):
        raise NoMeaningError("face")
    what = landmark(noun)
    if isinstance(what, DoorReference) and frame.sides:
        what = with_side(what, Side(frame.sides[0].value))
    return ((Face(what),),)


def _faced(frame: ClauseFrame, item: Item) -> Readings:
    """Of "So that the wall is on your left" and "so that the kitchen is ahead of you"."""
    noun: Noun = item.value
    if len(frame.refs) > 1 or frame.sides or frame.verbs - {"turn", "face", "stop", "go"}:
        raise NoMeaningError("so that, and something else")
    if noun.side is not None and noun.side in (Side.LEFT, Side.RIGHT):
        if noun.kind == "wall":
            return ((Face(noun.side),),)
        raise ValueError("one turns to what is ahead, or to have the wall on a side")
    what = landmark(replace(noun, side=None))
    return ((Face(what),),) if noun.side is Side.AHEAD else ((Face(what), Turn(Turning.AROUND)),)


def _turned_away(frame: ClauseFrame) -> Readings:
    """Of "With your back to the door, go straight": face it, and turn around."""
    noun = frame.refs[0].value if frame.refs else Noun("it")
    if noun.side is Side.AHEAD and noun.kind == "door":  # "zur Tür geradeaus fahren"
        noun = replace(noun, side=None)
        straight = Item(ItemKind.STRAIGHT, frame.refs[0].start, frame.refs[0].stop)
        frame = ClauseFrame((*frame.items, straight))
    known = noun.kind == "entry"  # with it behind it the robot came in
    first: Steps = () if known else (Face(landmark(noun)), Turn(Turning.AROUND))
    rest = tuple(item for item in frame.items if item is not frame.refs[0] and item.value != "away")
    plain = ClauseFrame(
        tuple(
            item for item in rest if item.kind is not ItemKind.VERB or item.value not in ("stop",)
        )
    )
    more = (
        readings_of(plain) if any(item.kind is not ItemKind.VERB for item in plain.items) else ((),)
    )
    return tuple((*first, *each) for each in more)


def _around(frame: ClauseFrame) -> Readings | None:
    if not (items := frame.of(ItemKind.AROUND)) or goes_around(frame):
        return None
    alone = any(item.value for item in items)
    if not alone and not frame.verbs & {"turn", "make", "take", "face"}:
        raise NoMeaningError("around")
    if frame.sides or frame.verbs - {"turn", "make", "take", "go", "continue", "face"}:
        raise NoMeaningError("around and a side")
    contexts, rest = contexts_of(frame)
    steps: Steps = (*contexts, *distances_of(frame), Turn(Turning.AROUND))
    for item in rest:
        roles = frame.roles(item)
        if roles & {"at", "in"} and not is_door(item.value) and item.value.kind != "it":
            place = landmark(item.value)
            if isinstance(place, PlaceReference):
                return ((*contexts, Turn(Turning.AROUND, place)),)
        if roles & {"in", "at"} and is_door(item.value) and item.value.doorway:
            door = landmark(item.value)
            assert isinstance(door, DoorReference)
            return ((GoToDoor(door, Approach.IN), Turn(Turning.AROUND)),)
        steps = (*steps, *moves(item.value, roles, frame.verbs - {"turn"}))
    return (steps,)
