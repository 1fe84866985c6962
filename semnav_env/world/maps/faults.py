"""Parts of a plan that contradict each other: overlapping rooms, blocked doorways, odd doors."""

from __future__ import annotations

from collections.abc import Iterator

import shapely
import shapely.ops
from shapely import LineString, Point, Polygon, STRtree

from semnav_env.world.maps.doorways import DRAWING_TOLERANCE, NARROWEST_ROBOT
from semnav_env.world.maps.floor_plan import FloorPlan, Material, PlanDoor, Surface
from semnav_env.world.maps.plan_fault import PlanFault, point_in, written

DOORSTEP_DEPTH = 0.3
"""Distance before and behind a doorway that must be free, metres."""

WALL_MATERIALS = (Material.WALL, Material.GLASS)
"""Materials that a door can be framed by."""


def faults(plan: FloorPlan) -> Iterator[PlanFault]:
    """All faults of a plan except gaps and unreachable places."""
    yield from _overlaps(plan)
    for door in plan.doors:
        yield from _unframed(door, plan)
        yield from _obstructed(door, plan)
        yield from _leading_nowhere(door, plan)
    yield from _outside(plan)


def _overlaps(plan: FloorPlan) -> Iterator[PlanFault]:
    """Rooms and areas that share floor with each other or with a corridor, and space for a robot.

    What is narrower is passed: no robot stands in it, so none is in two rooms.
    """
    regions = [*plan.rooms, *plan.areas, *plan.corridors]
    enclosed = len(plan.rooms) + len(plan.areas)
    tree = STRtree([region.polygon for region in regions])
    for i, region in enumerate(regions[:enclosed]):
        for j in sorted(tree.query(region.polygon, "intersects").tolist()):
            shared = region.polygon.intersection(regions[j].polygon)
            if j > i and not shared.buffer(-NARROWEST_ROBOT / 2).is_empty:
                problem = f"overlaps {regions[j].name} by {shared.area:.2f} m2; part the two"
                yield PlanFault(region.name, problem, point_in(shared))


def _unframed(door: PlanDoor, plan: FloorPlan) -> Iterator[PlanFault]:
    """Jambs that are neither on a wall nor on a pane of glass, but for example on a cabinet."""
    for jamb in (door.start, door.end):
        owners = {s.material for s in _surfaces(plan, Point(jamb).buffer(DRAWING_TOLERANCE))}
        if not owners & set(WALL_MATERIALS):
            problem = f"this door does not lie in a wall at {written(jamb)}; draw one"
            yield PlanFault(door.name, problem, jamb)


def _obstructed(door: PlanDoor, plan: FloorPlan) -> Iterator[PlanFault]:
    """Things other than its leaf that stand in a doorway or directly before it."""
    opening = LineString((door.start, door.end))
    share = min(0.4, 2 * DRAWING_TOLERANCE / door.width)
    clear = shapely.ops.substring(opening, share, 1.0 - share, normalized=True)
    step = clear.buffer(DOORSTEP_DEPTH, cap_style="flat")
    for surface in _surfaces(plan, step):
        if surface.material is not Material.LEAF and (door.open or not _fills(surface, opening)):
            line = LineString(surface.points).intersection(step)
            problem = f"{surface.material} at {written(point_in(line))} stands in this doorway"
            yield PlanFault(door.name, problem, point_in(line))


def _fills(surface: Surface, opening: LineString) -> bool:
    """Whether a surface closes a door."""
    return bool(LineString(surface.points).buffer(DRAWING_TOLERANCE).covers(opening))


def _leading_nowhere(door: PlanDoor, plan: FloorPlan) -> Iterator[PlanFault]:
    """Doors with the same region on both sides."""
    (x1, y1), (x2, y2) = door.start, door.end
    nx, ny = (y2 - y1) / door.width, (x1 - x2) / door.width
    x, y = door.midpoint
    sides = [Point(x + d * nx, y + d * ny) for d in (DOORSTEP_DEPTH, -DOORSTEP_DEPTH)]
    before, behind = ([r for r in plan.regions if r.polygon.covers(side)] for side in sides)
    if before and {r.name for r in before} == {r.name for r in behind}:
        problem = f"this door leads from {before[0].name} to itself; put it in a wall"
        yield PlanFault(door.name, problem, door.midpoint)


def _outside(plan: FloorPlan) -> Iterator[PlanFault]:
    """Furniture that reaches out of the building."""
    inside = plan.boundary.buffer(DRAWING_TOLERANCE)
    shapely.prepare(inside)
    for surface in plan.surfaces:
        line = LineString(surface.points)
        if surface.material is Material.FURNITURE and not inside.covers(line):
            at = point_in(line.difference(inside))
            problem = f"furniture at {written(at)} reaches out of the building; move it"
            yield PlanFault(plan.name, problem, at)


def _surfaces(plan: FloorPlan, area: Polygon) -> list[Surface]:
    """The surfaces that meet an area, in the order of the plan."""
    rows = plan.solids.query(area, "intersects")
    return [plan.surfaces[i] for i in sorted(set(plan.owners[rows].tolist()))]
