"""What a maker of plans should know: leaks, and doors and rooms that no robot can reach."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import shapely
from shapely import LineString, MultiLineString, Point, Polygon
from shapely.geometry.base import BaseGeometry

from semnav_env.maps.doorways import TOUCH
from semnav_env.maps.floor_plan import FloorPlan, Region
from semnav_env.maps.rules import FloorPlanError, check_plan

WHEELCHAIR_WIDTH = 0.65
LINE = 0.0005
"""Half the thickness, in metres, that walls get to tell the spaces between them apart."""


@dataclass(frozen=True)
class Finding:
    """Something that a maker of plans would want to mend.

    Attributes:
        part: the door, region or plan it is about.
        problem: what is wrong with it.
    """

    part: str
    problem: str

    def __str__(self) -> str:
        return f"{self.part}: {self.problem}"


def check(plan: FloorPlan, robot_width: float = WHEELCHAIR_WIDTH) -> list[Finding]:
    """Everything found wrong with a plan; an empty list if nothing.

    A plan that breaks a rule gets that one finding; else it is searched for leaks (to the outside,
    and out of rooms other than through their doors) and for open doors and rooms that a disc
    as wide as the robot cannot reach from the corridors.

    Args:
        plan: the plan.
        robot_width: metres.
    """
    try:
        check_plan(plan)
    except FloorPlanError as error:
        return [Finding(plan.name, str(error))]
    return [*_leaks_outside(plan), *_leaks_of_rooms(plan), *_unreachable(plan, robot_width)]


def reachable(plan: FloorPlan, robot_width: float) -> BaseGeometry:
    """Where the centre of a disc of that width can get to from the corridors."""
    free = plan.boundary.difference(_walls(plan).buffer(robot_width / 2))
    corridors = shapely.union_all([r.polygon for r in plan.corridors]) or plan.boundary
    return max(shapely.get_parts(free), key=lambda p: p.intersection(corridors).area, default=free)


def _leaks_outside(plan: FloorPlan) -> Iterator[Finding]:
    """Spaces that hold both the outside and something well inside the boundary."""
    outside = next(s for s in _spaces(plan, seal_doors=False) if s.contains(_far_corner(plan)))
    inside = plan.boundary.buffer(-2 * TOUCH)
    leak = outside.intersection(inside)
    if leak.area > TOUCH**2:
        at = _at(leak.representative_point())
        yield Finding(plan.name, f"one can walk out of the building from {at}; close the walls")


def _leaks_of_rooms(plan: FloorPlan) -> Iterator[Finding]:
    """With all doors sealed, no space may reach from a room to somewhere else."""
    for space in _spaces(plan, seal_doors=True):
        for room in plan.rooms:
            leak = space.difference(room.polygon.buffer(TOUCH))
            if _meets(space, room) and leak.area > TOUCH**2:
                at = _at(leak.representative_point())
                yield Finding(room.name, f"leaks to {at} other than through a door; close it")


def _unreachable(plan: FloorPlan, width: float) -> Iterator[Finding]:
    way = reachable(plan, width)
    for door in plan.doors:
        if door.open and not way.intersects(LineString((door.start, door.end))):
            yield Finding(door.name, f"a robot {width} m wide cannot get through this open door")
    for room in plan.rooms:
        opens = [d for d in plan.doors if d.open and room.polygon.dwithin(Point(d.midpoint), TOUCH)]
        if opens and not way.intersects(room.polygon.buffer(-TOUCH)):
            yield Finding(room.name, f"a robot {width} m wide cannot get into this room")


def _spaces(plan: FloorPlan, seal_doors: bool) -> list[Polygon]:
    """The connected spaces between the walls, the outside among them."""
    doors = [LineString((door.start, door.end)) for door in plan.doors] if seal_doors else []
    solid = shapely.union_all([_walls(plan), *doors]).buffer(LINE)
    sheet = shapely.box(*plan.boundary.bounds).buffer(1.0, join_style="mitre")
    return list(shapely.get_parts(sheet.difference(solid)))


def _walls(plan: FloorPlan) -> MultiLineString:
    return shapely.multilinestrings(shapely.linestrings(plan.segments.reshape(-1, 2, 2)))


def _meets(space: Polygon, region: Region) -> bool:
    return float(space.intersection(region.polygon.buffer(-TOUCH)).area) > TOUCH**2


def _far_corner(plan: FloorPlan) -> Point:
    west, south, _, _ = plan.boundary.bounds
    return Point(west - 0.9, south - 0.9)


def _at(point: Point) -> str:
    return f"({point.x:.2f}, {point.y:.2f})"
