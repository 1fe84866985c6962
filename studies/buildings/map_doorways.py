"""Doorways that the importer finds in maps of real floors without the labels of doors."""

from __future__ import annotations

import math
import time
from collections.abc import Sequence

from semnav_env.world.maps.floor_plan import PlanDoor
from semnav_env.world.maps.importers import OccupancyMap, Tracing, trace
from semnav_env.world.maps.importers.building_doors import moved_along, without_leaves
from semnav_env.world.maps.importers.gaps import LEAST_DOORWAY_DISTANCE, find_doorways
from studies.buildings.buildings import Building
from studies.buildings.false_doorways import false_doorways
from studies.doors.door_sightings import matches
from studies.sheets import Cell, ResultSheet


def map_row(name: str, building: Building, pixels: OccupancyMap) -> tuple[Cell, ...]:
    """How many of the labelled open doors are found, what else is found, and what of it is false.

    The importer looks for gaps between places in the walls as traced (`find_doorways`), which takes
    the seconds of the row, and moves them along with the walls (`moved_along`) as these are in the
    building's plan; `false_doorways` judges them.
    """
    traced, walls = trace(pixels, Tracing(straighten=0.0)).plan, without_leaves(building.plan)
    begin = time.perf_counter()
    doorways = find_doorways(walls.regions, traced.solids, pixels.is_free)
    seconds = time.perf_counter() - begin
    found = [moved_along(doorway, traced, walls) for doorway in doorways]
    hits = sum(any(matches(f.as_door(), d.start, d.end) for f in found) for d in building.doors)
    middles = [door.midpoint for door in building.doors]
    further = sum(
        all(math.dist(f.midpoint, middle) > LEAST_DOORWAY_DISTANCE for middle in middles)
        for f in found
    )
    labelled = [PlanDoor("labelled", door.start, door.end) for door in building.doors]
    false = len(false_doorways(found, labelled, pixels))
    recall, wrong = hits / len(building.doors), false / max(1, len(found))
    return name, len(building.doors), hits, recall, len(found), further, false, wrong, seconds


def map_sheet(rows: Sequence[tuple[Cell, ...]]) -> ResultSheet:
    """The rows of `map_row` as a table."""
    columns = (
        *("floor", "labelled open doors", "of them found", "recall", "doorways found"),
        *("without a label", "false", "share false", "seconds"),
    )
    return ResultSheet("Doorways found in the map without the labels of doors", columns, rows)
