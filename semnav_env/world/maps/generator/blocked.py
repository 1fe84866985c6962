"""Removes furniture that blocks the way around the leaf of a door between two rooms."""

from __future__ import annotations

from collections.abc import Sequence
from typing import cast

import numpy as np
import shapely

from semnav_env.robots import WHEELCHAIR
from semnav_env.world.maps.floor_plan import FloorPlan, Material, Region, Surface
from semnav_env.world.maps.generator.boxes import Box
from semnav_env.world.maps.generator.lots import Lot
from semnav_env.world.maps.generator.openings import Doorway
from semnav_env.world.maps.reach import reach
from semnav_env.world.maps.reachability import SEARCH_GRIDS
from semnav_features.frames import Point

NARROW_GAP = 0.7
"""Gap beside a leaf below which it is checked whether a wheelchair gets around the leaf, metres."""

SURROUNDINGS_MARGIN = 120
"""Margin of the building around the two rooms that is looked at, cm."""


def without_blocking(
    surfaces: Sequence[Surface], doors: Sequence[Doorway], lots: Sequence[Lot]
) -> tuple[Surface, ...]:
    """The surfaces without furniture that blocks a door between two rooms for a wheelchair."""
    kept = tuple(surfaces)
    for door in doors:
        if len(door.lots) == 2 and door.open and door.leaf:
            beside = _beside(door.leaf, kept)
            if beside and not _is_reached(door, doors, lots, kept):
                kept = tuple(s for s in kept if not any(s is piece for piece in beside))
    return kept


def _beside(leaf: tuple[Point, Point], surfaces: Sequence[Surface]) -> list[Surface]:
    """The furniture near the tip of a leaf."""
    tip = shapely.Point(leaf[1])
    furniture = [surface for surface in surfaces if surface.material is Material.FURNITURE]
    outlines = np.array([piece.points for piece in furniture]).reshape(-1, 5, 2)  # all are boxes
    near = shapely.distance(shapely.polygons(outlines), tip) < NARROW_GAP
    return [furniture[index] for index in np.flatnonzero(near)]


def _is_reached(
    door: Doorway, doors: Sequence[Doorway], lots: Sequence[Lot], surfaces: Sequence[Surface]
) -> bool:
    """Whether a wheelchair that enters by another door reaches this one."""
    around = shapely.union_all([_around(lots[index].box) for index in door.lots])
    building = cast(shapely.Polygon, around.envelope)
    entries = (entry for entry in doors if len(entry.lots) == 1 and entry.lots[0] in door.lots)
    for entry in entries:
        begin = Region("doorway", shapely.LineString(entry.jambs).centroid.buffer(0.01))
        part = FloorPlan("part", tuple(surfaces), (), (), (begin,), (), building)
        ways = (reach(part, WHEELCHAIR.length, WHEELCHAIR.width, *how) for how in SEARCH_GRIDS)
        if entry.open and any(way.near(shapely.LineString(door.jambs)) for way in ways):
            return True
    return False


def _around(room: Box) -> shapely.Polygon:
    return room.grown(SURROUNDINGS_MARGIN).polygon()
