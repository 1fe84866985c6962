"""Clauses without a turn: the way along, past and up to what they name."""

from __future__ import annotations

from dataclasses import replace

from semnav_env.language.clause_readings import (
    EnterMentionedDoor,
    Readings,
    Step,
    Steps,
)
from semnav_env.language.clauses import (
    Approach,
    Follow,
    GoToDoor,
    GoToRoom,
    Turn,
    Turning,
)
from semnav_env.language.references import (
    SOME,
    DoorReference,
    Place,
    PlaceReference,
    Side,
)
from semnav_env.language.speech.frame import (
    END,
    ClauseFrame,
    check_destinations,
    contexts_of,
    goes_around,
    moves_or_mention,
)
from semnav_env.language.speech.items import Item, ItemKind, Noun
from semnav_env.language.speech.moves import (
    NoMeaningError,
    is_door,
    landmark,
)
from semnav_env.language.speech.turning import read_sideless_turn


def read_go(frame: ClauseFrame) -> Readings | None:
    """A clause without a turn: the way along, past and up to what it names."""
    if frame.has(ItemKind.BACK, ItemKind.TWICE) or (
        frame.has(ItemKind.AROUND) and not goes_around(frame)
    ):
        raise NoMeaningError("back")
    if "turn" in frame.verbs and not frame.particles - {"ab"}:
        return read_sideless_turn(frame)
    if frame.verbs & {"turn", "make"}:
        raise NoMeaningError("turn where")
    if _says_nothing(frame):
        return ((),)
    contexts, rest = contexts_of(frame)
    steps: list[Step] = list(contexts)
    choices: Readings = ((),)
    for item in frame.items:
        if item.kind is ItemKind.STRAIGHT:
            steps.append(Follow())
        elif item.kind is ItemKind.DISTANCE:
            steps.append(Follow(item.value))
        elif item.kind is ItemKind.TO_END:
            steps.append(Follow(END))
        elif item.kind is ItemKind.REF and (same := [r for r in rest if r.start == item.start]):
            found = _named(same[0], frame, last=item is rest[-1])
            one, *more = found
            if more:
                choices = found
            else:
                steps += one
    if not rest and not steps and frame.verbs & {"continue"} and not frame.verbs & {"take"}:
        steps = [Follow()]
    if frame.goes_in and rest:
        in_hall = rest[-1].value.kind in ("end", "hall")
        steps, choices = _entered(steps, choices, in_hall)
        if rest[-1].value.kind == "named" and "through" in frame.roles(rest[-1]):
            steps.append(Follow(END))  # "durch das Lager hindurch"
    if contexts and not rest and "be" in frame.verbs and len(steps) == len(contexts):
        choices = (GoToDoor(DoorReference()),), (GoToDoor(DoorReference(), Approach.TO),)
    if not steps and choices == ((),):
        if frame.verbs & {"count", "cross"} or (frame.verbs == {"go"} and len(frame.items) == 1):
            return ((),)
        raise NoMeaningError("nothing to do")
    for choice in choices:
        check_destinations([*steps, *choice])
    return tuple(_joined((*steps, *choice)) for choice in choices)


def _says_nothing(frame: ClauseFrame) -> bool:
    """Of "You'll see two doors", "then you are in the lobby", "fahr da hin"."""
    if frame.verbs == {"go"} and all(item.value in ("ab", "go") for item in frame.items):
        return any(item.value == "ab" for item in frame.items)
    stands = bool(frame.verbs) and not frame.verbs - {"be", "reach"} and len(frame.refs) == 1
    plain = not frame.sides and not frame.has(ItemKind.IN, ItemKind.OUT)
    noun = frame.refs[0].value if stands and plain else None
    if noun is None:
        return False
    seen = is_door(noun) and noun.counted and not frame.roles(frame.refs[0])
    return seen or (noun.kind == "area" and bool(frame.roles(frame.refs[0]) & {"in", "into"}))


def _named(item: Item, frame: ClauseFrame, last: bool) -> Readings:
    """The readings of a noun in a clause without a turn."""
    noun, roles = item.value, frame.roles(item)
    verbs = frame.verbs
    if "past" in frame.particles and not roles:
        roles = frozenset({"past"})
    if "count" in verbs:
        return ((Follow(landmark(noun), past=True),),) if noun.counted else ((),)
    if noun.kind == "hall" and ("cross" in verbs or "across" in roles):
        return ((),)
    if noun.kind == "one" and noun.elliptic:
        return _left_out(noun, roles, frame)
    if is_door(noun) and "before" in roles and noun.kind != "one":
        roles = frozenset({"to"})
    if is_door(noun) and roles & {"at"} and not roles & {"to", "into", "past"}:
        if frame.has(ItemKind.STRAIGHT):
            return ((Follow(landmark(noun), past=True),),)
        return ((Follow(landmark(noun)),),)
    if (
        frame.has(ItemKind.STRAIGHT)
        and roles & {"at"}
        and not is_door(noun)
        and not roles & {"to", "until"}
        and noun.kind not in ("hall", "named", "end")
    ):
        return ((Follow(landmark(noun), past=True),),)
    along = any(other.value.kind == "hall" for other in frame.refs) or frame.has(ItemKind.STRAIGHT)
    if noun.kind == "named" and along and "until" in roles and "to" not in roles:
        return ((Follow(landmark(noun)),),)
    if noun.kind == "door" and roles & {"to"} and along and "into" not in roles:
        return ((Follow(landmark(noun)),),)
    if roles & {"before"} and not is_door(noun) and noun.kind != "named":
        if noun.kind in ("corner", "end", "t_junction", "wall"):
            return ((),)
        raise NoMeaningError("before a place")
    if roles & {"before"} and noun.kind == "named" and not roles & {"to"}:
        raise NoMeaningError("before a room")
    return moves_or_mention(noun, roles, frame)


def _left_out(noun: Noun, roles: frozenset[str], frame: ClauseFrame) -> Readings:
    """Of "Nimm die zweite links", where nothing was named before: a door, or a turning?"""
    if noun.side not in (Side.LEFT, Side.RIGHT):
        raise ValueError("the second what? name the door or the place")
    doors = moves_or_mention(noun, roles, frame)
    if roles or frame.goes_in:
        return doors
    side = Turning.LEFT if noun.side is Side.LEFT else Turning.RIGHT
    turn = Turn(side, PlaceReference(Place.TURNING, noun.ordinal or 1))
    return (turn,), *doors[-1:]


def _entered(steps: list[Step], choices: Readings, in_hall: bool) -> tuple[list[Step], Readings]:
    """The steps with the last door gone through instead of up to."""
    if choices != ((),):
        through = [
            choice
            for choice in choices
            if isinstance(choice[-1], GoToDoor) and choice[-1].approach is Approach.THROUGH
        ]
        return steps, tuple(through) or choices
    last = steps[-1] if steps else None
    if isinstance(last, Follow) and isinstance(last.until, DoorReference) and not last.past:
        return [*steps[:-1], GoToDoor(last.until)], choices
    if isinstance(last, GoToDoor):
        return [*steps[:-1], replace(last, approach=Approach.THROUGH)], choices
    along = isinstance(last, Follow) and last.until in (None, END) and not last.past
    if isinstance(last, GoToRoom) or (along and in_hall):
        return steps, choices  # "den Gang durch"
    return [*steps, EnterMentionedDoor()], choices


def _joined(steps: Steps) -> Steps:
    """The steps without "go down the hallway" and "go a bit" before one that says how far."""
    found: list[Step] = []
    for step in steps:
        goes_on = bool(found) and isinstance(step, Follow) and isinstance(found[-1], Follow)
        if goes_on and step in (Follow(), Follow(SOME)) and found[-1] != Follow():
            continue
        if goes_on and found[-1] in (Follow(), Follow(SOME)):
            found.pop()
        found.append(step)
    return tuple(found)
