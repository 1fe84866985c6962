"""The solid lines of a floor plan, and the ways between them."""

from __future__ import annotations

import math

import shapely
from shapely import LineString, Polygon
from shapely.geometry.base import BaseGeometry

from semnav_env.world.maps import FloorPlan, PlanDoor


def solid(plan: FloorPlan, assumed: bool = True) -> shapely.MultiLineString:
    lines = [s.points for s in plan.surfaces if assumed or not s.assumed]
    return shapely.union_all([LineString(points) for points in lines])


def lane(start: tuple[float, float], heading: float, length: float, width: float) -> Polygon:
    end = start[0] + length * math.cos(heading), start[1] + length * math.sin(heading)
    return LineString((start, end)).buffer(width / 2, cap_style="flat")


def reachable(plan: FloorPlan, width: float) -> BaseGeometry:
    """Where the centre of a disc of that width can get to from the corridors."""
    free = plan.boundary.difference(solid(plan).buffer(width / 2))
    corridors = shapely.union_all([r.polygon for r in plan.corridors])
    return max(shapely.get_parts(free), key=lambda part: part.intersection(corridors).area)


def inward(door: PlanDoor) -> float:
    """Heading square through the door, away from its corridor."""
    return math.atan2(door.end[1] - door.start[1], door.end[0] - door.start[0]) - math.pi / 2
