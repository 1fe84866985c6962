"""Doors in the outline of a room that are drawn as points: the edges of walls and of doors."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from semnav_env.world.maps.importers.door_faces import LEAST_DOOR_WIDTH, MAX_FACE_ANGLE
from semnav_env.world.maps.importers.traced_rooms import Edge
from semnav_env.world.maps.rules import LEAST_SEGMENT_LENGTH
from semnav_features.frames import Point, heading_between, wrap_angle

STRAIGHT = 0.005
"""Distance from the line between its neighbours within which a corner is none, metres."""


@dataclass(frozen=True)
class RingPoint:
    """A corner of an outline, or the middle of a door in it.

    Attributes:
        place: (x, y) in metres.
        width: of the door, metres; 0 if there is none.
    """

    place: Point
    width: float = 0.0


def edges_of(ring: Sequence[RingPoint]) -> Iterator[Edge]:
    """The edges around a room: each door is an edge as wide as it is, the walls lie between.

    A door lies on both sides of its point. At a corner of the room it lies on the longer one. It
    ends where the wall ends, or half way to another door.

    Args:
        ring: the outline, in order; the last point is followed by the first.
    """
    ring = _without_straight_corners(ring)
    spans = [_span(ring, k) for k in range(len(ring))]
    for k, (first, last) in enumerate(spans):
        width = math.dist(first, last)
        if width >= LEAST_SEGMENT_LENGTH:
            yield Edge(first, last, width >= LEAST_DOOR_WIDTH)
        following = spans[(k + 1) % len(spans)][0]
        if math.dist(last, following) >= LEAST_SEGMENT_LENGTH:
            yield Edge(last, following, False)


def _without_straight_corners(ring: Sequence[RingPoint]) -> list[RingPoint]:
    """The ring without the corners at which only the walls of other rooms meet it."""
    kept = list(ring)
    k = 0
    while k < len(kept) and len(kept) > 3:
        if not kept[k].width and _off_line(kept, k) < STRAIGHT:
            del kept[k]
        else:
            k += 1
    return kept


def _span(ring: Sequence[RingPoint], k: int) -> tuple[Point, Point]:
    """Where the door of a point begins and ends; twice the point itself without a door."""
    here, before, after = ring[k], ring[k - 1], ring[(k + 1) % len(ring)]
    sides = _room_towards(here, before), _room_towards(here, after)
    if abs(_turn_at(ring, k)) <= MAX_FACE_ANGLE:
        back, on = (min(here.width / 2.0, room) for room in sides)
    else:
        back, on = (min(here.width, room) * (room == max(sides)) for room in sides)
    return _moved(here.place, before.place, back), _moved(here.place, after.place, on)


def _room_towards(here: RingPoint, there: RingPoint) -> float:
    """How far the door of a point may reach towards another one, metres."""
    return math.dist(here.place, there.place) * (0.5 if there.width else 1.0)


def _off_line(ring: Sequence[RingPoint], k: int) -> float:
    """Distance of a corner from the line between its neighbours, metres."""
    before, here, after = (np.array(ring[j % len(ring)].place) for j in (k - 1, k, k + 1))
    along, aside = after - before, here - before
    length = max(float(np.hypot(*along)), 1e-9)
    return abs(float(along[0] * aside[1] - along[1] * aside[0])) / length


def _turn_at(ring: Sequence[RingPoint], k: int) -> float:
    before, here, after = (ring[j % len(ring)].place for j in (k - 1, k, k + 1))
    return wrap_angle(heading_between(here, after) - heading_between(before, here))


def _moved(place: Point, towards: Point, distance: float) -> Point:
    """A place, moved towards another one."""
    step = np.subtract(towards, place)
    x, y = (place + step * (distance / max(float(np.hypot(*step)), 1e-9))).tolist()
    return x, y
