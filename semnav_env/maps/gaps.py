"""Gaps in the walls of a plan: to the outside, and out of rooms other than through their doors.

A space is what one can get to without touching a wall, be a gap as small as it may. What is too
narrow for any robot is no place, though: the hollow between the two faces of a wall, or the strip
by which the outline of a room misses its wall.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import LineString, Point, Polygon, STRtree
from shapely.geometry.base import BaseGeometry

from semnav_env.maps.doorways import NARROWEST_ROBOT, TOUCH
from semnav_env.maps.floor_plan import FloorPlan
from semnav_env.maps.plan_fault import PlanFault, point_in, written

Lines = NDArray[np.object_] | Sequence[LineString]

LINE = 0.0005
"""Half the thickness, in metres, that walls get to tell the spaces between them apart."""

WIDEST_GAP = 2.0
"""Where nothing else tells the inside, what walls enclose but for gaps up to this is, metres."""

NICHE = 0.3
"""By less than this the outline of a room only misses its wall, metres."""

SHEET = WIDEST_GAP
"""So far around the boundary lies the outside, metres."""


def leaks(plan: FloorPlan) -> Iterator[PlanFault]:
    """All of them."""
    walls = shapely.linestrings(plan.segments.reshape(-1, 2, 2))
    thin = _thick(walls, LINE, 1)
    at = _way_out(plan, walls, thin)
    if at is not None:
        problem = f"one can walk out of the building at {written(at)}; close the walls"
        yield PlanFault(plan.name, problem, at)
    yield from _leaks_of_rooms(plan, thin)


def _way_out(
    plan: FloorPlan, walls: NDArray[np.object_], thin: BaseGeometry
) -> tuple[float, float] | None:
    """Where the outside and something inside are one space."""
    outside = _outside(plan, thin)
    near = walls[shapely.dwithin(walls, plan.boundary.exterior, 2 * TOUCH)]
    on_walls = plan.boundary.exterior.intersection(_thick(near, 2 * TOUCH))
    if on_walls.length > plan.boundary.exterior.length / 2:
        return _gap(outside, plan.boundary)
    ways = (_gap(outside, region.polygon) for region in plan.regions)
    return next((at for at in ways if at is not None), None) or _gap_in_walls(plan, walls, outside)


def _gap(outside: Polygon, inside: Polygon) -> tuple[float, float] | None:
    """Where the outside gets into something."""
    leak = outside.intersection(inside.buffer(-2 * TOUCH))
    return _at(outside, inside, leak) if _fits(NARROWEST_ROBOT, leak) else None


def _gap_in_walls(plan: FloorPlan, walls: Lines, outside: Polygon) -> tuple[float, float] | None:
    """The gap through which the outside gets into what the walls enclose but for gaps.

    Of several enclosed spaces that of the largest.
    """
    thick = _thick(walls, WIDEST_GAP / 2)
    around = _outside(plan, thick)
    for enclosed in sorted(_spaces(plan, thick), key=lambda space: -space.area):
        if not enclosed.equals(around) and outside.intersects(enclosed):
            across = shapely.shortest_line(enclosed, around)  # shorter than through any wall
            return point_in(across.interpolate(0.5, normalized=True))
    return None


def _leaks_of_rooms(plan: FloorPlan, thin: BaseGeometry) -> Iterator[PlanFault]:
    """With all doors sealed, no space may reach from a room to somewhere else."""
    doors = [LineString((door.start, door.end)) for door in plan.doors]
    spaces = STRtree(_spaces(plan, thin.union(_thick(doors, LINE, 1))))
    for room in plan.rooms:
        core = room.polygon.buffer(-TOUCH)
        for index in sorted(spaces.query(core, "intersects").tolist()):
            space = spaces.geometries[index]
            if not _fits(NARROWEST_ROBOT, space.intersection(core)):
                continue
            near = shapely.clip_by_rect(space, *room.polygon.buffer(WIDEST_GAP).bounds)
            leak = near.difference(room.polygon.buffer(TOUCH))
            if _fits(NICHE, leak):
                at = _at(space, room.polygon, leak)
                problem = f"leaks at {written(at)} other than through a door; close it"
                yield PlanFault(room.name, problem, at)


def _thick(lines: Lines, by: float, quad_segs: int = 16) -> BaseGeometry:
    """What lies within a distance of lines.

    Thousands of thick lines are united in far less time than their union is made thick.
    """
    return shapely.union_all(shapely.buffer(lines, by, quad_segs=quad_segs))


def _fits(width: float, space: BaseGeometry) -> bool:
    """Whether a disc so wide fits in."""
    return not space.buffer(-width / 2).is_empty


def _at(space: Polygon, region: BaseGeometry, leak: BaseGeometry) -> tuple[float, float]:
    """The middle of the widest gap through which a space crosses the edge of a region."""
    edge = shapely.line_merge(space.intersection(region.boundary))
    gaps = [part for part in shapely.get_parts(edge) if part.length > 0.0]
    if not gaps:
        return point_in(leak)
    return point_in(max(gaps, key=lambda gap: gap.length).interpolate(0.5, normalized=True))


def _spaces(plan: FloorPlan, solid: BaseGeometry) -> list[Polygon]:
    """The connected spaces beside what is solid, the outside among them."""
    sheet = shapely.box(*plan.boundary.bounds).buffer(SHEET, join_style="mitre")
    return list(shapely.get_parts(sheet.difference(solid)))


def _outside(plan: FloorPlan, solid: BaseGeometry) -> Polygon:
    """The space that holds the corner of the sheet."""
    west, south, _, _ = plan.boundary.bounds
    corner = Point(west - 0.95 * SHEET, south - 0.95 * SHEET)
    return next(space for space in _spaces(plan, solid) if space.contains(corner))
