"""Puts a door into a floor plan: into a gap of the walls, or into a wall that is cut open."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import shapely
from shapely import LineString, Polygon

from semnav_env.world.maps.doorways import NARROWEST_ROBOT
from semnav_env.world.maps.floor_plan import FloorPlan, PlanDoor, Surface
from semnav_env.world.maps.importers.building_doors import corridor_to_the_left
from semnav_env.world.maps.importers.fitting import DOORWAY_HALF_DEPTH, Fit, fit_door
from semnav_env.world.maps.importers.labels import DoorLabel
from semnav_env.world.maps.rules import LEAST_SEGMENT_LENGTH, FloorPlanError, check_plan
from semnav_features.frames import Point


def with_door(plan: FloorPlan, start: Point, end: Point, name: str = "") -> FloorPlan:
    """The plan with an open door along a line from jamb to jamb.

    A gap between walls near the line is taken as it is; its jambs are where the walls end. Without
    a gap the walls are cut open, as where a door was shut while a robot made the map.

    Args:
        plan: the plan.
        start: one jamb, (x, y) in metres, exact to some decimetres.
        end: the other jamb.
        name: of the door; the next free number if empty.

    Raises:
        FloorPlanError: the line is too short, there is no wall on one side of it, or the name is
            taken.
    """
    label = DoorLabel(name or _free_name(plan), start, end)
    if not shapely.LineString((start, end)).length >= NARROWEST_ROBOT:
        raise FloorPlanError(f"a door is at least {NARROWEST_ROBOT} m wide; draw from jamb to jamb")
    fit = fit_door(label, plan.solids)
    if fit is None:
        raise FloorPlanError("there is no wall beside one jamb; draw from jamb to jamb")
    if not fit.open:
        plan, fit = _cut_open(plan, start, end)
    door = corridor_to_the_left(PlanDoor(label.name, fit.start, fit.end), plan)
    wider = replace(plan, doors=(*plan.doors, door))
    check_plan(wider)
    return wider


def _cut_open(plan: FloorPlan, start: Point, end: Point) -> tuple[FloorPlan, Fit]:
    """The plan without the walls between two jambs, with a face at each of them, and the jambs."""
    along = np.subtract(end, start) / np.hypot(*np.subtract(end, start))
    depth = DOORWAY_HALF_DEPTH * np.array((-along[1], along[0]))
    sides = [LineString((jamb - depth, jamb + depth)) for jamb in map(np.array, (start, end))]
    opening = Polygon([*sides[0].coords, *reversed(sides[1].coords)])
    faces = [_face(plan, side) for side in sides]
    kept = [part for surface in plan.surfaces for part in _outside(surface, opening)]
    kept += [Surface(face) for face in faces if len(face) > 1]
    first, last = (_nearest(face, jamb) for face, jamb in zip(faces, (start, end), strict=True))
    return replace(plan, surfaces=tuple(kept)), Fit(first, last, True)


def _face(plan: FloorPlan, side: LineString) -> tuple[Point, ...]:
    """Where a side of the opening meets the walls: the two ends of the jamb, or one point."""
    near = plan.solids.geometries[plan.solids.query(side, "intersects")]
    hits = shapely.get_coordinates(shapely.intersection(near, side))
    if not len(hits):
        raise FloorPlanError("there is no wall to hold one jamb; draw from wall to wall")
    order = np.argsort(shapely.line_locate_point(side, shapely.points(hits)))
    first, last = hits[order[0]], hits[order[-1]]
    ends = (first,) if np.allclose(first, last, atol=0.005) else (first, last)
    return tuple((float(x), float(y)) for x, y in ends)


def _outside(surface: Surface, opening: Polygon) -> Iterator[Surface]:
    """What of a surface an opening leaves."""
    line = LineString(surface.points)
    if not line.intersects(opening):
        yield surface
        return
    for part in shapely.get_parts(shapely.line_merge(line.difference(opening))):
        points = shapely.get_coordinates(shapely.remove_repeated_points(part, LEAST_SEGMENT_LENGTH))
        if len(points) > 1:
            yield replace(surface, points=tuple((float(x), float(y)) for x, y in points))


def _nearest(face: tuple[Point, ...], jamb: Point) -> Point:
    """The point of a face that is nearest to where the jamb was drawn."""
    if len(face) == 1:
        return face[0]
    line = LineString(face)
    point = line.interpolate(line.project(shapely.Point(jamb)))
    return point.x, point.y


def _free_name(plan: FloorPlan) -> str:
    """A name that no door of the plan has, as "door_1"."""
    taken = {door.name for door in plan.doors}
    return next(name for k in range(1, len(taken) + 2) if (name := f"door_{k}") not in taken)
