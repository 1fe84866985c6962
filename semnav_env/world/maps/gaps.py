"""Gaps in the walls of a plan: to the outside, and out of rooms other than through their doors.

A space is the area that can be reached from a point without touching a wall, through gaps of any
width. A space that is too narrow for every robot does not count: the hollow between the two faces
of a wall, or the strip by which the outline of a room misses its wall.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import LineString, Point, Polygon, STRtree
from shapely.geometry.base import BaseGeometry

from semnav_env.world.maps.doorways import DRAWING_TOLERANCE, NARROWEST_ROBOT
from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_env.world.maps.plan_fault import PlanFault, point_in, written

Lines = NDArray[np.object_] | Sequence[LineString]
"""Lines of Shapely, as an array or a sequence."""


HALF_LINE_WIDTH = 0.0005
"""Half the thickness of walls that separates the spaces between them, metres: nearly zero."""

MAX_GAP = 2.0
"""Width of the widest gap, metres. Without other information, the inside is the area that the walls
enclose when gaps up to this width are closed."""

OUTLINE_ERROR = 0.3
"""Distance by which the outline of a room may miss its wall, metres."""

OUTSIDE_MARGIN = MAX_GAP
"""Width of the outside that is examined around the boundary, metres."""


def gaps(plan: FloorPlan) -> Iterator[PlanFault]:
    """All gaps of a plan, each as a fault with its place."""
    walls = np.asarray(shapely.linestrings(plan.segments.reshape(-1, 2, 2)))
    thin = _thick(walls, HALF_LINE_WIDTH, 1)
    at = _way_out(plan, walls, thin)
    if at is not None:
        problem = f"one can walk out of the building at {written(at)}; close the walls"
        yield PlanFault(plan.name, problem, at)
    yield from _room_gaps(plan, thin)


def _way_out(
    plan: FloorPlan, walls: NDArray[np.object_], thin: BaseGeometry
) -> tuple[float, float] | None:
    """A place where the outside and something inside are one space; None if there is none."""
    outside = _outside(plan, thin)
    near = walls[shapely.dwithin(walls, plan.boundary.exterior, 2 * DRAWING_TOLERANCE)]
    on_walls = plan.boundary.exterior.intersection(_thick(near, 2 * DRAWING_TOLERANCE))
    if on_walls.length > plan.boundary.exterior.length / 2:
        return _gap(outside, plan.boundary)
    ways = (_gap(outside, region.polygon) for region in plan.regions)
    return next((at for at in ways if at is not None), None) or _gap_in_walls(plan, walls, outside)


def _gap(outside: Polygon, inside: Polygon) -> tuple[float, float] | None:
    """A place where the outside reaches into a region; None if it does not."""
    part_outside = outside.intersection(inside.buffer(-2 * DRAWING_TOLERANCE))
    return _at(outside, inside, part_outside) if _fits(NARROWEST_ROBOT, part_outside) else None


def _gap_in_walls(plan: FloorPlan, walls: Lines, outside: Polygon) -> tuple[float, float] | None:
    """The gap through which the outside reaches into what the walls enclose except for gaps.

    Where they enclose several spaces, the gap is that of the largest.
    """
    thick = _thick(walls, MAX_GAP / 2)
    around = _outside(plan, thick)
    for enclosed in sorted(_spaces(plan, thick), key=lambda space: -space.area):
        if not enclosed.equals(around) and outside.intersects(enclosed):
            across = shapely.shortest_line(enclosed, around)  # shorter than through any wall
            return point_in(across.interpolate(0.5, normalized=True))
    return None


def _room_gaps(plan: FloorPlan, thin: BaseGeometry) -> Iterator[PlanFault]:
    """Places where a space reaches out of a room although all doors are sealed."""
    doors = [LineString((door.start, door.end)) for door in plan.doors]
    spaces = _spaces(plan, thin.union(_thick(doors, HALF_LINE_WIDTH, 1)))
    tree = STRtree(spaces)
    for room in plan.rooms:
        core = room.polygon.buffer(-DRAWING_TOLERANCE)
        for index in sorted(tree.query(core, "intersects").tolist()):
            space = spaces[index]
            if not _fits(NARROWEST_ROBOT, space.intersection(core)):
                continue
            near = shapely.clip_by_rect(space, *room.polygon.buffer(MAX_GAP).bounds)
            part_outside = near.difference(room.polygon.buffer(DRAWING_TOLERANCE))
            if _fits(OUTLINE_ERROR, part_outside):
                at = _at(space, room.polygon, part_outside)
                problem = f"has a gap at {written(at)}, other than through a door; close it"
                yield PlanFault(room.name, problem, at)


def _thick(lines: Lines, by: float, quad_segs: int = 16) -> BaseGeometry:
    """Everything within a distance of lines.

    To unite thousands of thick lines takes far less time than to thicken their union.
    """
    return shapely.union_all(shapely.buffer(lines, by, quad_segs=quad_segs))


def _fits(width: float, space: BaseGeometry) -> bool:
    """Whether a disc of some width fits into a space."""
    return not space.buffer(-width / 2).is_empty


def _at(space: Polygon, region: BaseGeometry, part_outside: BaseGeometry) -> tuple[float, float]:
    """The middle of the widest gap through which a space crosses the edge of a region."""
    edge = shapely.line_merge(space.intersection(region.boundary))
    crossings = [part for part in shapely.get_parts(edge) if part.length > 0.0]
    if not crossings:
        return point_in(part_outside)
    return point_in(max(crossings, key=lambda part: part.length).interpolate(0.5, normalized=True))


def _spaces(plan: FloorPlan, solid: BaseGeometry) -> list[Polygon]:
    """The connected spaces between what is solid; the outside is one of them."""
    around = shapely.box(*plan.boundary.bounds).buffer(OUTSIDE_MARGIN, join_style="mitre")
    return list(shapely.get_parts(around.difference(solid)))


def _outside(plan: FloorPlan, solid: BaseGeometry) -> Polygon:
    """The space that contains the south-west corner of the area."""
    west, south, _, _ = plan.boundary.bounds
    corner = Point(west - 0.95 * OUTSIDE_MARGIN, south - 0.95 * OUTSIDE_MARGIN)
    return next(space for space in _spaces(plan, solid) if space.contains(corner))
