"""Doors of plans in which each room is traced along its own walls: one door has two faces."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations

import numpy as np
from shapely import LineString, Polygon, STRtree

from semnav_features.frames import Point, heading_between, middle_of, wrap_angle

MAX_WALL_THICKNESS = 1.0
"""Largest distance between the middles of the two faces of a door, metres."""

MAX_FACE_ANGLE = math.radians(25.0)
"""Largest angle between the two faces of a door, radians."""

LEAST_DOOR_WIDTH = 0.55
"""Width of the narrowest opening that is a door, metres: no robot passes a narrower one."""

FACE_SLACK = 0.02
"""Distance from a face within which a wall belongs to the face, metres."""


@dataclass(frozen=True)
class DoorFace:
    """One side of a door: the part of a room's outline that the door takes.

    Attributes:
        room: index of the room.
        start: one end, (x, y) in metres.
        end: the other end.
    """

    room: int
    start: Point
    end: Point

    @property
    def middle(self) -> Point:
        """The point between its ends."""
        return middle_of(self.start, self.end)

    @property
    def width(self) -> float:
        """Distance of its ends, metres."""
        return math.dist(self.start, self.end)

    def point(self, share: float) -> Point:
        """The point at a share of the way from start to end."""
        (x1, y1), (x2, y2) = self.start, self.end
        return x1 + share * (x2 - x1), y1 + share * (y2 - y1)


@dataclass(frozen=True)
class TwoFacedDoor:
    """The way through a wall between the faces of two rooms.

    It is as wide as both faces share. Its reveals stand at a right angle to the first face.

    Attributes:
        one: a face.
        other: the face that is opposite.
    """

    one: DoorFace
    other: DoorFace

    @cached_property
    def corners(self) -> tuple[Point, Point, Point, Point]:
        """Its corners: two on the first face, then the ones on the other face opposite to them.

        The order is one's first, one's second, other's second, other's first: a ring.
        """
        low, high = self._shared
        (a, b), length = self._along_one(self.other), self.one.width
        mine = [self.one.point(place / length) for place in (low, high)]
        theirs = [self.other.point((place - a) / (b - a)) for place in (low, high)]
        return mine[0], mine[1], theirs[1], theirs[0]

    @property
    def width(self) -> float:
        """Width that both faces share, metres; negative if they do not overlap."""
        low, high = self._shared
        return high - low

    @property
    def jambs(self) -> tuple[Point, Point]:
        """The ends of the door's line, half way between the two faces."""
        first, second, third, fourth = self.corners
        return middle_of(first, fourth), middle_of(second, third)

    @property
    def reveals(self) -> Iterator[tuple[Point, Point]]:
        """The walls of the way: its two sides, and what it leaves of wider faces."""
        first, second, third, fourth = self.corners
        yield from ((first, fourth), (second, third))
        yield from ((self.one.start, first), (second, self.one.end))
        ends = sorted((self.other.start, self.other.end), key=lambda end: math.dist(end, fourth))
        yield from ((ends[0], fourth), (third, ends[1]))

    def half(self, of_one: bool) -> Polygon:
        """The floor from the door's line to the first or the other face."""
        first, second, third, fourth = self.corners
        left, right = self.jambs
        ring = (left, right, second, first) if of_one else (left, right, third, fourth)
        return Polygon(ring)

    @cached_property
    def _shared(self) -> tuple[float, float]:
        low, high = sorted(self._along_one(self.other))
        return max(0.0, low), min(self.one.width, high)

    def _along_one(self, face: DoorFace) -> tuple[float, float]:
        """Start and end of a face, measured along the first one, metres."""
        along = np.subtract(self.one.end, self.one.start) / self.one.width
        a, b = (float(np.subtract(p, self.one.start) @ along) for p in (face.start, face.end))
        return a, b


def doorways_between(faces: Sequence[DoorFace], walls: STRtree) -> tuple[TwoFacedDoor, ...]:
    """Pair the faces of doors: the nearest ones first, each face once.

    Two faces belong together if they lie in different rooms, face each other within
    `MAX_WALL_THICKNESS` and `MAX_FACE_ANGLE`, share `LEAST_DOOR_WIDTH`, and no wall runs between
    them.

    Args:
        faces: of all rooms.
        walls: all walls of the rooms, segments, without the faces.
    """
    taken: set[DoorFace] = set()
    found = []
    for doorway in sorted(_candidates(faces), key=_thickness):
        pair = {doorway.one, doorway.other}
        if pair & taken or _is_blocked(doorway, walls):
            continue
        taken |= pair
        found.append(doorway)
    return tuple(found)


def _candidates(faces: Sequence[DoorFace]) -> Iterator[TwoFacedDoor]:
    for one, other in combinations(faces, 2):
        near = math.dist(one.middle, other.middle) <= MAX_WALL_THICKNESS
        if not near or one.room == other.room:
            continue
        angle = wrap_angle(
            2.0 * (heading_between(one.start, one.end) - heading_between(other.start, other.end))
        )
        if abs(angle) <= 2.0 * MAX_FACE_ANGLE:
            doorway = TwoFacedDoor(one, other)
            if doorway.width >= LEAST_DOOR_WIDTH:
                yield doorway


def _thickness(doorway: TwoFacedDoor) -> float:
    return math.dist(doorway.one.middle, doorway.other.middle)


def _is_blocked(doorway: TwoFacedDoor, walls: STRtree) -> bool:
    """Whether a wall crosses the way from face to face."""
    way = LineString([middle_of(*doorway.corners[:2]), middle_of(*doorway.corners[2:])])
    if way.length <= 2.0 * FACE_SLACK:
        return False
    inner = LineString([way.interpolate(FACE_SLACK), way.interpolate(-FACE_SLACK)])
    return len(walls.query(inner, "intersects")) > 0
