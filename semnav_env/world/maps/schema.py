"""Checks floor plan documents against their JSON Schema."""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path
from typing import Any

from jsonschema import Draft202012Validator
from rapidfuzz import process

from semnav_env.world.maps.document import TOO_DEEP, Document, label
from semnav_env.world.maps.rules import FloorPlanError

SCHEMA_FILE = Path(__file__).with_name("floor_plan.schema.json")
"""The JSON Schema of floor plan files."""


@cache
def validator() -> Draft202012Validator:
    """The compiled schema of floor plans."""
    return Draft202012Validator(json.loads(SCHEMA_FILE.read_text("utf-8")))


def check_schema(document: Document, where: str) -> None:
    """Check a document against floor_plan.schema.json.

    Args:
        document: of `parse_document`.
        where: name of the document in an error.

    Raises:
        FloorPlanError: says in one line what is wrong and what would be right.
    """
    try:
        error = next(validator().iter_errors(document), None)
    except RecursionError:
        raise FloorPlanError(f"{where}: {TOO_DEEP}") from None
    if error is not None:
        raise FloorPlanError(f"{where}: {_placed(document, error)}")


def _placed(document: Document, error: Any) -> str:
    """The errors of a document with their places."""
    path = list(error.absolute_path)
    feature = ""
    if path[:1] == ["features"] and len(path) > 1:
        feature, path = f"{label(document, int(path[1]))}: ", path[2:]
    place = ".".join(map(str, path))
    return f"{feature}{place}{': ' if place else ''}{_explain(error)}"


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
