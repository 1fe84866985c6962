"""Occupancy maps with labels beside them: real floors with named doors and rooms."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import shapely
from shapely import Polygon

from semnav_env.world.maps.floor_plan import FloorPlan, Region
from semnav_env.world.maps.importers.building_doors import with_doors, with_walls
from semnav_env.world.maps.importers.imported import BOUNDARY_MARGIN, ImportedPlan, ImportReport
from semnav_env.world.maps.importers.labels import (
    DOORS_FILE,
    PLACE_KINDS,
    PLACES_FILE,
    PlaceLabel,
    has_all_doors,
    read_door_labels,
    read_place_labels,
)
from semnav_env.world.maps.importers.occupancy import OccupancyMap, read_occupancy
from semnav_env.world.maps.importers.tracing import Tracing, trace
from semnav_env.world.maps.rules import FloorPlanError, check_region

CORRIDOR_ASPECT_RATIO = 4.0
"""Ratio of length to width from which on a place is taken for a corridor."""


def load_building(path: str | Path, tracing: Tracing | None = None) -> ImportedPlan:
    """The floor plan of an occupancy map with the doors and places of its label files.

    Either file may be missing beside the map. A labelled door gets the jambs that the map shows
    (`fit_door`), and is open if the map shows a way through; a closed one gets a leaf. Further
    doorways between two places (`find_doorways`) are named after these, unless the labels say that
    they have all doors. Where its label does not say what a place is, it is a room, or a corridor
    if it is at least `CORRIDOR_ASPECT_RATIO` times as long as wide. Doors are looked
    for in the walls as traced and then put on the straightened walls (`with_walls`), so that
    straightening opens and closes none.

    Args:
        path: the map's YAML file.
        tracing: options for tracing walls from pixels.

    Raises:
        FloorPlanError: names the file, what is wrong and what would be right.
    """
    where, tracing = Path(path), tracing or Tracing()
    pixels = read_occupancy(where)
    plan, report = trace(pixels, replace(tracing, straighten=0.0))
    doors, places = where.with_name(DOORS_FILE), where.with_name(PLACES_FILE)
    place_labels = read_place_labels(places)
    plan, lost_places = _with_places(plan, place_labels, pixels)
    labels = read_door_labels(doors)
    plan, lost_doors = with_doors(plan, labels, None if has_all_doors(places) else pixels.is_free)
    if tracing.straighten:
        plan, report = _straightened(plan, report, trace(pixels, tracing))
    unnamed = len({door.name for door in plan.doors} - {label.name for label in labels})
    taken = {
        "open doors": sum(door.open for door in plan.doors),
        "closed doors": sum(not door.open for door in plan.doors),
        "of them without a label": unnamed,
        "rooms": len(plan.rooms),
        "corridors": len(plan.corridors),
        "intersections": len(plan.intersections),
        "open areas": len(plan.areas),
    }
    halls = (
        f"places at least {CORRIDOR_ASPECT_RATIO:g} times as long as wide are taken for corridors"
    )
    report = replace(
        report,
        source=(*report.source, *(str(file) for file in (doors, places) if file.is_file())),
        taken=report.taken | {name: number for name, number in taken.items() if number},
        left_out=report.left_out + lost_places + lost_doors,
        notes=report.notes
        + ((halls,) if any(label.kind is None for label in place_labels) else ()),
    )
    return ImportedPlan(plan, report)


def _straightened(plan: FloorPlan, report: ImportReport, straight: ImportedPlan) -> ImportedPlan:
    """A plan on straightened walls; unchanged, with a note, if a door would become too narrow."""
    try:
        return ImportedPlan(with_walls(plan, straight.plan), straight.report)
    except FloorPlanError as error:
        note = f"walls are left as traced, because of straight ones {error}"
        return ImportedPlan(plan, replace(report, notes=(*report.notes, note)))


def _with_places(
    plan: FloorPlan, labels: Sequence[PlaceLabel], pixels: OccupancyMap
) -> tuple[FloorPlan, tuple[str, ...]]:
    """The plan with the labelled places that keep the rules, and why others were left out."""
    regions: dict[str, Region] = {}
    kinds: dict[str, str] = {}
    lost = []
    for label in labels:
        whole = shapely.make_valid(Polygon(pixels.to_world(label.ring)))
        parts = [part for part in shapely.get_parts(whole) if isinstance(part, Polygon)]
        region = Region(label.name, max(parts, key=shapely.area, default=Polygon()))
        try:
            check_region(region)
            if label.name in regions:
                raise FloorPlanError(f"region {label.name!r}: there is another one of that name")
        except FloorPlanError as error:
            lost.append(str(error))
        else:
            regions[label.name] = region
            kinds[label.name] = label.kind or ("corridor" if is_long(region.polygon) else "room")
    wide = [plan.boundary, *(region.polygon.buffer(BOUNDARY_MARGIN) for region in regions.values())]
    boundary = shapely.box(*shapely.total_bounds(wide))
    rooms, halls, crossings, areas = (
        tuple([region for name, region in regions.items() if kinds[name] == kind])
        for kind in PLACE_KINDS
    )
    found = replace(plan, rooms=rooms, corridors=halls, intersections=crossings, areas=areas)
    return replace(found, boundary=boundary), tuple(lost)


def is_long(polygon: Polygon) -> bool:
    """Whether a rectangle of the same area and perimeter has the sides of a corridor.

    So an L or a T of corridors is long too.
    """
    half = float(polygon.length) / 4.0
    spread = math.sqrt(max(0.0, half**2 - float(polygon.area)))
    return half + spread >= CORRIDOR_ASPECT_RATIO * (half - spread)
