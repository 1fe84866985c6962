"""Reads meanings in the notation of docs/meanings.md: "hallway past door(1); through door(1,left)".

A meaning becomes a tuple of steps, each a tuple of plain values, so that it can be compared with
the steps of a command (`semnav_env.language.corpora.meanings`).
"""

from __future__ import annotations

import re
from typing import Any, TypeAlias

Step: TypeAlias = tuple[Any, ...]
Steps: TypeAlias = tuple[Step, ...]

NAMED_ORDINALS = ("nearest", "any", "other")
DOOR_SIDES = ("left", "right", "ahead", "behind", "opposite")

_CONDITION = re.compile(r"if ([^:]+): ?(.*?)(?: else: ?(.*))? end")
_BEFORE_PLACE = re.compile(r"(?:until|past|at|to|face|after|before)$")


def read_meaning(text: str) -> Steps:
    """The steps of a meaning.

    Raises:
        ValueError: it is not in the notation; the message names the step.
    """
    return tuple(_step(part) for part in _parts(text))


def _parts(text: str) -> list[str]:
    """The steps of a text; a condition with the steps that depend on it is one of them."""
    parts: list[str] = []
    is_open = False
    for part in (each.strip() for each in text.split(";")):
        if is_open:
            parts[-1] += f"; {part}"
        else:
            parts.append(part)
        begins = part.startswith("if ")
        if begins or is_open:
            closes = part.endswith(" end") and not _BEFORE_PLACE.search(part.removesuffix(" end"))
            is_open = not closes
    return parts


def _step(text: str) -> Step:
    if condition := _CONDITION.fullmatch(text):
        what, then, otherwise = condition.groups()
        return (
            "if",
            *_condition(what),
            read_meaning(then),
            read_meaning(otherwise) if otherwise else (),
        )
    match text.split(" ", 1):
        case ["stop" | "leave" | "cross" | "hallway" | "back" as verb]:
            return (verb,)
        case ["hallway", rest] if found := re.fullmatch(r"for ([\d.]+) (m|steps?)", rest):
            return ("hallway", "for", float(found[1]), found[2][0])
        case ["hallway", rest] if rest.startswith(("until ", "past ")):
            relation, place = rest.split(" ", 1)
            return ("hallway", relation, read_place(place))
        case ["turn", rest]:
            return _turn(rest)
        case ["through" | "in" | "leave" as verb, place]:
            return (verb, read_place(place))
        case ["to", place]:
            return ("to", read_place(place))
        case ["back", rest] if rest.startswith("to "):
            return ("back", read_place(rest[3:]))
        case ["face", rest]:
            wall = re.fullmatch(r"wall (\w+)", rest)
            return ("face", ("wall", wall[1])) if wall else ("face", read_place(rest))
        case ["wait", seconds]:
            return ("wait", float(seconds))
        case [place] if place.startswith("room("):
            return read_place(place)
        case [*_] if text.startswith("room("):
            return read_place(text)
    raise ValueError(f"{text!r} is no step of a meaning")


def _condition(what: str) -> tuple[str, Any]:
    for word in ("no", "closed", "open"):
        if what.startswith(f"{word} "):
            return word, read_place(what[len(word) + 1 :])
    return "there", read_place(what)


def _turn(rest: str) -> Step:
    found = re.fullmatch(r"(left|right|around)(?: at (.+)| (\d+))?", rest)
    if found is None:
        raise ValueError(f"'turn {rest}' is no step of a meaning")
    way, place, degrees = found.groups()
    if degrees:
        return ("turn by", way, int(degrees))
    return ("turn", way, read_place(place) if place else None)


def read_place(text: str) -> Step:
    """A place of the notation: a door, a named room, or a kind of place with its ordinal.

    Raises:
        ValueError: it is not in the notation.
    """
    text = text.strip()
    if room := re.fullmatch(r"room\((.+)\)", text):
        return ("room", room[1].strip().casefold())
    if door := re.fullmatch(r"door\((.+)\)", text):
        return _door(door[1])
    place = re.fullmatch(
        r"(intersection|corner|t-junction|end|turning|wall|door)(?:#(-?\d+))?", text
    )
    if place is None:
        raise ValueError(f"{text!r} is no place of a meaning")
    if place[1] == "door":
        return ("door", int(place[2] or 1), None, None, None)
    return (place[1], int(place[2] or 1))


def _door(inside: str) -> Step:
    """A door: ordinal, side, relation and the places of the relation."""
    number, *options = (each.strip() for each in inside.split(",", 1))
    ordinal = number if number in NAMED_ORDINALS else int(number)
    side, relation, places = None, None, None
    for option in _options(options[0] if options else ""):
        if option in DOOR_SIDES:
            side = option
        elif option == "open":
            continue  # only open doors count
        else:
            relation, rest = option.split(" ", 1)
            places = tuple(read_place(each) for each in rest.split(" and "))
    return ("door", ordinal, side, relation, places)


def _options(text: str) -> list[str]:
    """Parts between commas that are not inside brackets."""
    return [each.strip() for each in re.split(r",(?![^(]*\))", text) if each.strip()]
