"""A floor plan file as a JSON document of limited size; `schema` checks its contents."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any, NoReturn, TypeAlias

from semnav_env.world.maps.rules import FloorPlanError
from semnav_features import reading

Document: TypeAlias = dict[str, Any]
"""A floor plan file as JSON gives it."""


MAX_FEATURES = 10_000
"""Largest number of features in a file; checking a plan takes time that grows with it."""

MAX_NUMBERS = 100_000
"""Largest number of coordinates in a file, two for each position."""

TOO_DEEP = "nested too deeply; a plan needs eight levels"
"""Message about a document that Python cannot read because of its depth."""


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


def parse_document(text: str, where: str) -> Document:
    """The document in `text`, without null attributes; `check_schema` checks it further.

    Args:
        text: JSON; NaN and Infinity are refused.
        where: name of the text in an error, as the name of a file.

    Raises:
        FloorPlanError: not JSON, or too large.
    """
    try:
        document = json.loads(text, parse_constant=_refuse, parse_int=float)
        _check_sizes(document)
        _drop_nulls(document)
    except FloorPlanError as error:
        raise FloorPlanError(f"{where}: {error}") from None
    except json.JSONDecodeError as error:
        place = f"line {error.lineno}, column {error.colno}"
        raise FloorPlanError(f"{where}: not JSON: {error.msg} at {place}") from None
    except RecursionError:
        raise FloorPlanError(f"{where}: {TOO_DEEP}") from None
    checked: Document = document
    return checked


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
    """Count the numbers of a document; the count stops beyond the limit."""
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
