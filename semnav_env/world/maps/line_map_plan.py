"""Makes a floor plan that keeps all rules of floor plans from a map of lines."""

from __future__ import annotations

from collections.abc import Sequence

import shapely
from shapely import LineString, Point, Polygon, STRtree
from shapely.geometry.base import BaseGeometry

from semnav_env.world.maps.doorways import (
    DRAWING_TOLERANCE,
    NARROWEST_ROBOT,
    DoorState,
    clear_width,
    door_state,
)
from semnav_env.world.maps.floor_plan import FloorPlan, PlanDoor, Surface
from semnav_env.world.maps.rules import FloorPlanError
from semnav_features.elements import Door
from semnav_features.scene import Scene

_BOUNDARY_MARGIN = 0.5
"""Distance from the outermost wall to the boundary, metres."""

_LEAST_REMNANT = 0.02
"""Least length of a remaining part of a wall beside a doorway that is kept, metres."""

_MAX_JAMB_GAP = 0.4
"""Largest gap between a jamb and a wall that is closed by an assumed stretch of wall, metres."""


def plan_of_scene(scene: Scene, name: str, source: str = "") -> FloorPlan:
    """A floor plan of the walls and open doors of a scene, such as that of a `LineMap`.

    Walls are cut where a door opens. A jamb without a wall, for example where a wall's end was
    never seen, is joined to the wall beside it. Doors that then still break a rule of floor plans
    (no wall near a jamb, less than half a metre clear) are left out. Rooms and corridors have no
    names in a map of lines, so the plan has none.

    Args:
        scene: the scene in the frame of the plan, metres.
        name: name of the plan.
        source: origin of the plan, in words.

    Raises:
        FloorPlanError: the scene has no walls.
    """
    if not len(scene.walls):
        raise FloorPlanError("the map holds no wall; map more scans")
    doors = sorted(scene.doors, key=lambda door: -door.confidence)
    openings = [_opening(door) for door in doors]
    walls = _cut([LineString((wall.start, wall.end)) for wall in scene.walls], openings)
    stubs = {door: _stubs(door, walls) for door in doors}
    hung = [door for door in doors if stubs[door] is not None]
    surfaces = [Surface(_points(wall)) for wall in walls]
    surfaces += [
        Surface(_points(stub), assumed=True) for door in hung for stub in stubs[door] or ()
    ]
    plan_doors = [PlanDoor(f"door_{k}", door.start, door.end) for k, door in enumerate(hung, 1)]
    plan = _plan(name, surfaces, plan_doors, source)
    return _plan(name, surfaces, [door for door in plan_doors if _is_open(door, plan)], source)


def _plan(
    name: str, surfaces: Sequence[Surface], doors: Sequence[PlanDoor], source: str
) -> FloorPlan:
    solid = shapely.multilinestrings([LineString(surface.points) for surface in surfaces])
    boundary: Polygon = shapely.box(*solid.buffer(_BOUNDARY_MARGIN).bounds)
    return FloorPlan(name, tuple(surfaces), tuple(doors), (), (), (), boundary, source)


def _opening(door: Door) -> BaseGeometry:
    """The strip along a door's chord that must be free for the door to be open."""
    return LineString((door.start, door.end)).buffer(DRAWING_TOLERANCE, cap_style="flat")


def _cut(walls: Sequence[LineString], openings: Sequence[BaseGeometry]) -> list[LineString]:
    """The walls without what lies in the openings."""
    tree = STRtree(list(openings))
    pieces: list[LineString] = []
    for wall in walls:
        near = [openings[k] for k in tree.query(wall)]
        rest = wall.difference(shapely.union_all(near)) if near else wall
        pieces += [part for part in shapely.get_parts(rest) if part.length > _LEAST_REMNANT]
    return pieces


def _stubs(door: Door, walls: Sequence[LineString]) -> list[LineString] | None:
    """The stretches that join the jambs to the walls beside them; None without such walls."""
    solid = shapely.multilinestrings(list(walls))
    stubs: list[LineString] = []
    for jamb in (door.start, door.end):
        stub = shapely.shortest_line(Point(jamb), solid)
        if not stub.length <= _MAX_JAMB_GAP:
            return None
        if stub.length > DRAWING_TOLERANCE / 2:
            stubs.append(stub)
    return stubs


def _is_open(door: PlanDoor, plan: FloorPlan) -> bool:
    open_wide = clear_width(door, plan) >= NARROWEST_ROBOT
    return open_wide and door_state(door, plan) is not DoorState.CLOSED


def _points(line: LineString) -> tuple[tuple[float, float], ...]:
    return tuple((round(x, 4), round(y, 4)) for x, y in line.coords)
