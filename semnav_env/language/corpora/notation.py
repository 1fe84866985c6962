"""The notation of docs/guides/meanings.md: "hallway past door(1); through door(1,left)".

Commands are written in it by what their clauses declare.

A meaning becomes a tuple of steps, each a tuple of plain values, so that it can be compared with
the steps of a command (`semnav_env.language.corpora.meanings`).
"""

from __future__ import annotations

import re
from enum import StrEnum
from functools import cache
from typing import Any, TypeAlias

from semnav_env.language.clause_kinds import CLAUSE_KINDS
from semnav_env.language.clauses import IfThere
from semnav_env.language.command import Command
from semnav_env.language.declarations import (
    Multiples,
    Spoken,
    field_names,
    form_of,
    is_ordinal,
    open_fields,
)
from semnav_env.language.references import OTHER

Step: TypeAlias = tuple[Any, ...]
Steps: TypeAlias = tuple[Step, ...]

NAMED_ORDINALS = ("nearest", "any", "other", "entry")
DOOR_SIDES = ("left", "right", "ahead", "behind", "opposite")

_CONDITION = re.compile(r"if ([^:]+): ?(.*?)(?: else: ?(.*))? end")
_BEFORE_PLACE = re.compile(r"(?:until|past|at|to|face|after|before)$")


def notation_of(command: Command) -> str:
    """A command in the notation.

    Raises:
        TypeError: a clause has no step in it.
    """
    steps, clauses = [], list(command.clauses)
    while clauses:
        clause = clauses.pop(0)
        step = _written(clause)
        if isinstance(clause, IfThere):
            then, otherwise = clauses[: clause.then], clauses[clause.then :][: clause.otherwise]
            del clauses[: clause.then + clause.otherwise]
            step += f": {'; '.join(map(_written, then))}"
            step += f" else: {'; '.join(map(_written, otherwise))}" if otherwise else ""
            step += " end"
        steps.append(step)
    return "; ".join(steps)


def _written(value: object) -> str:
    """A clause, or the value of a field, in the notation."""
    if isinstance(value, Spoken):
        step = form_of(value).step if value.forms else ""
        if not step:
            raise TypeError(f"{value!r} has no step in the notation")
        names = field_names(type(value))
        return step.format(**{name: _written(getattr(value, name)) for name in names})
    if isinstance(value, StrEnum):
        return value.replace("_", "-")
    if is_ordinal(value):
        return "other" if value == OTHER else str(value)
    return f"{value:g}" if isinstance(value, float) else str(value)


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
        case ["turn", rest]:
            return _turn(rest)
        case parts if text in {*_whole_steps(), "cross"}:
            return tuple(parts)
        case ["hallway", rest] if along := re.fullmatch(r"along (left|right)(?: (.+))?", rest):
            return ("along", along[1], *_step(f"hallway {along[2] or ''}".strip())[1:])
        case ["hallway", rest] if rest.startswith("for "):
            return ("hallway", "for", *_distance(rest[4:]))
        case ["hallway", rest] if rest.startswith(("until ", "past ")):
            relation, place = rest.split(" ", 1)
            return ("hallway", relation, read_place(place))
        case ["back", rest] if rest.startswith("to "):
            return ("back", read_place(rest[3:]))
        case ["face", rest] if wall := re.fullmatch(r"wall (\w+)", rest):
            return ("face", ("wall", wall[1]))
        case [verb, place] if verb in {*_verbs(Spoken), "leave"}:
            return (verb, read_place(place))
        case [verb, number] if verb in _verbs(Multiples):
            return (verb, float(number))
        case [*_] if text.startswith("room("):
            return read_place(text)
    raise ValueError(f"{text!r} is no step of a meaning")


@cache
def _whole_steps() -> frozenset[str]:
    """The declared steps that have no open field."""
    steps = (form.step for kind in CLAUSE_KINDS.values() for form in kind.forms)
    return frozenset(step for step in steps if "{" not in step)


@cache
def _verbs(followed_by: type) -> frozenset[str]:
    """The first words of declared steps behind which stands a place, or a number."""
    found = set()
    for kind in CLAUSE_KINDS.values():
        for form, options in open_fields(kind):
            verb, _, rest = form.step.partition(" ")
            what = next(iter(options.get(rest.strip("{}"), ())), None)
            if issubclass(what if isinstance(what, type) else type(what), followed_by):
                found.add(verb)
    return frozenset(found)


def _distance(text: str) -> Step:
    """Number and unit of a distance; "some" has only a unit."""
    if text == "some":
        return ("some",)
    found = re.fullmatch(r"([\d.]+) (m|steps?)", text)
    if found is None:
        raise ValueError(f"{text!r} is no distance of a meaning")
    return (float(found[1]), found[2][0])


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
    """A place of the notation: a door, a named room, a kind of place with its ordinal, a distance.

    Raises:
        ValueError: it is not in the notation.
    """
    text = text.strip()
    if room := re.fullmatch(r"room\((.+)\)", text):
        return ("room", room[1].strip().casefold())
    if offset := re.fullmatch(r"(some|[\d.]+ \w+) (before|after) (.+)", text):
        return ("offset", _distance(offset[1]), offset[2], read_place(offset[3]))
    if text == "some" or text[:1].isdigit():
        return ("distance", *_distance(text))
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
            if relation == "opposite":
                side, relation = "opposite", "at"
            places = tuple(read_place(each) for each in rest.split(" and "))
    return ("door", ordinal, side, relation, places)


def _options(text: str) -> list[str]:
    """Parts between commas that are not inside brackets."""
    return [each.strip() for each in re.split(r",(?![^(]*\))", text) if each.strip()]
