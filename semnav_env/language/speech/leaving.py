"""Clauses that lead out, back or in: "come out", "go back to the corner", "da rein"."""

from __future__ import annotations

from dataclasses import replace

from semnav_env.language.clause_readings import (
    EnterMentionedDoor,
    Readings,
    Step,
    Steps,
    TurnBack,
)
from semnav_env.language.clauses import (
    Follow,
    GoBack,
    GoToDoor,
    GoToRoom,
    Leave,
    Turn,
    Turning,
)
from semnav_env.language.references import (
    DoorReference,
    PlaceReference,
    Side,
)
from semnav_env.language.rooms import plain_name
from semnav_env.language.speech.frame import END, ClauseFrame, distances_of, to_end
from semnav_env.language.speech.items import Item, ItemKind, Noun
from semnav_env.language.speech.moves import (
    NoMeaningError,
    is_door,
    is_this_room,
    landmark,
    moves,
    with_side,
)


def read_back(frame: ClauseFrame) -> Readings | None:
    """The readings of a clause that leads back; None if it does not."""
    returns = frame.verbs & {"return", "back"}
    if any(item.value.counted for item in frame.refs) and (returns or frame.has(ItemKind.BACK)):
        raise NoMeaningError("back several things")
    if not returns and not frame.has(ItemKind.BACK) and not _is_way_back(frame):
        return None
    if (
        frame.goes_out
        or frame.verbs & {"leave"}
        or any("out" in frame.roles(r) for r in frame.refs)
    ):
        return ((Leave(),),)
    if frame.verbs - {"return", "back", "go", "continue", "turn", "follow"}:
        raise NoMeaningError("back and something else")
    steps: Steps = ()
    for item in frame.refs:
        steps = (*steps, *_back_to(item.value, frame.roles(item)))
    turns = tuple(Turn(way) for way in frame.sides)
    if steps:
        starts = any(item.value.kind == "start" for item in frame.refs)
        if starts and len(steps) > 1:
            raise NoMeaningError("back to two places")
        many = tuple(step for step in steps if step != GoBack() or len(steps) == 1)
        return ((*many, *turns),)
    if turns:
        raise NoMeaningError("back and a side")
    if frame.has(ItemKind.TO_END):
        return ((Turn(Turning.AROUND), Follow(END)),)
    if amounts := distances_of(frame):
        return ((TurnBack(), *amounts),)
    if "return" in frame.verbs or _is_way_back(frame):
        return ((GoBack(),),)
    return (GoBack(),), (Turn(Turning.AROUND), Follow())


def _is_way_back(frame: ClauseFrame) -> bool:
    return any(item.value.kind == "way back" for item in frame.refs) and not frame.verbs & {
        "leave",
        "turn",
    }


def _back_to(noun: Noun, roles: frozenset[str]) -> Steps:
    """Back along the way to the last thing of a kind: the first one after turning around."""
    if noun.kind in ("start", "way back", "it"):
        return (GoBack(),)
    if noun.kind == "entry":
        return moves(noun, roles or frozenset({"to"}), frozenset({"go"}))
    if noun.kind == "hall":
        return (TurnBack(), Follow())
    if noun.kind == "named" and "until" in roles:
        return (Follow(landmark(noun)),)
    if noun.kind == "named":
        return (GoToRoom(plain_name(noun.name)),)
    place = landmark(noun)
    around: Step = TurnBack()
    if isinstance(place, DoorReference | PlaceReference) and place.ordinal == -1:
        place = replace(place, ordinal=1)
    if isinstance(place, DoorReference) and roles & {"into", "through"}:
        return (around, GoToDoor(place))
    return (around, Follow(place))


def read_leave(frame: ClauseFrame) -> Readings | None:
    """The readings of a clause that leads out; None if it does not."""
    if not (
        "leave" in frame.verbs
        or frame.goes_out
        or any("out" in frame.roles(r) and "into" not in frame.roles(r) for r in frame.refs)
    ):
        return None
    if (left := _left_to_side(frame)) is not None:
        return left
    if frame.verbs - {"leave", "let", "exit", "go", "out", "continue", "follow", "take"}:
        raise NoMeaningError("leave and something else")
    doors = [
        r
        for r in frame.refs
        if is_door(r.value) and not is_this_room(r.value) and not _is_bare_way_out(r, frame)
    ]
    rest = [r for r in frame.refs if r not in doors and not _is_left(r, frame)]
    turns = tuple(Turn(way) for way in frame.sides)
    if len(turns) > 1 or (turns and any("at" in frame.roles(r) for r in rest)):
        raise NoMeaningError("leave and two turns")
    if (
        frame.goes_out
        and len(rest) == 1
        and rest[0].value.kind == "end"
        and not doors
        and not turns
    ):
        return ((GoToDoor(DoorReference(1, Side.AHEAD)),),)
    if frame.goes_out and not frame.refs and any(p in ("ahead",) for p in frame.particles):
        return ((GoToDoor(DoorReference(1, Side.AHEAD)),),)
    if (
        turns
        and frame.goes_out
        and not doors
        and len(frame.refs) == 1
        and any(
            _is_bare_way_out(r, frame) and is_door(r.value) and r.value.kind == "door"
            for r in frame.refs
        )
    ):
        return ((GoToDoor(DoorReference(1, Side(frame.sides[0].value))),),)
    if doors and _leads_on(frame, doors[-1]):
        return ((Leave(), *turns, *moves(doors[-1].value, frozenset({"through"}), frozenset())),)
    if doors:
        plain = [r for r in doors if r.value.ordinal is None and r.value.side is None]
        door = landmark(doors[-1].value)
        assert isinstance(door, DoorReference)
        if turns and frame.goes_out and door.side is None:
            door, turns = with_side(door, Side(frame.sides[0].value)), ()
        if plain and not turns and not rest:
            return ((GoToDoor(door),),)
        if "let" in frame.verbs and not frame.roles(doors[-1]) and door.side is not None:
            return (GoToDoor(door),), (Follow(door, past=True),)
        return ((GoToDoor(door), *turns),)
    steps: Steps = (Leave(), *turns)
    for item in rest:
        if item.value.kind != "hall" or not frame.roles(item) & {"to", "into"}:
            steps = (*steps, *moves(item.value, frame.roles(item), frozenset({"go"})))
    if frame.has(ItemKind.STRAIGHT):
        steps = (*steps, Follow())
    if (
        turns
        and len(steps) == 2
        and frame.goes_out
        and not frame.refs
        and "leave" not in frame.verbs
    ):
        side = Side(frame.sides[0].value)
        return steps, (GoToDoor(DoorReference(1, side)),)
    return (steps,)


def _left_to_side(frame: ClauseFrame) -> Readings | None:
    """Of "Out of the room right": the room around has no side, so one turns to it."""
    if len(frame.refs) != 1 or frame.sides or frame.verbs - {"leave", "exit", "go", "turn"}:
        return None
    noun = frame.refs[0].value
    sided = noun.kind == "room" and noun.ordinal is None and noun.side in (Side.LEFT, Side.RIGHT)
    plain = all(item.kind in (ItemKind.REF, ItemKind.VERB) for item in frame.items)
    if not sided or not plain or "out" not in frame.roles(frame.refs[0]):
        return None
    return ((Leave(), Turn(Turning(noun.side.value))),)


def _leads_on(frame: ClauseFrame, door: Item) -> bool:
    """Of "Out, right, second door on the left": what is said in the order in which it is done."""
    kinds = [item.kind for item in frame.items]
    sides = kinds.count(ItemKind.SIDE)
    told = kinds == [ItemKind.OUT, *[ItemKind.SIDE] * sides, ItemKind.REF]
    return told and sides == 1 and door.value.side is not None and "out" not in door.roles


def _is_bare_way_out(item: Item, frame: ClauseFrame) -> bool:
    """Of "Out the door", "zur Tür hinaus": the door by which the robot came."""
    noun, roles = item.value, frame.roles(item)
    if noun.side is not None or noun.ordinal is not None or noun.at_end or noun.kind == "entry":
        return False
    return "out" in roles or (frame.goes_out and not roles & {"into", "through", "by"})


def _is_left(item: Item, frame: ClauseFrame) -> bool:
    """Whether an item is what one leaves."""
    noun, roles = item.value, frame.roles(item)
    return (
        noun.kind in ("it", "one")
        or "out" in roles
        or (_is_bare_way_out(item, frame) and is_door(noun))
        or (noun.kind in ("room", "named", "door", "area") and not roles)
    )


def read_in(frame: ClauseFrame) -> Readings | None:
    """Of "... and go in": the door that was mentioned before; with a side, the door there."""
    if not frame.goes_in or frame.refs:
        return None
    if frame.verbs - {"go", "in", "take", "continue", "enter"} or frame.has(ItemKind.DISTANCE):
        raise NoMeaningError("in and something else")
    if frame.sides:
        door = GoToDoor(DoorReference(1, Side(frame.sides[-1].value)))
        if len(frame.sides) > 1:
            raise NoMeaningError("two sides")
        return ((*to_end(frame), door),)
    if frame.has(ItemKind.TO_END):
        return ((Follow(END),),)
    return ((EnterMentionedDoor(),),)
