"""Clauses with a side: "left at the corner", "rechts durch die Tür"."""

from __future__ import annotations

from dataclasses import replace

from semnav_env.language.clause_readings import (
    Readings,
    SideOfMentionedDoor,
    Step,
    Steps,
    at_reference,
)
from semnav_env.language.clauses import (
    Approach,
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
from semnav_env.language.speech.frame import (
    END,
    ClauseFrame,
    before_turn,
    contexts_of,
    distances_of,
    moves_or_mention,
    without_articles,
)
from semnav_env.language.speech.items import Item, ItemKind, Noun
from semnav_env.language.speech.moves import (
    NoMeaningError,
    is_door,
    landmark,
    moves,
)
from semnav_env.language.speech.turn_nouns import read_turn_into


def read_degrees(frame: ClauseFrame) -> Readings | None:
    """The readings of a turn by degrees; None if it is none."""
    if not (amounts := frame.of(ItemKind.DEGREES)):
        return None
    degrees = amounts[0].value
    if degrees != int(degrees):
        raise ValueError(f"{degrees:g} is not a whole number of degrees")
    if (
        frame.refs
        or len(amounts) > 1
        or len(frame.sides) > 1
        or frame.verbs - {"turn", "go", "make", "take"}
    ):
        raise NoMeaningError("degrees and something else")
    if degrees == 180 and not frame.sides:
        return ((Turn(Turning.AROUND),),)
    ways = frame.sides or (Turning.LEFT, Turning.RIGHT)
    before = distances_of(frame)
    return tuple((*before, Turn(way, degrees=int(degrees))) for way in ways)


def read_turn(frame: ClauseFrame) -> Readings | None:
    """A clause with a side."""
    if not frame.sides:
        return read_turn_into(frame)
    if "past" in frame.particles and not frame.refs:
        raise NoMeaningError("past what")
    if frame.verbs - {
        "turn",
        "go",
        "take",
        "make",
        "continue",
        "enter",
        "follow",
        "be",
        "in",
        "along",
        "cross",
    }:
        raise NoMeaningError("a side and another verb")
    if len(frame.sides) > 1:
        return _turns(frame)
    way = next(iter(frame.sides))
    contexts, rest = contexts_of(frame)
    doors = [item for item in rest if is_door(item.value) and _takes_side(item, frame)]
    taken = any("a" in item.roles for item in frame.of(ItemKind.SIDE))  # "it's a right"
    if taken:
        frame = without_articles(frame)
    if taken and frame.verbs == {"be"} and not rest:
        return ((*contexts, Turn(way)),)
    if frame.verbs == {"be"} and not rest and not any(is_door(i.value) for i in frame.refs):
        door = DoorReference(1, Side(way.value))
        return (*contexts, GoToDoor(door)), (*contexts, GoToDoor(door, Approach.TO))
    if doors:
        return _door_on_side(frame, contexts, rest, way)
    if "be" in frame.verbs and len(rest) == 1 and rest[0].value.kind == "named":
        return ((*contexts, *moves(rest[0].value, frame.roles(rest[0]), frame.verbs)),)
    into_hall = bool(rest) and all(_is_no_door(item) for item in rest)
    if frame.goes_in and not into_hall:
        others = tuple(step for item in rest for step in before_turn(item, frame))
        return ((*contexts, *others, GoToDoor(DoorReference(1, Side(way.value)))),)
    return _turn_among(frame, contexts, rest, way)


def _is_no_door(item: Item) -> bool:
    """Whether one turns there and enters nothing: "rechts in den Gang hinein"."""
    at_place = item.value.kind in ("intersection", "t_junction") and "at" in item.roles
    return item.value.kind in ("hall", "turning") or at_place


def read_sideless_turn(frame: ClauseFrame) -> Readings:
    """Of "Turn at the corner": to the left or to the right?"""
    if len(frame.refs) > 1 or any("at" not in frame.roles(item) for item in frame.refs):
        raise NoMeaningError("turn where")
    side = (
        Item(ItemKind.SIDE, frame.items[-1].stop, frame.items[-1].stop, each) for each in _SIDES
    )
    found = (read_turn(ClauseFrame((*frame.items, each))) for each in side)
    return tuple(steps for readings in found for steps in readings or ())


_SIDES = (Side.LEFT, Side.RIGHT)


def _turns(frame: ClauseFrame) -> Readings | None:
    if frame.refs or frame.has(ItemKind.DISTANCE):
        raise NoMeaningError("two sides")
    raise NoMeaningError("two sides")


def _takes_side(item: Item, frame: ClauseFrame) -> bool:
    """Whether a door takes a side that stands elsewhere in the clause."""
    roles = frame.roles(item)
    through = bool(roles & {"into", "through"}) or (
        not roles and (frame.verbs & {"enter", "take", "be"} or frame.goes_in)
    )
    at_door = not roles and not frame.verbs
    german = bool(roles & {"to", "until"}) and item.value.side is None
    return (
        (bool(through) or at_door or german)
        and item.value.side in (None, Side(frame.sides[0].value))
        and not item.value.counted
    )


def _door_on_side(frame: ClauseFrame, contexts: Steps, rest: list[Item], way: Turning) -> Readings:
    side = Side(way.value)
    steps: Steps = contexts
    split: Steps | None = None
    for item in rest:
        noun = item.value
        if is_door(noun) and _takes_side(item, frame):
            plain = moves_or_mention(noun, frame.roles(item), frame)
            sided = moves_or_mention(replace(noun, side=side), frame.roles(item), frame)
            roles = frame.roles(item)
            if roles & {"to", "until"} and "into" not in roles:
                split = (*steps, Turn(way), *plain[0])
                before = steps
                return tuple((*before, *each) for each in sided) + (
                    (split,) if noun.side is None else ()
                )
            one, *more = sided
            if more:
                return tuple((*steps, *each) for each in sided)
            steps = (*steps, *one)
        else:
            steps = (*steps, *before_turn(item, frame))
    return (steps,)


def _turn_among(frame: ClauseFrame, contexts: Steps, rest: list[Item], way: Turning) -> Readings:
    """A turn, with what is said before and after it."""
    side_at = frame.of(ItemKind.SIDE)[0].start
    before: list[Step] = list(contexts)
    after: list[Step] = []
    turn = Turn(way)
    at_door: DoorReference | None = None
    for item in frame.items:
        later = item.start > side_at
        steps = after if later else before
        if item.kind is ItemKind.DISTANCE:
            steps.append(Follow(item.value))
        elif item.kind is ItemKind.STRAIGHT and not frame.has(ItemKind.REF):
            steps.append(Follow())
        elif item.kind is ItemKind.TO_END:
            steps.append(Follow(END))
        if item not in rest:
            continue
        noun, roles = item.value, frame.roles(item)
        if "before" in roles and not roles & {"at", "to", "past"} and noun.kind != "named":
            raise NoMeaningError("turn before a place")
        if noun.kind in ("it", "start", "way back"):
            continue
        if noun.kind in ("hall", "turning"):
            turn, more = _turn_hall(noun, roles, turn)
            steps += more
        elif noun.kind == "named":
            if roles & {"at", "near", "before"} and not roles & {"into"}:
                before.append(Follow(landmark(noun)))
            else:
                steps += moves(noun, roles, frame.verbs - {"turn"})
        elif is_door(noun) and not roles and noun.side not in (None, Side(way.value)):
            raise NoMeaningError("two sides")  # "right, third door left"
        elif is_door(noun) and (roles & {"at", "near"} or not roles):
            door = landmark(noun)
            assert isinstance(door, DoorReference)
            at_door = door
        elif is_door(noun):
            if noun.side is not None and roles & {"into", "through", "to"}:
                raise NoMeaningError("two sides")
            steps += moves(noun, roles, frozenset({"go"}))
        elif (
            (roles & {"at", "near", "in", "around"} and "until" not in roles)
            or not roles
            or (later and not roles & {"until", "past", "through", "to"})
        ):
            place = landmark(noun)
            if not isinstance(place, PlaceReference) or turn.at is not None:
                raise NoMeaningError("two places")
            if noun.side is not None and noun.side.value != turn.turning.value:
                raise NoMeaningError("two sides")  # "crossing left, next one right"
            turn = replace(turn, at=place)
        else:
            steps += moves(noun, roles, frozenset({"go"}))
    if frame.has(ItemKind.TWICE):
        if rest or turn.at is not None:
            raise NoMeaningError("twice there")
        return ((turn, turn),)
    if len(frame.items) == 1 and frame.items[0].roles:
        return ((SideOfMentionedDoor(Side(way.value)),),)
    if frame.of(ItemKind.SIDE)[0].roles and not frame.verbs & {"turn", "make", "take", "go"}:
        raise NoMeaningError("a side is no turn")  # "the second door, on the left side"
    if frame.of(ItemKind.SIDE)[0].roles and "ab" in {i.value for i in frame.of(ItemKind.PARTICLE)}:
        raise NoMeaningError("along a side")
    if len(frame.items) == 1:
        return (turn,), (SideOfMentionedDoor(Side(way.value)),)
    if at_door is not None:
        stripped = at_door
        turned = at_reference(stripped, (turn,))
        return tuple((*before, *each, *after) for each in turned)
    return ((*before, turn, *after),)


def _turn_hall(noun: Noun, roles: frozenset[str], turn: Turn) -> tuple[Turn, Steps]:
    """A turn into a hallway, or the way down it."""
    if noun.side is not None and noun.side.value != turn.turning.value:
        raise NoMeaningError("two sides")
    numbered = noun.ordinal is not None or noun.kind == "turning"
    if numbered:
        if turn.at is not None:
            raise NoMeaningError("two places")
        if noun.kind == "turning" and noun.ordinal is None and not noun.definite:
            return turn, ()
        return replace(turn, at=PlaceReference(Place.TURNING, noun.ordinal or 1)), ()
    if roles & {"into", "in", "through", "at", "on", "to"} and not roles & {"along"}:
        return turn, ()
    return turn, (Follow(),)
