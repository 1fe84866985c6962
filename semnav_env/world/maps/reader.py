"""Reads floor plans from GeoJSON in local metres, the format of docs/guides/floor_plans.md."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any, TypeAlias

from shapely import Polygon

from semnav_env.world.maps.document import Document, label, parse_document, read_text
from semnav_env.world.maps.doorways import DoorState, door_state
from semnav_env.world.maps.floor_plan import FloorPlan, Material, PlanDoor, Region, Surface
from semnav_env.world.maps.rules import (
    FloorPlanError,
    check_door,
    check_plan,
    check_polygon,
    check_region,
    check_surface,
    check_unit,
)
from semnav_features.frames import Point

Properties: TypeAlias = dict[str, Any]
"""The properties of a feature."""

Part: TypeAlias = Surface | PlanDoor | Region | Polygon
"""The part of a floor plan that is made from a feature."""


SOLID_KINDS = frozenset(Material)
"""Kinds of features that are solid."""


def read_plan(path: Path, *, follows_schema: bool = False) -> FloorPlan:
    """Read and check one file.

    Args:
        path: the file.
        follows_schema: whether it is known to follow the schema, whose check takes long.

    Raises:
        FloorPlanError: names the file, the feature, what is wrong and what would be right.
    """
    text = read_text(path)
    return parse_plan(text, str(path), path.stem, follows_schema=follows_schema)


def parse_plan(text: str, where: str, name: str, *, follows_schema: bool = False) -> FloorPlan:
    """The plan in a GeoJSON text.

    Args:
        text: the document.
        where: name of the document in an error.
        name: the plan's name if the document gives none.
        follows_schema: as for `read_plan`.

    Raises:
        FloorPlanError: as `read_plan`.
    """
    document = parse_document(text, where)
    if not follows_schema:
        from semnav_env.world.maps.schema import check_schema  # bundled plans do without it

        check_schema(document, where)
    try:
        check_unit(_door_widths(document))
    except FloorPlanError as error:
        raise FloorPlanError(f"{where}: {error}") from None
    parts: dict[str, list[Any]] = {}
    for index, feature in enumerate(document["features"]):
        try:
            kind = feature["properties"]["kind"]
            parts.setdefault("solid" if kind in SOLID_KINDS else kind, []).append(_part(feature))
        except FloorPlanError as error:
            raise FloorPlanError(f"{where}: {label(document, index)}: {error}") from None
    try:
        plan = _assemble(document, parts, name)
        check_plan(plan)
        _check_states(document, plan)
    except FloorPlanError as error:
        raise FloorPlanError(f"{where}: {error}") from None
    return plan


def _door_widths(document: Document) -> Iterator[float]:
    """Widths of the doors as drawn, even if the plan has other faults."""
    for feature in document["features"]:
        if feature["properties"]["kind"] == "door":
            start, end = feature["geometry"]["coordinates"]
            yield math.dist(start, end)


def _assemble(document: Document, parts: dict[str, list[Any]], name: str) -> FloorPlan:
    outlines = parts.get("boundary", [])
    if len(outlines) != 1:
        raise FloorPlanError(f"{len(outlines)} features of kind boundary; a plan has exactly one")
    if "solid" not in parts:
        raise FloorPlanError("nothing solid; a plan has features of kind wall")
    groups = ("solid", "door", "room", "corridor", "intersection", "area")
    solids, doors, rooms, corridors, intersections, areas = (
        tuple(parts.get(g, ())) for g in groups
    )
    return FloorPlan(
        name=document.get("name", name),
        surfaces=solids,
        doors=doors,
        rooms=rooms,
        corridors=corridors,
        intersections=intersections,
        boundary=outlines[0],
        source=document.get("source", ""),
        areas=areas,
    )


def _check_states(document: Document, plan: FloorPlan) -> None:
    """Refuse a door whose stated `state` is not the drawn one."""
    properties = [feature["properties"] for feature in document["features"]]
    stated = [p.get("state") for p in properties if p["kind"] == "door"]
    for door, state in zip(plan.doors, stated, strict=True):
        drawn = door_state(door, plan)
        if state not in (None, drawn):
            raise FloorPlanError(
                f"door {door.name!r} is called {state}, but is drawn {drawn}; "
                "draw its leaf or change its state"
            )


def _part(feature: dict[str, Any]) -> Part:
    """The checked part of a plan that a feature describes."""
    properties, geometry = feature["properties"], feature["geometry"]
    if properties["kind"] in SOLID_KINDS:
        return _surface(properties, geometry)
    if properties["kind"] == "door":
        return _door(properties, geometry["coordinates"])
    polygon = _polygon(geometry["coordinates"])
    if properties["kind"] == "boundary":
        check_polygon(polygon, "the boundary")
        return polygon
    region = Region(properties["name"], polygon, properties.get("assumed", False))
    check_region(region)
    return region


def _surface(properties: Properties, geometry: dict[str, Any]) -> Surface:
    material = Material(properties["kind"])
    line = geometry["coordinates"]
    if geometry["type"] == "Polygon":
        check_polygon(_polygon(line), f"the {material}")
        line = line[0]
    surface = Surface(_points(line), material, properties.get("assumed", False))
    check_surface(surface)
    return surface


def _door(properties: Properties, line: list[list[float]]) -> PlanDoor:
    start, end = _points(line)
    is_open = properties.get("state", "open") != DoorState.CLOSED
    door = PlanDoor(properties["name"], start, end, is_open)
    check_door(door)
    return door


def _polygon(rings: list[list[list[float]]]) -> Polygon:
    for ring in rings:
        if ring[0] != ring[-1]:
            raise FloorPlanError("a ring is not closed; repeat its first position as its last")
    shell, *holes = map(_points, rings)
    return Polygon(shell, holes)


def _points(line: list[list[float]]) -> tuple[Point, ...]:
    return tuple((x, y) for x, y in line)
