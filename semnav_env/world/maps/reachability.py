"""Parts of a plan that a robot cannot reach: open doors, rooms behind them, ends of corridors."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import cast

import numpy as np
import shapely
from shapely import LineString, Point, Polygon
from shapely.geometry.base import BaseGeometry

from semnav_env.robots import RobotSpec
from semnav_env.world.grid.costs import costs_from
from semnav_env.world.grid.poses import Reach
from semnav_env.world.maps.doorways import DRAWING_TOLERANCE, clear_width
from semnav_env.world.maps.floor_plan import FloorPlan, Material, PlanDoor, Region
from semnav_env.world.maps.geodesic import GRID_SPACING
from semnav_env.world.maps.plan_fault import PlanFault, point_in, written
from semnav_env.world.maps.reach import HEADING_COUNT, REACH_SPACING, reach
from semnav_env.world.maps.rules import FloorPlanError
from semnav_features.frames import middle_of

SEARCH_GRIDS = ((REACH_SPACING, HEADING_COUNT), (REACH_SPACING / 2, 2 * HEADING_COUNT))
"""Spacing, metres, and number of headings of each search; the finer one is for what the first one
misses."""

END_DISTANCE = 1.0
"""Distance from the end of a corridor to the place that must be reachable, metres, as a robot that
drives "to the end" stops before the wall."""

BEND_CLEARANCE = 0.5
"""Distance of the ends of a bent corridor from its walls, metres: narrower ones hold no body."""

MAX_END_CELLS = 250_000
"""Largest number of cells of the grid on which the ends of a bent corridor are found; a larger one
gets coarser cells."""

END_TOLERANCE = 0.6
"""Distance at which that place counts as reached, metres."""


def unreachable_parts(plan: FloorPlan, robot: RobotSpec) -> list[PlanFault]:
    """Doors, rooms and corridors that a robot cannot reach from the middle of the largest corridor.

    An open door is reached when the robot's centre gets onto its line; a room with an open door,
    when the whole robot gets in, though it may have to back out; a corridor, when its centre gets
    near both ends. What lies behind closed doors need not be reachable, and of a room behind an
    open door that is not reached only the door is named. A plan that is too large to be searched
    gets one fault that says so.
    """
    faults: list[PlanFault] = []
    for spacing, headings in SEARCH_GRIDS:
        try:
            area = reach(plan, robot.length, robot.width, spacing, headings)
        except FloorPlanError as error:
            return [PlanFault(plan.name, str(error).removeprefix(f"{plan.name} "))]
        faults = list(_unreached(plan, robot, area))
        if not faults:
            break
    return faults


def _unreached(plan: FloorPlan, robot: RobotSpec, area: Reach) -> Iterator[PlanFault]:
    body = f"a {robot.name} ({robot.length} m x {robot.width} m)"
    if not area.cells.any():
        yield PlanFault(plan.name, f"{body} cannot stand in the middle of the largest corridor")
        return
    for door in plan.doors:
        if door.open and not area.near(_line(door)):
            yield PlanFault(door.name, _of_door(door, plan, robot, body), door.midpoint)
    for room in plan.rooms:
        opens = [
            d
            for d in plan.doors
            if d.open and room.polygon.dwithin(_line(d).centroid, DRAWING_TOLERANCE)
        ]
        passed = any(area.near(_line(door)) for door in opens)
        if passed and not area.near(_inside(room, opens, robot)):
            yield PlanFault(room.name, f"{body} cannot get into this room", point_in(room.polygon))
    for corridor in plan.corridors:
        for end in _ends(corridor.polygon):
            if not area.near(end, END_TOLERANCE):
                problem = f"{body} cannot get to this end of the corridor"
                yield PlanFault(corridor.name, problem, point_in(end))


def _of_door(door: PlanDoor, plan: FloorPlan, robot: RobotSpec, body: str) -> str:
    clear = clear_width(door, plan)
    if clear < robot.width:
        return f"this open door leaves {clear:.2f} m; {body} needs more"
    return f"{body} cannot get through this open door{_furniture_before(door, plan, robot)}"


def _furniture_before(door: PlanDoor, plan: FloorPlan, robot: RobotSpec) -> str:
    """The nearest furniture within a body's length of a door, in words; empty without any."""
    pieces = (s.points for s in plan.surfaces if s.material is Material.FURNITURE)
    near = min(map(LineString, pieces), key=_line(door).distance, default=None)
    if near is None or (gap := near.distance(_line(door))) > robot.length:
        return ""
    at = shapely.get_point(shapely.shortest_line(_line(door), near), 1)
    return f"; furniture at {written((at.x, at.y))} stands {gap:.2f} m from it"


def _inside(room: Region, doors: list[PlanDoor], robot: RobotSpec) -> BaseGeometry:
    """Where the centre of a robot can be once the whole robot is in a room."""
    steps = shapely.union_all([_line(door) for door in doors]).buffer(robot.length / 2)
    return room.polygon.buffer(-robot.width / 2).difference(steps)


def _line(door: PlanDoor) -> LineString:
    return LineString((door.start, door.end))


def _ends(corridor: Polygon) -> Sequence[BaseGeometry]:
    """Places on the axis of a corridor before its two ends; its middle if it is short.

    The axis of a bent corridor, such as an L or a U, leaves it: its ends are the two places that
    are farthest apart on the way inside it.
    """
    rectangle = cast(Polygon, corridor.minimum_rotated_rectangle)
    corners = list(rectangle.exterior.coords)[:4]
    if math.dist(corners[0], corners[1]) > math.dist(corners[1], corners[2]):
        corners = [*corners[1:], corners[0]]
    axis = LineString((middle_of(*corners[:2]), middle_of(*corners[2:])))
    ends = [axis.interpolate(END_DISTANCE), axis.interpolate(-END_DISTANCE)]
    if axis.length < 2 * END_DISTANCE:
        ends = [axis.centroid]
    return ends if all(map(corridor.covers, ends)) else _farthest_apart(corridor)


def _farthest_apart(corridor: Polygon) -> Sequence[BaseGeometry]:
    """The two places with the longest way between them inside a corridor, away from its walls.

    The ends of a U are those of its legs, however near to each other they are. One is the place
    farthest from any first one, the other that farthest from there. Any place if the corridor is
    too narrow.
    """
    west, south, east, north = corridor.bounds
    spacing = max(GRID_SPACING, math.sqrt((east - west) * (north - south) / MAX_END_CELLS))
    x, y = np.meshgrid(np.arange(west, east, spacing), np.arange(south, north, spacing))
    roomy = np.asarray(shapely.contains_xy(corridor.buffer(-BEND_CLEARANCE), x, y))
    if not roomy.any():
        return [corridor.representative_point()]
    weight = np.where(shapely.contains_xy(corridor, x, y), 1.0, np.inf)
    cell, ends = tuple(np.argwhere(roomy)[0]), []
    for _ in range(2):
        ways = costs_from(cell, weight, spacing)
        ways[~roomy | ~np.isfinite(ways)] = -1.0
        cell = np.unravel_index(ways.argmax(), ways.shape)
        ends.append(Point(x[cell], y[cell]))
    return ends
