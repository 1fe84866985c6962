"""The shortest way into a room of a floor plan, along the middle of the corridors."""

from __future__ import annotations

import math

import numpy as np
import shapely

from semnav_env.language.clauses import Clause
from semnav_env.language.told import Told
from semnav_env.mind.grounding.errors import GroundingError
from semnav_env.mind.grounding.ways import Way, paced
from semnav_env.world.maps.floor_plan import FloorPlan, PlanDoor, Region
from semnav_env.world.maps.geodesic import Geodesic
from semnav_features.frames import FloatArray, Point, Pose, wrap_angle

SIDE_OFFSET = 0.5
"""Distance from a door's middle to the places on its two sides that tell which rooms it joins,
metres: beyond the thickness of any wall."""

OUTLINE_TOLERANCE = 0.3
"""Largest distance of a place from a room's outline at which it counts as in the room, metres:
outlines run along walls of some thickness."""

DOORWAY_RADIUS = 0.1
"""A robot this near to the middle of a door stands in the doorway, metres."""

MAX_SIDE_ROOM = 1.5
"""Walls farther to the side than this do not pull a way towards the middle, metres: corridors are
narrower than twice this, halls are not."""

SHUT = (': the doors of "{room}" are shut', ': the door of "{room}" is shut')
"""What is told of a room whose doors, or whose only door, are shut."""


def way_into(plan: FloorPlan, geodesic: Geodesic, room: Region, pose: Pose, named: Clause) -> Way:
    """The shortest way into a room, through the nearest of its open doors, if it has any.

    Args:
        plan: floor plan of the building.
        geodesic: its shortest ways.
        room: the room.
        pose: start pose, world frame.
        named: the clause that names the room, for the message.

    Raises:
        GroundingError: no open door leads there.
    """
    begin = pose[:2]
    doors = [(door, *_inward(door, room)) for door in plan.doors if door.open]
    entries = [(door, heading) for door, leads, heading in doors if leads]
    if room.polygon.contains(shapely.Point(begin)) or _has_come_in(pose, entries):
        return Way((begin, begin), heading=pose[2])
    inside = room.polygon.representative_point()
    ends: list[Point] = [door.midpoint for door, _ in entries] or [(inside.x, inside.y)]
    lengths = [geodesic.to(end).length(begin) for end in ends]
    best = min(range(len(ends)), key=lambda k: lengths[k])
    way = geodesic.to(ends[best]).way(begin)
    if math.isinf(lengths[best]) or not (entries or _is_at(room, way[-2])):
        raise GroundingError(_no_open_door(named, room, plan))
    if not entries:
        (ax, ay), (bx, by) = way[-3:-1].tolist()
        return Way(_centred(plan, way[:-1]), heading=math.atan2(by - ay, bx - ax))
    door, heading = entries[best]
    return Way(_centred(plan, way), door.as_door(), heading)


def _no_open_door(named: Clause, room: Region, plan: FloorPlan) -> Told:
    """What is told of a room to which no way leads: also that its own doors are shut, if so."""
    own = [door for door in plan.doors if _inward(door, room)[0]]
    shut = "" if not own or any(door.open for door in own) else SHUT[len(own) == 1]
    return Told(f"{{what}}: no open door leads there{shut}", what=named, room=room.name)


def _centred(plan: FloorPlan, way: FloatArray) -> tuple[Point, ...]:
    """Places along a way, each moved to the middle between the walls to its left and right.

    The way still leads through each door between two corridors through which it led: where it would
    pass beside one, the nearest place is moved into the doorway. Doors of rooms on the way are left
    out: with them the seeds of the frozen episodes would draw others.
    """
    places = np.array(paced(way))
    if len(places) < 3:
        return tuple(zip(*places.T.tolist(), strict=True))
    ahead = np.gradient(places, axis=0)
    across = np.column_stack((-ahead[:, 1], ahead[:, 0]))
    across /= np.hypot(*across.T)[:, None]
    doors = [door for door in plan.doors if door.open]
    lines = np.reshape([(*door.start, *door.end) for door in doors], (-1, 4))
    sides = np.vstack((plan.segments, lines))
    left, right = (_side_room(sides, places, sign * across) for sign in (1.0, -1.0))
    inner = np.s_[1:-1]
    places[inner] += 0.5 * (left - right)[inner, None] * across[inner]
    gates = shapely.linestrings(lines.reshape(-1, 2, 2))
    leads_through = shapely.intersects(gates, shapely.LineString(way))
    passes_beside = leads_through & ~shapely.intersects(gates, shapely.LineString(places))
    for k in np.flatnonzero(passes_beside).tolist():
        if _parts_corridors(plan, gates[k]):
            nearest = np.hypot(*(places[inner] - doors[k].midpoint).T).argmin()
            places[1 + int(nearest)] = doors[k].midpoint
    return tuple(zip(*places.T.tolist(), strict=True))


def _parts_corridors(plan: FloorPlan, gate: shapely.LineString) -> bool:
    """Whether a door lies between two corridors."""
    halls = [hall.polygon for hall in (*plan.corridors, *plan.intersections)]
    near = [hall for hall in halls if hall.distance(gate.centroid) < OUTLINE_TOLERANCE]
    return len(near) > 1


def _is_at(room: Region, point: Point) -> bool:
    return bool(room.polygon.distance(shapely.Point(point)) < OUTLINE_TOLERANCE)


def _side_room(segments: FloatArray, places: FloatArray, directions: FloatArray) -> FloatArray:
    """Free distance from each place in its direction, at most `MAX_SIDE_ROOM`, metres."""
    start, run = segments[:, :2], segments[:, 2:] - segments[:, :2]
    free = np.full(len(places), MAX_SIDE_ROOM)
    for k, (place, (dx, dy)) in enumerate(zip(places, directions, strict=True)):
        x, y = (start - place).T
        across = dx * run[:, 1] - dy * run[:, 0]
        with np.errstate(divide="ignore", invalid="ignore"):
            reach, share = (x * run[:, 1] - y * run[:, 0]) / across, (x * dy - y * dx) / across
        met = reach[(reach > 0.0) & (share >= 0.0) & (share <= 1.0)]
        free[k] = min(MAX_SIDE_ROOM, met.min(initial=MAX_SIDE_ROOM))
    return free


def _has_come_in(pose: Pose, entries: list[tuple[PlanDoor, float]]) -> bool:
    """Whether a robot stands in a doorway and faces inward, as after a clause through this door."""
    return any(
        math.dist(pose[:2], door.midpoint) < DOORWAY_RADIUS and math.cos(heading - pose[2]) > 0.0
        for door, heading in entries
    )


def _inward(door: PlanDoor, room: Region) -> tuple[bool, float]:
    """Whether a door leads into a room, and the heading that leads in."""
    (ax, ay), (bx, by) = door.start, door.end
    heading = math.atan2(by - ay, bx - ax) + math.pi / 2
    x, y = door.midpoint
    dx, dy = SIDE_OFFSET * math.cos(heading), SIDE_OFFSET * math.sin(heading)
    left = room.polygon.distance(shapely.Point(x + dx, y + dy))
    right = room.polygon.distance(shapely.Point(x - dx, y - dy))
    leads = min(left, right) < OUTLINE_TOLERANCE and abs(left - right) > SIDE_OFFSET / 2
    return leads, wrap_angle(heading if left < right else heading + math.pi)
