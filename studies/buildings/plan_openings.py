"""Openings of a plan that is drawn as bare segments: where the end of a wall faces a wall."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
import shapely

from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_features.frames import FloatArray, Point
from semnav_features.scene import Door
from studies.doors.door_sightings import matches

MAX_WALL_THICKNESS = 0.45
"""Greatest length of the end face of a wall, metres."""

OPENING_WIDTHS = (0.6, 1.8)
"""Narrowest and widest opening, metres."""

MIN_FREE_DEPTH = 0.5
"""Free depth before and behind the middle of an opening, metres."""

MAX_FACE_ANGLE = math.radians(5.0)
"""Greatest angle between two faces that lie opposite each other, radians."""

MIN_FACE_OVERLAP = 0.8
"""Least share of the shorter face that lies opposite the other one."""


def openings_of(plan: FloorPlan) -> tuple[Door, ...]:
    """The openings between the end of a wall and what it faces, world frame.

    A wall with two faces ends in a short face across. Where another face lies opposite, at the
    distance of an opening, with nothing between them and nothing within `MIN_FREE_DEPTH` of it,
    there is an opening; it runs between the middles of the two. Of several within a quarter of a
    metre, as at door frames, the narrowest is kept.
    """
    found: list[Door] = []
    for door in sorted(_openings(plan), key=lambda door: door.width):
        if not any(matches(door, other.start, other.end) for other in found):
            found.append(door)
    return tuple(found)


def _openings(plan: FloorPlan) -> Iterator[Door]:
    faces = plan.opaque_segments
    lengths = np.hypot(*(faces[:, 2:] - faces[:, :2]).T)
    for k in np.flatnonzero(lengths <= MAX_WALL_THICKNESS):
        for start, end in _opposite(faces[k], faces):
            width = math.dist(start, end)
            along = (end[0] - start[0]) / width, (end[1] - start[1]) / width
            middle = (start[0] + end[0]) / 2, (start[1] + end[1]) / 2
            side = -MIN_FREE_DEPTH * along[1], MIN_FREE_DEPTH * along[0]
            across = [(middle[0] + s * side[0], middle[1] + s * side[1]) for s in (-1.0, 1.0)]
            edge = [_between(start, end, share) for share in (0.01 / width, 1.0 - 0.01 / width)]
            if _is_free(plan, edge) and _is_free(plan, across):
                yield Door(start, end)


def _opposite(face: FloatArray, faces: FloatArray) -> Iterator[tuple[Point, Point]]:
    """From the middle of what a face shares with each one opposite, straight to that one."""
    a, b = face[:2], face[2:]
    length = float(np.hypot(*(b - a)))
    along = (b - a) / length
    normal = np.array((-along[1], along[0]))
    ends = faces.reshape(-1, 2, 2) - a
    place, away = np.sort(ends @ along, axis=1), ends @ normal
    distance = away.mean(axis=1)
    tilt = np.abs(np.diff(away, axis=1)[:, 0])
    low, high = np.maximum(place[:, 0], 0.0), np.minimum(place[:, 1], length)
    shorter = np.minimum(np.ptp(place, axis=1), length)
    fits = (np.abs(distance) >= OPENING_WIDTHS[0]) & (np.abs(distance) <= OPENING_WIDTHS[1])
    fits &= (high - low >= MIN_FACE_OVERLAP * shorter) & (shorter > 0.0)
    fits &= tilt <= math.sin(MAX_FACE_ANGLE) * np.hypot(np.ptp(place, axis=1), tilt)
    for k in np.flatnonzero(fits):
        start = a + 0.5 * (low[k] + high[k]) * along
        end = start + distance[k] * normal
        yield (float(start[0]), float(start[1])), (float(end[0]), float(end[1]))


def _between(start: Point, end: Point, share: float) -> Point:
    return (
        start[0] + share * (end[0] - start[0]),
        start[1] + share * (end[1] - start[1]),
    )


def _is_free(plan: FloorPlan, ends: list[Point]) -> bool:
    return not len(plan.solids.query(shapely.LineString(ends), "intersects"))
