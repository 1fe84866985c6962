"""The doors of a line map: sightings joined, and those that the map believes in."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from semnav_env.features.elements import Door
from semnav_env.features.frames import FloatArray, Pose, to_parent
from semnav_env.features.mapping.map_door import MapDoor
from semnav_env.features.mapping.map_settings import MapSettings
from semnav_env.features.scan import Scan


class MapDoors:
    """Doors seen over time, in the map's frame.

    Args:
        settings: the map's limits.
    """

    def __init__(self, settings: MapSettings) -> None:
        self._settings = settings
        self._doors: list[MapDoor] = []

    def add(self, doors: Sequence[Door], scan: Scan, pose: Pose) -> None:
        """Add the doors of a scan's scene (lidar frame), and let its beams speak of the others."""
        reach = self._settings.door_reach
        for door in doors:
            if math.hypot(*door.midpoint) < reach:
                self._see(np.array((*to_parent(pose, door.start), *to_parent(pose, door.end))))
        for known in self._doors:
            if math.dist((known.ends[:2] + known.ends[2:]) / 2, pose[:2]) < reach:
                known.observe(scan, pose)

    @property
    def believed(self) -> tuple[Door, ...]:
        """The doors that count, in the order first seen; of two in one place the one seen more."""
        kept: list[MapDoor] = []
        for door in sorted(filter(self._counts, self._doors), key=lambda door: -len(door.seen)):
            if all(door.apart(other) > self._settings.door_jamb for other in kept):
                kept.append(door)
        return tuple(door.as_door() for door in self._doors if door in kept)

    def _see(self, door: FloatArray) -> None:
        turned = door[[2, 3, 0, 1]]
        best, nearest, sighting = None, self._settings.door_jamb, door
        for known in self._doors:
            for way in (door, turned):
                if (distance := known.distance(way)) < nearest:
                    best, nearest, sighting = known, distance, way
        if best is None:
            self._doors.append(MapDoor([door]))
        else:
            best.see(sighting)

    def _counts(self, door: MapDoor) -> bool:
        s = self._settings
        return (
            min(len(door.seen), door.looks) >= s.door_sightings
            and len(door.seen) >= s.door_share * door.looks
            and door.openness >= s.door_open
        )
