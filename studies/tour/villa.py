"""A villa of ten rooms about an angled hall, and a way through all of them.

Drawn for this study in the manner of the villa of Mes 2021, of whose rooms her thesis shows the
hall alone: doors of 0.90 m, rooms behind rooms, two doors side by side.
"""

from __future__ import annotations

import math
from functools import cache
from itertools import pairwise

import numpy as np
import shapely
from shapely import LineString, Polygon, box

from semnav_env.world.maps import FloorPlan, Material, PlanDoor, Region, Surface
from semnav_env.world.maps.geodesic import Geodesic
from semnav_features.frames import FloatArray, Point, Pose

HALLS = {"hall": (0.0, 5.0, 12.0, 7.0), "entrance": (5.0, 0.0, 7.0, 5.0)}
ROOMS = {
    "kitchen": (0.0, 0.0, 5.0, 5.0),
    "pantry": (-4.0, 0.0, 0.0, 4.2),
    "guest": (-4.0, 4.2, 0.0, 8.0),
    "parents": (0.0, 7.0, 4.2, 11.5),
    "bath": (4.2, 7.0, 7.4, 11.0),
    "daughter": (7.4, 7.0, 12.0, 11.5),
    "dining": (12.0, 4.0, 16.5, 8.0),
    "son": (12.0, 8.0, 16.5, 11.8),
    "garden": (12.0, 0.0, 16.5, 4.0),
    "living": (7.0, 0.0, 12.0, 5.0),
}
"""West, south, east and north of each, metres."""

DOORS = {
    "kitchen": ((5.0, 2.4), (5.0, 3.3)),
    "pantry": ((0.0, 1.6), (0.0, 2.5)),
    "guest": ((0.0, 5.6), (0.0, 6.5)),
    "parents": ((2.6, 7.0), (3.5, 7.0)),
    "bath": ((4.7, 7.0), (5.6, 7.0)),
    "daughter": ((9.0, 7.0), (9.9, 7.0)),
    "dining": ((12.0, 5.4), (12.0, 6.3)),
    "son": ((13.8, 8.0), (14.7, 8.0)),
    "garden": ((13.2, 4.0), (14.1, 4.0)),
    "veranda": ((12.0, 1.8), (12.0, 2.7)),
    "living": ((7.0, 1.2), (7.0, 2.1)),
}

LEAVES = (
    ((5.0, 2.4), (4.1, 2.4)),
    ((2.6, 7.0), (2.6, 7.9)),
    ((5.6, 7.0), (5.6, 7.9)),
    ((13.8, 8.0), (13.8, 8.9)),
)
"""Open leaves of doors: of the kitchen, the parents, the bath and the son."""

FURNITURE = (
    (0.1, 4.3, 3.5, 4.9),
    (-3.9, 0.1, -3.5, 4.0),
    (-3.9, 4.3, -2.0, 5.2),
    (0.1, 9.4, 2.1, 11.4),
    (6.6, 8.5, 7.3, 10.5),
    (7.5, 9.0, 8.0, 11.0),
    (10.6, 10.6, 11.9, 11.4),
    (15.2, 5.0, 16.2, 7.0),
    (15.4, 9.6, 16.4, 11.6),
    (15.6, 0.2, 16.3, 0.9),
    (8.2, 3.9, 10.6, 4.8),
    (10.2, 6.6, 11.2, 6.95),
)

START: Pose = (6.0, 0.8, 0.5 * math.pi)
"""Where the tour begins; it ends there, too."""

STOPS: tuple[tuple[tuple[str, ...], Point], ...] = (
    (("kitchen",), (2.5, 2.4)),
    (("pantry",), (-2.0, 2.1)),
    (("pantry", "kitchen", "guest"), (-1.9, 6.5)),
    (("guest", "parents"), (2.8, 8.8)),
    (("parents", "bath"), (5.4, 9.0)),
    (("bath", "daughter"), (9.6, 9.0)),
    (("daughter", "dining"), (14.0, 6.0)),
    (("son",), (14.2, 9.9)),
    (("son", "garden"), (14.0, 2.0)),
    (("veranda",), (9.6, 2.3)),
    (("living",), START[:2]),
)
"""Places where the tour goes to, and the doors that lead there."""

BESIDE_DOOR = 0.9
"""How far before and behind a door the way is square to it, metres."""

SPACING = 0.05
"""Distance between the points of the way, metres."""


@cache
def villa() -> FloorPlan:
    """The floor plan; its walls have no thickness, the frames of its doors have."""
    rooms, halls = ({n: box(*sides) for n, sides in each.items()} for each in (ROOMS, HALLS))
    outlines = [*(room.exterior for room in rooms.values()), _union(halls).exterior]
    openings = shapely.union_all([LineString(ends) for ends in DOORS.values()])
    walls = shapely.line_merge(shapely.union_all(outlines).difference(openings))
    surfaces = (
        *(Surface(_points(wall)) for wall in shapely.get_parts(walls)),
        *(Surface(leaf, Material.LEAF) for leaf in LEAVES),
        *(Surface(_points(box(*piece).exterior), Material.FURNITURE) for piece in FURNITURE),
    )
    return FloorPlan(
        name="villa",
        surfaces=surfaces,
        doors=tuple(PlanDoor(name, *ends) for name, ends in DOORS.items()),
        rooms=tuple(Region(name, room) for name, room in rooms.items()),
        corridors=tuple(Region(name, hall) for name, hall in halls.items()),
        intersections=(),
        boundary=_union(rooms | halls),
        source="drawn for the study of a tour with drift",
    )


def _union(parts: dict[str, Polygon]) -> Polygon:
    whole = shapely.union_all(list(parts.values()))
    assert isinstance(whole, Polygon)
    return whole


def _points(line: LineString) -> tuple[Point, ...]:
    return tuple((x, y) for x, y in shapely.get_coordinates(line).tolist())


@cache
def tour_way() -> FloatArray:
    """Points of the way through all rooms, `SPACING` apart, world frame, shape (n, 2)."""
    corners: list[Point] = [START[:2]]
    for doors, place in STOPS:
        for name in doors:
            corners += _through(villa().door(name), corners[-1])
        corners.append(place)
    geodesic = Geodesic(villa(), comfort=0.8, clearance=0.35)
    legs = [geodesic.to(b).way(a)[1:] for a, b in pairwise(corners)]
    line = LineString(np.vstack((corners[0], *legs)))
    return np.asarray(shapely.get_coordinates(line.segmentize(SPACING)), dtype=np.float64)


def _through(door: PlanDoor, before: Point) -> tuple[Point, Point]:
    """Places before and behind a door that is come to from a place."""
    (x1, y1), (x2, y2), (x, y) = door.start, door.end, door.midpoint
    across = BESIDE_DOOR * np.array([y1 - y2, x2 - x1]) / door.width
    if across @ (before[0] - x, before[1] - y) > 0.0:
        across = -across
    dx, dy = across.tolist()
    return (x - dx, y - dy), (x + dx, y + dy)


def room_at(place: Point) -> str:
    """The name of the room in which a place lies; "" in the hall."""
    x, y = place
    inside = (n for n, (w, s, e, north) in ROOMS.items() if w <= x <= e and s <= y <= north)
    return next(inside, "")
