"""A floor plan file as a checked JSON document: sizes first, then syntax, then the schema."""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn, TypeAlias

from semnav_env.features import reading
from semnav_env.maps.rules import FloorPlanError

if TYPE_CHECKING:  # bundled plans do without it
    from jsonschema import Draft202012Validator

Document: TypeAlias = dict[str, Any]
"""A floor plan file as JSON gives it."""


SCHEMA_FILE = Path(__file__).with_name("floor_plan.schema.json")
"""The JSON Schema of floor plan files."""

MAX_FEATURES = 10_000
"""Largest number of features in a file; checking a plan takes time that grows with it."""

MAX_NUMBERS = 100_000
"""Largest number of coordinates in a file, two for each position."""


def read_text(path: Path) -> str:
    """The text of a floor plan file.

    Raises:
        FloorPlanError: not a readable file, too large or not UTF-8.
    """
    try:
        return reading.read_text(path, error=FloorPlanError)
    except FileNotFoundError:
        problem = "no such file; give a .geojson file or a bundled name"
        raise FloorPlanError(f"{path}: {problem}") from None
    except OSError as error:
        raise FloorPlanError(f"{path}: cannot be read: {error.strerror}") from None


def parse_document(text: str, where: str, *, follows_schema: bool = False) -> Document:
    """The document in `text`, checked against floor_plan.schema.json.

    Args:
        text: JSON; NaN and Infinity are refused.
        where: name of the text in an error, as the name of a file.
        follows_schema: it is known to follow the schema, which is not checked then.

    Raises:
        FloorPlanError: not JSON, too large, or not what the schema asks for.
    """
    try:
        document = json.loads(text, parse_constant=_refuse, parse_int=float)
        _check_sizes(document)
        _drop_nulls(document)
        if not follows_schema:
            _check_schema(document)
    except FloorPlanError as error:
        raise FloorPlanError(f"{where}: {error}") from None
    except json.JSONDecodeError as error:
        place = f"line {error.lineno}, column {error.colno}"
        raise FloorPlanError(f"{where}: not JSON: {error.msg} at {place}") from None
    except RecursionError:
        raise FloorPlanError(f"{where}: nested too deeply; a plan needs eight levels") from None
    checked: Document = document
    return checked


@cache
def validator() -> Draft202012Validator:
    """The compiled schema of floor plans."""
    from jsonschema import Draft202012Validator

    return Draft202012Validator(json.loads(SCHEMA_FILE.read_text("utf-8")))


def label(document: Document, index: int) -> str:
    """Name of a feature in an error: its number (from 1), kind and name."""
    feature = document["features"][index]
    properties = feature.get("properties") if isinstance(feature, dict) else None
    stated = properties if isinstance(properties, dict) else {}
    words = [stated[key] for key in ("kind", "name") if isinstance(stated.get(key), str)]
    called = " ".join(words)
    number = f"feature {index + 1} of {len(document['features'])}"
    return f"{number} ({called[:80]})" if called and called.isprintable() else number


def _refuse(literal: str) -> NoReturn:
    raise FloorPlanError(f"holds {literal}; coordinates are finite numbers")


def _check_sizes(document: object) -> None:
    features = document.get("features") if isinstance(document, dict) else None
    if isinstance(features, list) and len(features) > MAX_FEATURES:
        raise FloorPlanError(f"{len(features):,} features; at most {MAX_FEATURES:,} are read")
    if _numbers(document) > MAX_NUMBERS:
        raise FloorPlanError(f"more than {MAX_NUMBERS // 2:,} positions; simplify the plan")


def _numbers(document: object) -> int:
    """How many numbers a document holds; counting stops beyond the limit."""
    count, todo = 0, [document]
    while todo and count <= MAX_NUMBERS:
        value = todo.pop()
        if isinstance(value, float):
            count += 1
        elif isinstance(value, list | dict):
            todo.extend(value.values() if isinstance(value, dict) else value)
    return count


def _drop_nulls(document: object) -> None:
    """Remove null attributes: drawing programs write every attribute of every feature."""
    features = document.get("features") if isinstance(document, dict) else None
    for feature in features if isinstance(features, list) else []:
        if isinstance(feature, dict) and isinstance(feature.get("properties"), dict):
            kept = {k: v for k, v in feature["properties"].items() if v is not None}
            feature["properties"] = kept


def _check_schema(document: Any) -> None:
    error = next(validator().iter_errors(document), None)
    if error is None:
        return
    path = list(error.absolute_path)
    where = ""
    if path[:1] == ["features"] and len(path) > 1:
        where, path = f"{label(document, int(path[1]))}: ", path[2:]
    place = ".".join(map(str, path))
    raise FloorPlanError(f"{where}{place}{': ' if place else ''}{_explain(error)}")


def _explain(error: Any) -> str:
    """Say in one line what is wrong and what would be right.

    Args:
        error: a `jsonschema.ValidationError` that has all its attributes.
    """
    asked, given = error.validator_value, error.instance
    match error.validator:
        case "const":
            return f"must be {asked!r}, not {_short(given)}"
        case "type":
            return f"must be of type {asked}, not {_short(given)}"
        case "enum":
            from rapidfuzz import process

            near = process.extractOne(str(given)[:80], asked, score_cutoff=60)
            hint = f"; did you mean {near[0]!r}?" if near else ""
            return f"must be one of {', '.join(asked)}, not {_short(given)}{hint}"
        case "required":
            return f"lacks {', '.join(repr(name) for name in asked if name not in given)}"
        case "additionalProperties":
            known = error.schema["properties"]
            unknown = ", ".join(_short(name) for name in given if name not in known)
            return f"has {unknown[:80]}; only {', '.join(known)} are known"
        case "minItems" | "minLength":
            return f"{_short(given)} has a length of {len(given)}; at least {asked} are needed"
        case _:
            return f"{_short(given)} has a length of {len(given)}; at most {asked} are allowed"


def _short(value: object) -> str:
    text = repr(value)
    return text if len(text) <= 60 else f"{text[:50]} ..."
