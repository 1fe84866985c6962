"""The hall of the villa with a fifth door, which Mes 2021 has and her tables leave out."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import shapely
from shapely import LineString, box

from semnav_env.world.maps import FloorPlan, PlanDoor, Region, Surface, load_floor_plan

DOOR = PlanDoor("study", (0.0, 2.9), (0.0, 2.0))
"""In the south arm, where the hall is 2.4 m wide: the square before it is free."""

ROOM = Region("study", box(-3.6, 0.4, 0.0, 3.4), assumed=True)
"""The room behind it; where it lies in the villa is not known."""


@cache
def villa_with_five_doors() -> FloorPlan:
    """Her hall and its four doors, as bundled, and the fifth one with its room."""
    plan = load_floor_plan("villa_hall")
    opening = LineString((DOOR.start, DOOR.end))
    surfaces = [each for known in plan.surfaces for each in _parted(known, opening)]
    walls = ROOM.polygon.exterior.difference(LineString(((0.0, 0.4), (0.0, 3.4))))
    inside = Surface(tuple(map(tuple, walls.coords)), assumed=True)
    return replace(
        plan,
        name="villa_with_five_doors",
        surfaces=(*surfaces, inside),
        doors=(*plan.doors, DOOR),
        rooms=(*plan.rooms, ROOM),
        boundary=shapely.union(plan.boundary, ROOM.polygon),
    )


def _parted(surface: Surface, opening: LineString) -> list[Surface]:
    """A wall without the part that lies in an opening."""
    line = LineString(surface.points)
    if line.intersection(opening).length == 0.0:
        return [surface]
    parts = shapely.get_parts(line.difference(opening))
    return [replace(surface, points=tuple(map(tuple, part.coords))) for part in parts]
