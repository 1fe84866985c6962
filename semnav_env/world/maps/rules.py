"""Rules that every floor plan keeps, whether read, generated or imported."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable

import shapely
from shapely import LineString, Polygon
from shapely.validation import explain_validity

from semnav_env.world.maps.doorways import (
    DRAWING_TOLERANCE,
    NARROWEST_ROBOT,
    WIDE_DOOR,
    DoorState,
    clear_width,
    door_state,
)
from semnav_env.world.maps.floor_plan import FloorPlan, PlanDoor, Region, Surface

MAX_EXTENT = 1000.0
"""Largest absolute value of a coordinate, metres: larger ones are in another unit or frame."""

LEAST_SEGMENT_LENGTH = 0.001
"""Length of the shortest segment, metres; a shorter one has no certain direction."""

LEAST_AREA = DRAWING_TOLERANCE**2
"""Area of the smallest polygon, square metres."""


class FloorPlanError(ValueError):
    """A floor plan cannot be used; one line gives the place, the fault and a correct value."""


def check_plan(plan: FloorPlan) -> None:
    """Refuse a plan that breaks a rule of docs/guides/floor_plans.md.

    Raises:
        FloorPlanError: names the part, what is wrong with it and what would be right.
    """
    check_unit(door.width for door in plan.doors)
    for surface in plan.surfaces:
        check_surface(surface)
    for door in plan.doors:
        check_door(door)
    for region in plan.regions:
        check_region(region)
    check_polygon(plan.boundary, "the boundary")
    check_text(plan.name, "the plan's name")
    _check_encodable(plan.source, "the plan's source")
    check_together(plan)


def check_unit(door_widths: Iterable[float]) -> None:
    """Refuse a plan that is certainly not drawn in metres, by the widths of its doors."""
    widths = list(door_widths)
    if not widths or min(widths) < WIDE_DOOR:
        return
    from semnav_env.world.maps.units import certain_unit_fault  # a plan in metres does without it

    if fault := certain_unit_fault(widths):
        raise FloorPlanError(fault)


def check_surface(surface: Surface) -> None:
    """Refuse a surface with points that are not finite or repeated in a row."""
    what = f"the {surface.material}"
    if len(surface.points) < 2:
        raise FloorPlanError(f"{what} has {len(surface.points)} points; it needs at least two")
    _check_points(surface.points, what)
    for a, b in zip(surface.points, surface.points[1:], strict=False):
        if math.dist(a, b) < LEAST_SEGMENT_LENGTH:
            raise FloorPlanError(f"{what} repeats the point {_at(a)}; leave out one of the two")


def check_door(door: PlanDoor) -> None:
    """Refuse a door without a printable name or without two distinct, finite jambs."""
    check_text(door.name, "the door's name")
    _check_points((door.start, door.end), f"door {door.name!r}")
    if door.width < 2 * DRAWING_TOLERANCE:
        raise FloorPlanError(
            f"door {door.name!r} is {door.width:.2f} m wide; give the two jambs it spans"
        )


def check_region(region: Region) -> None:
    """Refuse a region without a printable name or a valid polygon."""
    check_text(region.name, "the region's name")
    check_polygon(region.polygon, f"region {region.name!r}")


def check_polygon(polygon: Polygon, what: str) -> None:
    """Refuse a polygon that is empty, not finite or crosses itself."""
    if polygon.is_empty:
        raise FloorPlanError(f"{what} is empty; give it a ring of at least four positions")
    for ring in (polygon.exterior, *polygon.interiors):
        _check_points(ring.coords, what)
    if not polygon.is_valid:
        reason = explain_validity(polygon).replace("[", " at (").replace("]", ")")
        raise FloorPlanError(f"{what} is not a simple polygon: {reason}; order its corners anew")
    if polygon.area < LEAST_AREA:
        raise FloorPlanError(f"{what} has no area; give its corners in metres")


def check_text(text: str, what: str) -> None:
    """Refuse a text that is empty, blank at its ends or holds invisible characters."""
    if not text or text != text.strip() or not text.isprintable():
        raise FloorPlanError(f"{what} is {text!r}; use visible characters, no blanks at the ends")


def check_together(plan: FloorPlan) -> None:
    """Check the parts against each other: unique names, doors in walls, all in the boundary."""
    _check_unique((door.name for door in plan.doors), "door")
    _check_unique((region.name for region in plan.regions), "region")
    inside = plan.boundary.buffer(DRAWING_TOLERANCE)
    shapely.prepare(inside)
    for region in plan.regions:
        if not inside.covers(region.polygon):
            raise FloorPlanError(f"region {region.name!r} leaves the boundary; widen the boundary")
    for door in plan.doors:
        if not inside.covers(LineString((door.start, door.end))):
            raise FloorPlanError(f"door {door.name!r} leaves the boundary; widen the boundary")
        check_doorway(door, plan)


def check_doorway(door: PlanDoor, plan: FloorPlan) -> None:
    """Refuse a door without a jamb at either end, or drawn otherwise than it is called."""
    _check_jambs(door, plan)
    _check_state(door, plan)


def _check_jambs(door: PlanDoor, plan: FloorPlan) -> None:
    for jamb in (door.start, door.end):
        if not len(plan.solids.query(shapely.Point(jamb), "dwithin", DRAWING_TOLERANCE)):
            raise FloorPlanError(
                f"door {door.name!r} ends at {_at(jamb)}, where nothing solid is; "
                f"each jamb lies within {DRAWING_TOLERANCE} m of a wall"
            )


def _check_state(door: PlanDoor, plan: FloorPlan) -> None:
    drawn = door_state(door, plan)
    if door.open and drawn is DoorState.CLOSED:
        raise FloorPlanError(
            f"door {door.name!r} is open, but something solid fills its opening; "
            "remove that or call the door closed"
        )
    if not door.open and drawn is not DoorState.CLOSED:
        raise FloorPlanError(
            f"door {door.name!r} is closed, but nothing solid fills its opening; "
            f"draw a leaf from {_at(door.start)} to {_at(door.end)}"
        )
    clear = clear_width(door, plan)
    if door.open and clear < NARROWEST_ROBOT:
        raise FloorPlanError(
            f"door {door.name!r} is open, but leaves only {clear:.2f} m; "
            f"leave {NARROWEST_ROBOT} m or close it"
        )


def _check_unique(names: Iterable[str], what: str) -> None:
    for name, times in Counter(names).items():
        if times > 1:
            raise FloorPlanError(f"{times} {what}s are named {name!r}; {what} names are unique")


def _check_points(points: Iterable[tuple[float, ...]], what: str) -> None:
    for point in points:
        if not all(map(math.isfinite, point)):
            raise FloorPlanError(f"{what} has the point {_at(point)}; coordinates are finite")
        if max(map(abs, point)) > MAX_EXTENT:
            raise FloorPlanError(
                f"{what} has the point {_at(point)}; coordinates are metres, "
                f"at most {MAX_EXTENT:.0f} from the origin"
            )


def _check_encodable(text: str, what: str) -> None:
    try:
        text.encode("utf-8")
    except UnicodeEncodeError:
        raise FloorPlanError(f"{what} holds half a character (a lone surrogate)") from None


def _at(point: tuple[float, ...]) -> str:
    return f"({point[0]:.3f}, {point[1]:.3f})"
