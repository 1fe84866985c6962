"""Scenes over time joined into one, so that a door that has left the view still counts."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from semnav_env.features.frames import FloatArray, Pose
from semnav_env.features.kernels.memory import (
    REMEMBERED,
    how_many_count,
    remember,
    what_counts,
)
from semnav_env.features.scene import Door, PlainWalls, Scene

MAX_WALLS, MAX_DOORS = 512, 64
"""When so many are remembered, a new one replaces the one that was seen least."""


class SceneMemory:
    """What was seen so far, in one fixed frame (the odometry frame).

    A wall counts from its second sighting. A door counts from its third, while no more than a
    third of the scans contradict it, that is, found its opening filled; of two doors in one place,
    only the one that was seen more often.
    """

    def __init__(self) -> None:
        self._walls = np.zeros(MAX_WALLS, dtype=REMEMBERED)
        self._doors = np.zeros(MAX_DOORS, dtype=REMEMBERED)
        self._used = np.zeros(2, dtype=np.int64)

    @property
    def arrays(self) -> tuple[NDArray[np.void], NDArray[np.void], NDArray[np.int64]]:
        """(walls, doors, used), for a kernel that updates them in place."""
        return self._walls, self._doors, self._used

    def clear(self) -> None:
        """Forget everything."""
        self._used[:] = 0

    def update(
        self,
        walls: NDArray[np.void],
        doors: NDArray[np.void],
        counts: NDArray[np.int64],
        ranges: FloatArray,
        angles: tuple[float, float],
        lidar_pose: Pose,
    ) -> None:
        """Add one scan's walls and doors.

        Args:
            walls: `layout.WALL` array, lidar frame.
            doors: `layout.DOOR` array, lidar frame.
            counts: entries used, by kind.
            ranges: of the scan, metres.
            angles: angle_min and angle_increment of the scan, radians.
            lidar_pose: of the lidar in the memory's frame.
        """
        remember(walls, doors, counts, ranges, *angles, lidar_pose, self.arrays)

    @property
    def size(self) -> tuple[int, int]:
        """How many walls and doors count."""
        return how_many_count(*self.arrays)

    def scene(self) -> Scene:
        """The walls and doors that count, in the memory's frame, in the order first seen."""
        walls, doors = what_counts(*self.arrays)
        counting = [
            Door((x1, y1), (x2, y2), sightings=int(hits)) for x1, y1, x2, y2, hits in doors.tolist()
        ]
        return Scene(PlainWalls(walls), tuple(counting))
