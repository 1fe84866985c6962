"""Houses of the HouseExpo data set (JSON)."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import Any, TypeGuard

import shapely

from semnav_env.world.maps.floor_plan import Region
from semnav_env.world.maps.importers.documents import finite
from semnav_env.world.maps.importers.drawing import MAX_DRAWING_EXTENT
from semnav_env.world.maps.importers.imported import BOUNDARY_MARGIN, ImportedPlan
from semnav_env.world.maps.importers.segments import Row, plan_of_segments
from semnav_env.world.maps.rules import FloorPlanError, check_region

CORRIDOR_TYPES = ("hallway", "corridor", "passage", "entryway")
"""Types of rooms of HouseExpo that are corridors."""


def is_house(content: Any) -> TypeGuard[dict[str, Any]]:
    """Whether a JSON document looks like a house of HouseExpo."""
    return isinstance(content, dict) and "verts" in content


def plan_of_house(content: dict[str, Any], path: Path, scale: float | None = None) -> ImportedPlan:
    """The floor plan of a house: `verts`, its outline in metres, and boxes in `room_category`.

    The boxes are named by category and number; a hallway becomes a corridor. The data set has
    no doors.

    Args:
        content: the JSON document.
        path: file that it was read from.
        scale: metres a unit; 1 if None.

    Raises:
        FloorPlanError: names what is wrong with which entry.
    """
    unit = scale or 1.0
    rows = _outline(content.get("verts"), path, unit)
    plan, report = plan_of_segments(rows, path, "house of HouseExpo")
    rooms, halls, lost = _regions(content.get("room_category", {}), path, unit)
    around = [plan.boundary, *(room.polygon.buffer(BOUNDARY_MARGIN) for room in (*rooms, *halls))]
    boundary = shapely.box(*shapely.total_bounds(around))
    plan = replace(plan, rooms=rooms, corridors=halls, boundary=boundary)
    taken = report.taken | {"rooms": len(rooms), "corridors": len(halls)}
    notes = (f"{unit:g} m a unit", "rooms are boxes, which may overlap; there are no doors")
    return ImportedPlan(plan, replace(report, taken=taken, notes=notes).with_left_out(lost))


def _outline(verts: Any, path: Path, unit: float) -> list[Row]:
    try:
        points = [(unit * finite(x), unit * finite(y)) for x, y in verts]
    except (TypeError, ValueError) as error:
        raise FloorPlanError(f"{path}: verts: {error}; it is a list of [x, y]") from None
    if len(points) < 3:
        raise FloorPlanError(f"{path}: verts: {len(points)} points; an outline has at least three")
    for low, high in ((min(values), max(values)) for values in zip(*points, strict=True)):
        if max(high - low, abs(low), abs(high)) > MAX_DRAWING_EXTENT:
            raise FloorPlanError(
                f"{path}: reaches from {low:,.0f} to {high:,.0f} m; "
                f"at most {MAX_DRAWING_EXTENT:,.0f} m are read: give the scale, metres a unit"
            )
    return [(*a, *b) for a, b in pairwise([*points, points[0]])]


def _regions(
    categories: Any, path: Path, unit: float
) -> tuple[tuple[Region, ...], tuple[Region, ...], tuple[str, ...]]:
    """Rooms, corridors, and why others were left out."""
    rooms: list[Region] = []
    halls: list[Region] = []
    lost: list[str] = []
    counts: Counter[str] = Counter()
    try:
        boxes = [(str(kind), box) for kind, each in categories.items() for box in each]
        rows = [(kind, [unit * finite(value) for value in box]) for kind, box in boxes]
    except (AttributeError, TypeError, ValueError) as error:
        raise FloorPlanError(
            f"{path}: room_category: {error}; it has a list of [x1, y1, x2, y2] for each category"
        ) from None
    for kind, box in rows:
        name = kind.replace("_", " ").strip().lower() or "room"
        counts[name] += 1
        try:
            if len(box) != 4:
                raise FloorPlanError(f"{name}: {len(box)} numbers, not x1, y1, x2, y2")
            x1, y1, x2, y2 = box
            polygon = shapely.box(min(x1, x2), min(y1, y2), max(x1, x2), max(y1, y2))
            region = Region(f"{name} {counts[name]}", polygon)
            check_region(region)
        except FloorPlanError as error:
            lost.append(str(error))
        else:
            (halls if name in CORRIDOR_TYPES else rooms).append(region)
    return tuple(rooms), tuple(halls), tuple(lost)
