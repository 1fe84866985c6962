"""Gaps in the walls of a plan: to the outside, and out of rooms other than through their doors."""

from __future__ import annotations

from collections.abc import Iterator

import shapely
from shapely import LineString, Point, Polygon, STRtree
from shapely.geometry.base import BaseGeometry

from semnav_env.maps.doorways import TOUCH
from semnav_env.maps.finding import Finding, point_in, written
from semnav_env.maps.floor_plan import FloorPlan

LINE = 0.0005
"""Half the thickness, in metres, that walls get to tell the spaces between them apart."""


def leaks(plan: FloorPlan) -> Iterator[Finding]:
    """All of them."""
    walls = shapely.union_all(shapely.linestrings(plan.segments.reshape(-1, 2, 2)))
    yield from _leaks_outside(plan, walls)
    yield from _leaks_of_rooms(plan, walls)


def _leaks_outside(plan: FloorPlan, walls: BaseGeometry) -> Iterator[Finding]:
    """Spaces that hold both the outside and something well inside the boundary."""
    outside = next(s for s in _spaces(plan, walls) if s.contains(_far_corner(plan)))
    inside = plan.boundary.buffer(-2 * TOUCH)
    leak = outside.intersection(inside)
    if leak.area > TOUCH**2:
        gap = outside.intersection(inside.boundary)
        at = point_in(leak if gap.is_empty else gap)
        problem = f"one can walk out of the building at {written(at)}; close the walls"
        yield Finding(plan.name, problem, at)


def _leaks_of_rooms(plan: FloorPlan, walls: BaseGeometry) -> Iterator[Finding]:
    """With all doors sealed, no space may reach from a room to somewhere else."""
    doors = [LineString((door.start, door.end)) for door in plan.doors]
    spaces = STRtree(_spaces(plan, shapely.union_all([walls, *doors])))
    for room in plan.rooms:
        core = room.polygon.buffer(-TOUCH)
        for index in sorted(spaces.query(core, "intersects").tolist()):
            space = spaces.geometries[index]
            leak = space.difference(room.polygon.buffer(TOUCH))
            if space.intersection(core).area > TOUCH**2 and leak.area > TOUCH**2:
                gap = space.intersection(room.polygon.boundary)
                at = point_in(leak if gap.is_empty else gap)
                problem = f"leaks at {written(at)} other than through a door; close it"
                yield Finding(room.name, problem, at)


def _spaces(plan: FloorPlan, walls: BaseGeometry) -> list[Polygon]:
    """The connected spaces between the walls, the outside among them."""
    solid = walls.buffer(LINE, quad_segs=1)
    sheet = shapely.box(*plan.boundary.bounds).buffer(1.0, join_style="mitre")
    return list(shapely.get_parts(sheet.difference(solid)))


def _far_corner(plan: FloorPlan) -> Point:
    west, south, _, _ = plan.boundary.bounds
    return Point(west - 0.9, south - 0.9)
