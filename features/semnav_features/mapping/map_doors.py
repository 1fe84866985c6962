"""The doors of a line map: joins sightings, and decides which doors count."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from semnav_features.elements import Door
from semnav_features.frames import FloatArray, Pose, to_parent
from semnav_features.mapping.map_door import MapDoor
from semnav_features.mapping.map_settings import MapSettings
from semnav_features.scan import Scan

LEAST_WEIGHT = 1e-3
"""Least weight of a sighting, so that a door that was seen from nowhere else has a place."""


class MapDoors:
    """Doors seen over time, in the map's frame.

    Args:
        settings: the map's limits.
    """

    def __init__(self, settings: MapSettings) -> None:
        self._settings = settings
        self._doors: list[MapDoor] = []

    def add(self, doors: Sequence[Door], scan: Scan, pose: Pose) -> None:
        """Add the doors of a scan's scene (lidar frame), and count its beams for the others."""
        reach = self._settings.door_reach
        for door in doors:
            if math.hypot(*door.midpoint) < reach:
                ends = np.array((*to_parent(pose, door.start), *to_parent(pose, door.end)))
                self._see(ends, squareness(door), door.confidence)
        for known in self._doors:
            if math.dist((known.ends[:2] + known.ends[2:]) / 2, pose[:2]) < reach:
                known.passage.observe(scan, pose)

    @property
    def believed(self) -> tuple[Door, ...]:
        """The doors that count, in the order first seen; of two in one place the surer one."""
        kept: list[MapDoor] = []
        for door in sorted(filter(self._counts, self._doors), key=lambda door: -door.belief):
            if all(door.apart(other) > self._settings.door_apart for other in kept):
                kept.append(door)
        return tuple(door.as_door() for door in self._doors if door in kept)

    def _see(self, ends: FloatArray, weight: float, confidence: float) -> None:
        known = self._nearest(ends, self._doors)
        if known is None:
            self._doors.append(MapDoor([ends], [weight], confidence))
            return
        known.see(ends, weight, confidence)
        # Sightings that seemed to be of two doors may have come to agree.
        other = self._nearest(known.ends, [door for door in self._doors if door is not known])
        if other is not None:
            known.absorb(other)
            self._doors.remove(other)

    def _nearest(self, ends: FloatArray, doors: Sequence[MapDoor]) -> MapDoor | None:
        """The door with the nearest jambs, if they are near enough to be the same."""
        apart = [door.distance(ends) for door in doors]
        k = int(np.argmin(apart)) if apart else 0
        return doors[k] if apart and apart[k] < self._settings.door_jamb else None

    def _counts(self, door: MapDoor) -> bool:
        s = self._settings
        return (
            min(len(door.seen), door.passage.looks) >= s.door_sightings
            and door.share >= s.door_share
            and door.passage.openness >= s.door_open
        )


def squareness(door: Door) -> float:
    """Weight of a sighting for the place of a door: the squared cosine of the angle from square.

    The spacing of the hits along the chord grows with one over this cosine, and so does the error
    of the jambs.

    Args:
        door: in the lidar frame.
    """
    x, y = door.midpoint
    along_x, along_y = door.end[0] - door.start[0], door.end[1] - door.start[1]
    across = (along_x * y - along_y * x) / (door.width * max(math.hypot(x, y), 1e-9))
    return max(across * across, LEAST_WEIGHT)
