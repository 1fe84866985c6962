"""The clear width of a doorway, from the leaves that hang in it."""

from __future__ import annotations

import math
from enum import StrEnum

import shapely
from shapely import LineString, Point

from semnav_env.world.maps.floor_plan import FloorPlan, Material, PlanDoor, Surface
from semnav_features.frames import heading_between, wrap_angle

DRAWING_TOLERANCE = 0.05
"""Distance within which two drawn things touch, metres: the accuracy of drawn and measured
plans."""

NARROWEST_ROBOT = 0.5
"""Width of the narrowest robot, SPOT, metres; every open door leaves at least this much clear."""

WIDE_DOOR = 2.0
"""Width that all doors of a plan must exceed for a note that its unit may not be metres."""

HALF_OPEN_ANGLE = math.radians(75.0)
"""Angle between a leaf and its opening below which the leaf narrows the way through, radians."""


class DoorState(StrEnum):
    """Values of the `state` of a door in a floor plan file."""

    OPEN = "open"
    HALF_OPEN = "half-open"
    CLOSED = "closed"


def door_state(door: PlanDoor, plan: FloorPlan) -> DoorState:
    """The state of a door as drawn: closed if something solid fills it, half open by its leaf."""
    near = _near(door, plan)
    if _uncovered(door, near) < DRAWING_TOLERANCE:
        return DoorState.CLOSED
    ways = ((door.start, door.end), (door.end, door.start))
    angles = [_angle(jamb, other, leaf) for jamb, other in ways for leaf in _hung(jamb, near)]
    return DoorState.HALF_OPEN if min(angles, default=math.pi) < HALF_OPEN_ANGLE else DoorState.OPEN


def clear_width(door: PlanDoor, plan: FloorPlan) -> float:
    """Clear width of a door between its jambs and the leaves that hang on them, metres.

    A leaf as wide as the door, at an angle a < 90 degrees to it, leaves width * sin(a).
    """
    near = _near(door, plan)
    a, b = (shapely.union_all([Point(j), *_hung(j, near)]) for j in (door.start, door.end))
    return min(float(a.distance(b)), _uncovered(door, near))


def _near(door: PlanDoor, plan: FloorPlan) -> list[Surface]:
    """The surfaces that touch the opening."""
    rows = plan.solids.query(LineString((door.start, door.end)), "dwithin", DRAWING_TOLERANCE)
    return [plan.surfaces[i] for i in sorted(set(plan.owners[rows].tolist()))]


def _uncovered(door: PlanDoor, near: list[Surface]) -> float:
    """Longest part of the opening that no surface lies on or crosses, metres."""
    opening = LineString((door.start, door.end))
    solid = shapely.union_all([LineString(surface.points) for surface in near])
    free = opening.difference(solid.buffer(DRAWING_TOLERANCE / 2, cap_style="flat"))
    return max((float(part.length) for part in shapely.get_parts(free)), default=0.0)


def _hung(jamb: tuple[float, float], near: list[Surface]) -> list[LineString]:
    """The leaves that start at the jamb, each directed away from it."""
    leaves = [surface.points for surface in near if surface.material is Material.LEAF]
    directed = [points for leaf in leaves for points in (leaf, leaf[::-1])]
    return [
        LineString(points) for points in directed if math.dist(points[0], jamb) < DRAWING_TOLERANCE
    ]


def _angle(jamb: tuple[float, float], other: tuple[float, float], leaf: LineString) -> float:
    """Angle in [0, pi] at a jamb from the other jamb to the tip of a leaf."""
    tip = leaf.coords[-1]
    return abs(wrap_angle(heading_between(jamb, other) - heading_between(jamb, tip)))
