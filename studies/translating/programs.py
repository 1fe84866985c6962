"""From a meaning in the notation of the corpora to a command; the inverse of `meaning_of`."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from semnav_env.language.clauses import (
    Approach,
    BackUp,
    Clause,
    Face,
    Follow,
    GoBack,
    GoToDoor,
    GoToRoom,
    IfThere,
    Leave,
    Pace,
    Speed,
    Stop,
    Turn,
    Turning,
    waits_of,
)
from semnav_env.language.command import Command
from semnav_env.language.corpora.meanings import ENDS, meaning_of, normal, room_with_door
from semnav_env.language.corpora.notation import Step, Steps
from semnav_env.language.finding_clauses import (
    AskName,
    CallOut,
    GoToPerson,
    LookAround,
    SearchHouse,
    SearchRoom,
)
from semnav_env.language.references import (
    ENTRY,
    OTHER,
    SOME,
    Distance,
    DoorReference,
    DoorRelation,
    Place,
    PlaceOffset,
    PlaceReference,
    Relation,
    RoomReference,
    Side,
    Unit,
    to_half_metre,
)
from semnav_env.language.rooms import plain_name

FINDING: dict[Step, Clause] = {
    ("search", "house"): SearchHouse(),
    ("search", "here"): SearchRoom(),
    ("look",): LookAround(),
    ("call",): CallOut(),
    ("to", "person"): GoToPerson(),
    ("ask",): AskName(),
}
"""The steps to find people that have no open field."""


def command_of_meaning(steps: Steps) -> Command | None:
    """A command that means the same as the steps; None if there is none."""
    try:
        command = Command(tuple(clause for step in steps for clause in _clauses(step)))
    except ValueError:
        return None
    return command if normal(meaning_of(command)) == normal(steps) else None


def _clauses(step: Step) -> list[Clause]:
    if step in FINDING:
        return [FINDING[step]]
    match step:
        case ("hallway",):
            return [Follow()]
        case ("cross",):
            return [Follow(PlaceReference(Place.END))]
        case ("hallway", "for", *distance):
            return [Follow(_distance(*distance))]
        case ("hallway", "until" | "past" as relation, place):
            before, what = _place(place)
            return [*before, Follow(what, relation == "past")]
        case ("along", side, *rest):
            *before, follow = _clauses(("hallway", *rest))
            assert isinstance(follow, Follow)
            return [*before, replace(follow, along=Side(side))]
        case ("slow" | "fast" as speed,):
            return [Pace(Speed(speed))]
        case ("turn by", way, degrees):
            return [Turn(Turning(way), degrees=degrees)]
        case ("turn", way, None):
            return [Turn(Turning(way))]
        case ("turn", way, place):
            before, what = _place(place)
            at_place = isinstance(what, PlaceReference)
            if at_place:
                return [*before, Turn(Turning(way), what)]
            return [*before, Follow(what), Turn(Turning(way))]
        case ("through" | "to" | "in" | "leave" as verb, place):
            before, what = _place(place)
            approach = Approach("through" if verb == "leave" else verb)
            if isinstance(what, RoomReference):
                return [*before, GoToRoom(what.name, approach)]
            if isinstance(what, DoorReference):
                return [*before, GoToDoor(what, approach)]
            return [*before, Follow(what)]
        case ("room", name):
            return [GoToRoom(plain_name(name))]
        case ("leave",):
            return [Leave()]
        case ("back",):
            return [GoBack()]
        case ("back", place):
            before, what = _place(place)
            return [Turn(Turning.AROUND), *before, Follow(what)]
        case ("face", ("wall", str(side))):
            return [Face(Side(side))]
        case ("face", place):
            before, what = _place(place)
            return [*before, Face(what)]
        case ("wait", seconds):
            return [*waits_of(int(seconds))]
        case ("reverse", ("distance", *distance)):
            return [BackUp(_distance(*distance))]
        case ("stop",):
            return [Stop()]
        case ("search", ("room", name)):
            return [SearchRoom(RoomReference(plain_name(name)))]
        case ("if", *_):
            return _condition(step)
    raise ValueError(f"{step!r} is no clause")


def _distance(amount: float | str, unit: str = "") -> Distance:
    if isinstance(amount, str):
        return SOME
    if unit == "m":
        return Distance(to_half_metre(amount))
    return Distance(amount, Unit.STEPS)


def _condition(step: Step) -> list[Clause]:
    """A condition with its clauses; `command_of_meaning` drops what then means another thing."""
    _, word, place, then, otherwise = step
    place = room_with_door(word, place)
    if place[0] == "room":  # whether it is open is seen in front of it
        door, in_front = ("door", 1, None, None, None), ("to", place)
        enter = tuple(("through", door) if each == place else each for each in then)
        other = tuple(("through", door) if each == place else each for each in otherwise)
        return [*_clauses(in_front), *_condition(("if", word, door, enter, other))]
    before, first = _place(place)
    if normal((step,)) == normal((("through", place),)):  # the first open one
        return [*before, GoToDoor(first)]
    absent = word in ("no", "closed")
    cases = [[clause for each in case for clause in _clauses(each)] for case in (then, otherwise)]
    condition = IfThere(first, absent, len(cases[1]), len(cases[0]))
    return [*before, condition, *cases[0], *cases[1]]


def _place(place: Step) -> tuple[list[Clause], Any]:
    """A place, and the clauses that lead to where it is counted from."""
    match place:
        case ("room", name):
            return [], RoomReference(plain_name(name))
        case ("offset", distance, relation, other):
            before, what = _place(other)
            return before, PlaceOffset(_distance(*distance), Relation(relation), what)
        case ("wall", int()):
            return [], PlaceReference(Place.END)
        case ("door", ordinal, side, relation, others):
            named = {"other": OTHER, "entry": ENTRY, "any": 1, "nearest": 1}
            counted = named[ordinal] if ordinal in named else int(ordinal)
            door = DoorReference(counted, side and Side(side))
            return _relation(relation, others, door)
        case (kind, ordinal):
            return [], PlaceReference(Place(kind.replace("-", "_")), ordinal)
    raise ValueError(f"{place!r} is no place")


def _relation(
    relation: str | None, others: Any, door: DoorReference
) -> tuple[list[Clause], DoorReference]:
    if relation is None:
        return [], door
    first = others[0]
    if relation == "before" and first[0] in ENDS:
        return [], door
    if relation in ("after", "between"):
        before, what = _place(first)
        return [*before, Follow(what, past=True)], door
    if relation == "at" and first[0] == "end":
        return [], DoorReference(1, Side.AHEAD) if door.side is None else DoorReference(
            -1, door.side
        )
    if relation == "at" and door.side is Side.OPPOSITE:
        return [Follow(_place(first)[1])], door
    before, what = _place(first)
    return before, replace(door, relation=DoorRelation(relation), to=what)
