"""Writes floor plans as GeoJSON that reads back equal."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from shapely import Polygon

from semnav_env.world.maps.doorways import door_state
from semnav_env.world.maps.floor_plan import FloorPlan, Surface
from semnav_env.world.maps.reader import parse_plan
from semnav_env.world.maps.rules import LEAST_AREA, check_plan
from semnav_features.writing import write_file


def save_floor_plan(plan: FloorPlan, path: str | Path) -> None:
    """Write a plan so that `load_floor_plan` gives it back equal, one feature per line.

    Raises:
        FloorPlanError: the plan breaks a rule of docs/guides/floor_plans.md; nothing is written.
        OSError: the file cannot be written.
    """
    check_plan(plan)
    text = to_geojson(plan)
    parse_plan(text, f"floor plan {plan.name!r}", plan.name)
    write_file(path, text)


def to_geojson(plan: FloorPlan) -> str:
    """The plan as GeoJSON, one feature per line."""
    head = {"type": "FeatureCollection", "name": plan.name, "units": "metre", "source": plan.source}
    lines = ",\n".join(map(_dump, _features(plan)))
    return f'{_dump(head)[:-1]}, "features": [\n{lines}\n]}}\n'


def _dump(value: object) -> str:
    return json.dumps(value, ensure_ascii=False)


def _features(plan: FloorPlan) -> Iterator[dict[str, Any]]:
    yield _feature(_area(plan.boundary), kind="boundary")
    for surface in plan.surfaces:
        yield _feature(_solid(surface), kind=surface.material.value, assumed=surface.assumed)
    for door in plan.doors:
        line = {"type": "LineString", "coordinates": [door.start, door.end]}
        yield _feature(line, kind="door", name=door.name, state=door_state(door, plan).value)
    groups = {
        "room": plan.rooms,
        "corridor": plan.corridors,
        "intersection": plan.intersections,
        "area": plan.areas,
    }
    for kind, regions in groups.items():
        for region in regions:
            yield _feature(
                _area(region.polygon), kind=kind, name=region.name, assumed=region.assumed
            )


def _feature(geometry: dict[str, Any], **properties: object) -> dict[str, Any]:
    stated = {key: value for key, value in properties.items() if value is not False}
    return {"type": "Feature", "properties": stated, "geometry": geometry}


def _solid(surface: Surface) -> dict[str, Any]:
    """The geometry of a surface: a polygon if its closed line has an area, else a line."""
    points = list(surface.points)
    if surface.is_closed:
        area = Polygon(points)
        if area.is_valid and area.area >= LEAST_AREA:
            return _area(area)
    return {"type": "LineString", "coordinates": points}


def _area(polygon: Polygon) -> dict[str, Any]:
    rings = (polygon.exterior, *polygon.interiors)
    return {"type": "Polygon", "coordinates": [list(ring.coords) for ring in rings]}
