"""Floor plans of the project's own format that are drawn in another unit."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from semnav_env.world.maps.document import parse_document
from semnav_env.world.maps.importers.documents import read_text
from semnav_env.world.maps.importers.imported import ImportedPlan, ImportReport
from semnav_env.world.maps.reader import parse_plan
from semnav_env.world.maps.schema import check_schema

DECIMALS = 6
"""Digits of a coordinate behind the point, metres."""


def load_plan_file(path: Path, scale: float | None = None) -> ImportedPlan:
    """The floor plan in a `.geojson` file.

    Args:
        path: the file.
        scale: metres a unit of its coordinates; 1 if None.

    Raises:
        FloorPlanError: as `load_floor_plan`.
    """
    document = parse_document(read_text(path), str(path))
    check_schema(document, str(path))
    unit = scale or 1.0
    for feature in document["features"] if unit != 1.0 else ():
        geometry = feature["geometry"]
        geometry["coordinates"] = _scaled(geometry["coordinates"], unit)
    plan = parse_plan(json.dumps(document), str(path), path.stem, follows_schema=True)
    counts = {
        "segments": len(plan.segments),
        "doors": len(plan.doors),
        "rooms": len(plan.rooms),
        "corridors": len(plan.corridors),
    }
    taken = {name: count for name, count in counts.items() if count}
    report = ImportReport((str(path),), "floor plan", taken, notes=(f"{unit:g} m a unit",))
    return ImportedPlan(plan, report)


def _scaled(coordinates: Any, unit: float) -> Any:
    """Coordinates, nested however deep, in metres."""
    if isinstance(coordinates, list):
        return [_scaled(each, unit) for each in coordinates]
    return round(coordinates * unit, DECIMALS)
