"""A command as steps of the notation, and which steps mean the same.

The equivalences, each true by the rules of docs/concepts/commands.md:

1. "hallway" before a step that says how far, where to turn or which door, adds nothing.
2. "hallway" at the end, and "cross" in a room, lead to the end; also along a wall.
3. A turn after "hallway" or "past" is at the next turning; after "until" a place, it is there.
4. "through D after P" is "past P; through D"; a door "between P and Q" is behind P and before Q;
    "if D after P" is decided behind P, too.
5. Doors on one side count on: "past door(2,left); through door(1,left)" is the third on the left.
6. "until D" or "to D", then through that door, is through D.
7. Only open doors count, so a closed door is none, and any door is the first.
8. A corner and the end are where the hallway ends, so "before" them limits nothing; a door
   "at end" is the one ahead, or the last one of its side.
9. "back to P" is to turn around and to go on until the next P.
10. "leave D" is "through D"; a "stop" at the end adds nothing, nor does one before a "wait".
11. A turn that depends on a place is made there.
12. Places of a kind that are passed one after the other add up.
13. "until D" is "to D" at the end and before a stop: the door is reached.
14. Whether a room is open is seen in front of it, and its door is then the first one; "the door
    at the kitchen is closed" is the same as "the kitchen is closed".
15. "hallway for some" before a step that says where to adds nothing to "hallway".
16. "through door(entry)" and "leave door(entry)" are "leave".
17. "hallway past P; hallway for 2 m" is "hallway until 2 m after P".
18. Metres are driven to the next half.
19. "room(kitchen); search here" is "search room(kitchen)".
20. "to person; ask" is "ask", which leads to a person.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from semnav_env.language.command import Command
from semnav_env.language.corpora.notation import Step, Steps, notation_of, read_meaning
from semnav_env.language.references import to_half_metre
from semnav_env.language.rooms import plain_name

_FIRST = ("door", 1, None, None, None)

ENDS = ("corner", "end", "t-junction")
"""Places at which a hallway ends, so that no door lies behind them."""


def meaning_of(command: Command) -> Steps:
    """The steps of a command, with conditions around those that depend on them.

    Raises:
        TypeError: a clause has no step in the notation.
    """
    return read_meaning(notation_of(command))


def key_of(command: Command) -> object:
    """A key that is equal for commands of the same meaning (docs/concepts/commands.md)."""
    try:
        return normal(meaning_of(command))
    except TypeError:  # a clause without a step in the notation, such as a search
        return command


def normal(steps: Steps) -> Steps:
    """The same steps in the one form in which two meanings are compared."""
    plain = [part for step in _ends(steps) for part in _unfolded(step)]
    found: list[Step] = []
    for step in plain:
        _append(found, step)
    while len(found) > 1 and found[-1] == ("stop",):
        found.pop()
    match found[-1:]:
        case [("hallway", "until", ("door", *_) as door)]:
            found[-1] = ("to", tuple(door))
    if found and found[-1] == ("hallway",):
        found[-1] = ("hallway", "until", ("end", 1))
    match found[-1:]:
        case [("along", _) as along]:
            found[-1] = (*along, "until", ("end", 1))
    return tuple(found)


def _ends(value: Any) -> Any:
    """The same with plain names of rooms, half metres, and the wall ahead as the end."""
    match value:
        case ("room", str(name)):
            return ("room", plain_name(name))
        case ("wall", int()):
            return ("end", 1)
        case (*before, float(metres), "m"):
            return (*map(_ends, before), to_half_metre(metres), "m")
        case tuple():
            return tuple(map(_ends, value))
    return value


def _unfolded(step: Step) -> list[Step]:
    """A step as the plainer ones that it stands for."""
    match step:
        case ("cross",):
            return [("hallway", "until", ("end", 1))]
        case ("back", place):
            return [("turn", "around", None), ("hallway", "until", place)]
        case ("through" | "leave", ("door", "entry", *_)):
            return [("leave",)]
        case ("leave", door):
            return _with_door(("through",), door)
        case ("through" | "to" | "in" | "face" as verb, ("door", *_) as door):
            return _with_door((verb,), tuple(door))
        case ("hallway", "until" | "past" as relation, ("door", *_) as door):
            return _with_door(("hallway", relation), tuple(door))
        case ("turn", way, ("room", _) as room):
            return [("hallway", "until", room), ("turn", way, None)]
        case ("turn", way, ("door", *_) as door):
            return [*_with_door(("hallway", "until"), tuple(door)), ("turn", way, None)]
        case ("if", word, what, then, otherwise):
            what = room_with_door(word, what)
            if what[0] == "room":
                cases = (
                    tuple(("through", _FIRST) if each == what else each for each in case)
                    for case in (then, otherwise)
                )
                there = ("if", word, _FIRST, *cases)
                return [("to", what), *_unfolded(there)]
            absent = {"closed": "no", "open": "there"}.get(word, word)
            if absent == "no" and otherwise:
                absent, then, otherwise = "there", otherwise, then
            then = _turned_at(what, then) if absent == "there" else then
            before, first = _plain(what)
            if first[:2] == ("door", 1) and normal(then) == (("through", first),):
                second = ("door", 2, *first[2:])
                if normal(otherwise) == (("through", second),):
                    return [*before, ("through", first)]  # the first open one
            return [*before, ("if", absent, first, normal(then), normal(otherwise))]
    return [step]


def room_with_door(word: str, what: Step) -> Step:
    """What a condition is on: of "if the door at the kitchen is closed", the kitchen."""
    match word, what:
        case "closed" | "open", ("door", 1, None, "at", (("room", _) as room,)):
            return tuple(room)
    return what


def _turned_at(place: Step, then: Steps) -> Steps:
    """The steps of a condition with a turn at the place that it asks for."""
    match then:
        case (("turn", "left" | "right" as way, None),) if place[0] not in ("door", "room"):
            return (("turn", way, place),)
    return then


def _with_door(verb: tuple[str, ...], door: Step) -> list[Step]:
    before, plain = _plain(door)
    return [*before, (*verb, plain)]


def _plain(place: Step) -> tuple[list[Step], Step]:
    """A door without a relation that can be said by other steps, and these steps."""
    if place[0] != "door":
        return [], place
    _, ordinal, side, relation, others = place
    ordinal = 1 if ordinal in ("any", "nearest") else ordinal
    before: list[Step] = []
    if others is None:
        return before, ("door", ordinal, side, None, None)
    if relation in ("after", "between"):
        return [("hallway", "past", others[0])], ("door", ordinal, side, None, None)
    if relation == "before" and others[0][0] in ENDS:
        return before, ("door", ordinal, side, None, None)
    if relation == "at" and side == "opposite":
        return [("hallway", "until", others[0])], ("door", ordinal, side, None, None)
    if relation == "at" and others[0][0] == "end":
        ordinal, side = (1, "ahead") if side is None else (-1, side)
        relation, others = None, None
    return before, ("door", ordinal, side, relation, others)


def _append(found: list[Step], step: Step) -> None:
    """Add a step; what it makes needless of the step before is taken away."""
    before = found[-1] if found else None
    match before, step:
        case ("hallway",), ("turn", "left" | "right" as way, None):
            found[-1:] = [("turn", way, ("turning", 1))]
        case ("hallway", "for", "some"), (verb, *rest) if _says_where(verb, rest):
            found[-1:] = [("hallway",)]
            _append(found, step)
        case ("hallway", "past", place), ("hallway", "for", *distance):
            found[-1:] = [("hallway", "until", ("offset", tuple(distance), "after", place))]
        case ("to" | "in", _), ("stop",):
            pass
        case ("room", _) as room, ("search", "here"):
            found[-1:] = [("search", room)]
        case ("to", "person"), ("ask",):
            found[-1:] = [step]
        case ("stop",), ("wait", _):
            found[-1:] = [step]
        case ("wait", float(first)), ("wait", seconds):
            found[-1:] = [("wait", first + seconds)]
        case ("turn", "around", None), ("turn", "around", None):
            found.append(step)
        case ("hallway",), ("hallway", *_) | ("through" | "to" | "in" | "room", *_):
            found[-1:] = [step]
        case ("hallway",), ("turn", _, (_, *_)):
            found[-1:] = [step]
        case ("hallway", "past", _), ("turn", "left" | "right" as way, None):
            found.append(("turn", way, ("turning", 1)))
        case ("hallway", "until", (kind, _) as place), ("turn", way, None) if kind != "wall":
            found[-1:] = [("turn", way, place)]
        case ("hallway", "until", (kind, _) as place), ("turn", way, (same, 1)) if (
            same in (kind, "turning") and kind != "room"
        ):
            found[-1:] = [("turn", way, place)]
        case ("hallway", "past", (kind, int(n))), ("hallway", "past", (other, int(m))) if (
            kind == other and n > 0 and m > 0
        ):
            found[-1:] = [("hallway", "past", (kind, n + m))]
        case ("hallway", "past", ("door", int(n), side, None, None)), (
            *verb,
            ("door", int(m), other, relation, places),
        ) if side == other and n > 0 and m > 0 and relation != "at":
            found.pop()
            _append(found, (*verb, ("door", n + m, side, relation, places)))
        case ("hallway", "until", door), ("through" | "to" | "in" as verb, again) if _same_door(
            door, again
        ):
            found[-1:] = [(verb, door)]
        case ("to", door), ("through" | "in" as verb, again) if _same_door(door, again):
            found[-1:] = [(verb, door)]
        case _:
            found.append(step)


def _says_where(verb: str, rest: Sequence[object]) -> bool:
    """Whether a step says where a way along the hallway ends."""
    if verb == "hallway":
        return rest[:1] != ["for"]
    return verb in ("through", "to", "in", "room") or (verb == "turn" and rest[0] != "around")


def _same_door(door: Step, again: Step) -> bool:
    """Whether a step names the door to which the step before it led."""
    if door[0] != "door" or again[0] != "door":
        return False
    return again == door or (again[1] == 1 and again[2] in (door[2], None, "ahead"))
