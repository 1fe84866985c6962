"""Draws on a floor plan: rooms, corridors, walls and its scale; `door_drawing` draws doors.

Every function returns a new plan, so whoever keeps the old ones can undo. Places are (x, y) in
metres, as a person points them out on the plan, exact to some decimetres: rooms and corridors take
their outlines from the walls.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import replace

import numpy as np
import shapely
from shapely import LineString, Polygon
from shapely.geometry.base import BaseGeometry

from semnav_env.world.maps.floor_plan import FloorPlan, PlanDoor, Region, Surface
from semnav_env.world.maps.importers.building_doors import corridor_to_the_left
from semnav_env.world.maps.rules import FloorPlanError, check_plan
from semnav_features.frames import FloatArray, Point

WALL_DISTANCE = 0.06
"""Distance of the outline of a room from what is solid while it is sought, metres: gaps of up to
twice this width let nothing through."""

OUTLINE_TOLERANCE = 0.02
"""Largest error of the simplified outline of a room, metres."""

FARTHEST_WALL = 8.0
"""Distance from the middle of a corridor at which a wall still bounds it, metres."""

MAX_SLANT = 0.2
"""Largest angle between a corridor as it is drawn and its walls, radians."""

END_REACH = 1.5
"""Distance by which a corridor grows to the wall at its end, metres."""

CROSS_SECTIONS = 41
"""Number of cross-sections of a corridor, whose median is its width; odd, so that it is one of
them."""

LEAST_CROSSING = 0.25
"""Area of the smallest intersection of two corridors, square metres."""


def with_room(plan: FloorPlan, at: Point, name: str) -> FloorPlan:
    """The plan with the room around a place: all that can be reached there while doors are shut.

    If a region is there already, it gets the name.

    Raises:
        FloorPlanError: the place lies in a wall, or the space around it leads out of the building
            or into a corridor; or the name is taken.
    """
    spot = shapely.Point(at)
    if (there := _region_at(plan, at)) is not None:
        return _checked(_mapped(plan, lambda r: replace(r, name=name) if r is there else r))
    free = plan.boundary.difference(_thick_walls(plan, WALL_DISTANCE))
    space = next((part for part in shapely.get_parts(free) if part.contains(spot)), None)
    if space is None:
        raise FloorPlanError(f"{_at(at)} lies in a wall; point at the floor of the room")
    if space.dwithin(plan.boundary.exterior, WALL_DISTANCE / 2.0):
        raise FloorPlanError(
            f"the space around {_at(at)} leads out of the building; draw walls or doors into its "
            "openings first"
        )
    outline = Polygon(space.exterior).buffer(WALL_DISTANCE, join_style="mitre")
    outline = outline.simplify(OUTLINE_TOLERANCE)
    for corridor in plan.corridors:
        if outline.intersection(corridor.polygon).area > LEAST_CROSSING:
            raise FloorPlanError(
                f"the space around {_at(at)} leads into {corridor.name}; draw a door between"
            )
    room = Region(name, _within(plan.boundary, outline.difference(_area(plan.regions))))
    return _checked(replace(plan, rooms=(*plan.rooms, room)))


def with_corridor(plan: FloorPlan, start: Point, end: Point, name: str = "") -> FloorPlan:
    """The plan with a corridor along a line, as wide as its walls and up to those at its ends.

    Where it crosses another corridor, there is an intersection. Doors turn their left side to it.

    Args:
        plan: the plan.
        start: a place in its middle, near one of its ends.
        end: the same near the other end.
        name: of the corridor; the next free number if empty.

    Raises:
        FloorPlanError: there is no wall on one of its sides, or the name is taken.
    """
    walls = shapely.union_all(_lines(plan))
    start, end = _aligned(plan, start, end)
    start, end = _far_end(end, start, walls), _far_end(start, end, walls)
    length = math.dist(start, end)
    if length < 2.0 * WALL_DISTANCE:
        raise FloorPlanError("the corridor has no length; draw along it from end to end")
    along = np.subtract(end, start) / length
    left = np.array((-along[1], along[0]))
    middles = start + np.linspace(0.02, 0.98, CROSS_SECTIONS)[:, None] * length * along
    widths = [
        float(np.median([_free(middle, side * left, FARTHEST_WALL, walls) for middle in middles]))
        for side in (1.0, -1.0)
    ]
    if max(widths) >= FARTHEST_WALL:
        raise FloorPlanError(f"no wall within {FARTHEST_WALL:g} m beside most of the corridor")
    on_left, on_right = widths[0] * left, -widths[1] * left
    corners = [start + on_right, end + on_right, end + on_left, start + on_left]
    area = Polygon(corners).difference(_area(plan.rooms))
    corridor = Region(name or _free_name(plan, "corridor"), _within(plan.boundary, area))
    crossed = _with_crossings(plan, corridor)
    wider = replace(crossed, corridors=(*crossed.corridors, corridor))
    return _checked(
        replace(wider, doors=tuple(corridor_to_the_left(d, wider) for d in wider.doors))
    )


def with_wall(plan: FloorPlan, start: Point, end: Point) -> FloorPlan:
    """The plan with a wall more, which closes a gap.

    Raises:
        FloorPlanError: it fills a door that is open, or has no length.
    """
    return _checked(replace(plan, surfaces=(*plan.surfaces, Surface((start, end)))))


def without_part(plan: FloorPlan, at: Point) -> FloorPlan:
    """The plan without the door or, if there is none, the region at a place.

    The leaf of a closed door goes with it.

    Raises:
        FloorPlanError: neither is there.
    """
    near = [door for door in plan.doors if _distance(door, at) <= door.width / 2.0]
    if near:
        gone = min(near, key=lambda door: _distance(door, at))
        leaf = {(gone.start, gone.end), (gone.end, gone.start)}
        kept = tuple(each for each in plan.surfaces if each.points not in leaf)
        doors = tuple(door for door in plan.doors if door is not gone)
        return _checked(replace(plan, surfaces=kept, doors=doors))
    region = _region_at(plan, at)
    if region is None:
        raise FloorPlanError(f"there is neither a door nor a region at {_at(at)}")
    return _checked(_mapped(plan, lambda each: None if each is region else each))


def scaled(plan: FloorPlan, start: Point, end: Point, length: float) -> FloorPlan:
    """The plan in the scale in which two places are so far from each other.

    Args:
        plan: the plan.
        start: one place.
        end: the other.
        length: their true distance, metres.

    Raises:
        FloorPlanError: the places are the same, or the plan breaks a rule in that scale.
    """
    drawn = math.dist(start, end)
    if not (drawn > 0.0 and length > 0.0 and math.isfinite(length)):
        raise FloorPlanError("a known length is drawn from one place to another, and more than 0 m")
    factor = length / drawn

    def point(p: Point) -> Point:
        return p[0] * factor, p[1] * factor

    def area(polygon: Polygon) -> Polygon:
        return shapely.transform(polygon, lambda points: points * factor)

    larger = replace(
        plan,
        surfaces=tuple(replace(s, points=tuple(map(point, s.points))) for s in plan.surfaces),
        doors=tuple(replace(d, start=point(d.start), end=point(d.end)) for d in plan.doors),
        boundary=area(plan.boundary),
    )
    return _checked(_mapped(larger, lambda each: replace(each, polygon=area(each.polygon))))


def _checked(plan: FloorPlan) -> FloorPlan:
    check_plan(plan)
    return plan


def _mapped(plan: FloorPlan, change: Callable[[Region], Region | None]) -> FloorPlan:
    """The plan with its regions changed; those that become None are left out."""

    def each(regions: tuple[Region, ...]) -> tuple[Region, ...]:
        return tuple(new for region in regions if (new := change(region)) is not None)

    return replace(
        plan,
        rooms=each(plan.rooms),
        corridors=each(plan.corridors),
        intersections=each(plan.intersections),
        areas=each(plan.areas),
    )


def _with_crossings(plan: FloorPlan, corridor: Region) -> FloorPlan:
    """The plan with an intersection wherever a new corridor crosses another one."""
    for other in plan.corridors:
        common = corridor.polygon.intersection(other.polygon)
        if common.area >= LEAST_CROSSING:
            named = Region(_free_name(plan, "intersection"), _within(plan.boundary, common))
            plan = replace(plan, intersections=(*plan.intersections, named))
    return plan


def _region_at(plan: FloorPlan, at: Point) -> Region | None:
    """The smallest region at a place."""
    spot = shapely.Point(at)
    there = [region for region in plan.regions if region.polygon.covers(spot)]
    return min(there, key=lambda region: region.polygon.area, default=None)


def _thick_walls(plan: FloorPlan, by: float) -> BaseGeometry:
    """Everything within a distance of what is solid while all doors are shut."""
    return shapely.union_all(shapely.buffer(_lines(plan), by))


def _lines(plan: FloorPlan) -> np.ndarray:
    """Everything solid and the lines of all doors, as lines of Shapely."""
    rows = np.vstack((plan.segments, plan.door_ends))
    return np.asarray(shapely.linestrings(rows.reshape(-1, 2, 2)))


def _aligned(plan: FloorPlan, start: Point, end: Point) -> tuple[Point, Point]:
    """The middle line of a corridor, turned about its middle to run along the walls beside it."""
    near = plan.segments[plan.solids.query(LineString((start, end)), "dwithin", FARTHEST_WALL / 2)]
    runs = near[:, 2:] - near[:, :2]
    x, y = np.subtract(end, start)
    slants = np.arctan2(x * runs[:, 1] - y * runs[:, 0], x * runs[:, 0] + y * runs[:, 1])
    slants = (slants + math.pi / 2) % math.pi - math.pi / 2  # a wall has two directions
    lengths = np.hypot(*runs.T) * (np.abs(slants) < MAX_SLANT)
    if lengths.sum() == 0.0:
        return start, end
    middle = np.add(start, end) / 2
    turn = float(np.average(slants, weights=lengths))
    cosine, sine = math.cos(turn), math.sin(turn)
    half = np.array((cosine * x - sine * y, sine * x + cosine * y))
    first, last = (middle - half / 2).tolist(), (middle + half / 2).tolist()
    return (first[0], first[1]), (last[0], last[1])


def _far_end(begin: Point, end: Point, walls: BaseGeometry) -> Point:
    """The end of a corridor's middle line: at the wall before it or at most `END_REACH` behind."""
    middle, length = np.add(begin, end) / 2.0, math.dist(begin, end)
    if length == 0.0:
        return end
    direction = np.subtract(end, begin) / length
    reach = length / 2.0 + END_REACH
    free = _free(middle, direction, reach, walls)
    x, y = middle + (free if free < reach else length / 2.0) * direction
    return float(x), float(y)


def _free(origin: FloatArray, direction: FloatArray, reach: float, walls: BaseGeometry) -> float:
    """Distance from a place to the first wall in a direction, at most `reach`, metres."""
    ray = LineString((origin, origin + reach * direction))
    hits = shapely.get_coordinates(ray.intersection(walls))
    return float(min(np.hypot(*(hits - origin).T), default=reach))


def _within(boundary: Polygon, area: BaseGeometry) -> Polygon:
    """The largest connected part of an area that lies in the boundary."""
    parts = shapely.get_parts(area.intersection(boundary))
    solid = [part for part in parts if isinstance(part, Polygon)]
    if not solid:
        raise FloorPlanError("nothing of it is free and inside the boundary")
    return max(solid, key=lambda part: part.area)


def _area(regions: Iterable[Region]) -> BaseGeometry:
    return shapely.union_all([region.polygon for region in regions])


def _distance(door: PlanDoor, at: Point) -> float:
    return math.dist(door.midpoint, at)


def _free_name(plan: FloorPlan, kind: str) -> str:
    """A name that no region of the plan has, as "corridor_1"."""
    taken = {region.name for region in plan.regions}
    return next(name for k in range(1, len(taken) + 2) if (name := f"{kind}_{k}") not in taken)


def _at(point: Point) -> str:
    return f"({point[0]:.2f}, {point[1]:.2f})"
