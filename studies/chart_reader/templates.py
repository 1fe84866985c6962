"""Steps of frames as clauses: what fills a slot goes into a field, as the clauses declare it."""

from __future__ import annotations

import re
from dataclasses import dataclass
from enum import Enum
from functools import cache
from typing import Any

from semnav_env.language.clauses import CLAUSE_KINDS, Clause, GoToDoor, GoToRoom, SearchHouse
from semnav_env.language.declarations import Multiples, forms_of, open_fields
from semnav_env.language.references import (
    Distance,
    DoorReference,
    Place,
    PlaceReference,
    RoomReference,
    Side,
    Unit,
)
from studies.chart_reader.features import Features

METRES = {"metres": 1.0, "cm": 0.01, "feet": 0.3048, "yards": 0.9144}
"""Length of each unit that is not a step, metres."""

OF_ROOMS = {"through": "room({})", "in": "room({})", "to": "to room({})"}
"""What the steps of doors are for a room."""


class NoClauseError(Exception):
    """What a frame makes of its slots is no clause."""


class UnsayableError(NoClauseError):
    """What is meant is clear, and no clause says it: a door beside a place, 30 centimetres."""


@dataclass(frozen=True, eq=False)
class Template:
    """A step: the kind of its clause, the fields with one value, and what stands in the others."""

    kind: type[Clause]
    fixed: dict[str, Any]
    open: dict[str, str]


def _words(step: str) -> list[str]:
    return re.findall(r"[^\s();]+", step)


@cache
def template_of(step: str) -> Template:
    """The template of a step in the notation of docs/meanings.md.

    Raises:
        ValueError: no clause declares such a step.
    """
    if step == "search":
        return Template(SearchHouse, {}, {})
    words = _words(step)
    for kind in CLAUSE_KINDS.values():
        for form, options in open_fields(kind):
            pattern = _words(form.step)
            if len(pattern) != len(words):
                continue
            filled: dict[str, str] = {}
            for part, word in zip(pattern, words, strict=True):
                name = part.strip("{}")
                if part == word and part[0] != "{":
                    continue
                if part[0] != "{" or not _may_fill(word, options.get(name, ())):
                    break
                filled[name] = word
            else:
                return Template(kind, dict(form.fixed), filled)
    raise ValueError(f"no clause declares the step {step!r}")


def _may_fill(word: str, options: tuple[Any, ...]) -> bool:
    return word[0] == "$" or any(isinstance(each, Enum) and each.value == word for each in options)


def clause_of(step: str, values: dict[str, Any]) -> Clause:
    """The clause of a step, with references and numbers for what stands in it.

    Raises:
        NoClauseError: it is no clause.
    """
    template = template_of(step)
    given = {name: values[word] if word[0] == "$" else word for name, word in template.open.items()}
    room = next((v for v in given.values() if isinstance(v, RoomReference)), None)
    if template.kind is GoToDoor and room is not None:
        return clause_of(OF_ROOMS[step.split()[0]].format("$room"), {"$room": room})
    if template.kind is GoToRoom:
        if room is None:
            raise NoClauseError
        given = {"name": room.name}
    for name, value in given.items():
        given[name] = _fitting(value, _options(template.kind, name))
    try:
        clause = template.kind(**template.fixed | given)
    except (ValueError, TypeError):
        raise NoClauseError from None
    if not any(form.covers(clause) for form in forms_of(template.kind)):
        raise NoClauseError
    return clause


def _options(kind: type[Clause], name: str) -> tuple[Any, ...]:
    """What a field may be in any form of its clause."""
    return tuple(option for _, options in open_fields(kind) for option in options.get(name, ()))


def _fitting(value: Any, options: tuple[Any, ...]) -> Any:
    """A value as a field may have it.

    Raises:
        NoClauseError: it may not.
    """
    for option in options:
        if isinstance(option, Enum) and option.value == value:
            return option
        if isinstance(option, type) and type(value) is option:
            return value
        if isinstance(option, Multiples) and type(value) is int:
            return value
    raise NoClauseError


def reference_of(noun: Features) -> DoorReference | PlaceReference | RoomReference:
    """The reference of a noun phrase, without its relations.

    Raises:
        UnsayableError: no reference says it.
    """
    own = dict(noun)
    ordinal = own.get("ord", 1)
    if "count" in own or "numbered" in own:
        ordinal = own.get("n", 1)
    if ordinal != int(ordinal):
        raise UnsayableError
    try:
        if own["kind"] == "room":
            return RoomReference(own["name"])
        if own["kind"] == "door":
            side = Side(own["side"]) if "side" in own else None
            return DoorReference(int(ordinal), side)
        place = Place(own["place"])
        return PlaceReference(place, 1 if place is Place.END else int(ordinal))
    except (ValueError, KeyError):
        raise UnsayableError from None


def distance_of(given: Features) -> Distance:
    """A distance from its number and unit.

    Raises:
        UnsayableError: it is too long or no multiple of half a metre.
    """
    own = dict(given)
    try:
        if own["unit"] == "steps":
            return Distance(own["n"], Unit.STEPS)
        metres = own["n"] * METRES[own["unit"]] * (0.5 if "half" in own else 1.0)
        if own["unit"] in ("feet", "yards"):
            metres = max(0.5, round(2 * metres) / 2)
        return Distance(float(round(metres, 3)))
    except (ValueError, KeyError):
        raise UnsayableError from None


def degrees_of(given: Features) -> int:
    """Degrees of an angle."""
    own = dict(given)
    return int(own.get("deg", own.get("n", 0)))


def seconds_of(given: Features) -> int:
    """Seconds of a wait."""
    own = dict(given)
    seconds: float = own.get("n", 1.0) * (60 if "minutes" in own else 1)
    return round(seconds)
