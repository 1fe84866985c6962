"""Joins scenes over time, so that a door that has left the view still counts."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from semnav_features.frames import FloatArray, Pose
from semnav_features.kernels.door_memory import REMEMBERED_DOOR
from semnav_features.kernels.lanes import WIDTH
from semnav_features.kernels.layout import COUNTS_SIZE, DOOR, DOORS, WALL, WALLS
from semnav_features.kernels.memory import (
    COUNTERS,
    MEMORY_STATE,
    how_many_count,
    remember,
    what_counts,
)
from semnav_features.kernels.past_views import PAST_VIEWS
from semnav_features.kernels.remembered import WALL_ROWS
from semnav_features.rules import DoorRules
from semnav_features.scene import PlainWalls, RememberedDoors, Scene, ends_of

if TYPE_CHECKING:
    from semnav_features.scan import Scan

ENDS = ("start_x", "start_y", "end_x", "end_y")

MAX_WALLS, MAX_DOORS = 512, 64
"""Capacity for walls and doors; when it is full, a new one replaces the one with fewest
sightings."""


class SceneMemory:
    """Walls and doors that were seen so far, in one fixed frame, such as the odom frame.

    A wall counts from its second sighting until scans pass through it (`kernels.pass_through`). A
    door counts while its sightings, by their confidence, outweigh the scans that looked at its
    opening and found no door there, or found it filled (`kernels.door_memory`), and while its
    jambs, fused from all sightings, are a door's width apart. Of two doors in one place only the
    likelier one counts. What stands where an earlier view passed, such as a person or the leaf of
    a door, is neither wall nor jamb (`kernels.past_views`).

    Args:
        door_rules: widths of doors.
    """

    def __init__(self, door_rules: DoorRules = DoorRules()) -> None:
        self._walls = np.zeros((WALL_ROWS, MAX_WALLS))
        self._doors = np.zeros(MAX_DOORS, dtype=REMEMBERED_DOOR)
        self._state = np.zeros(1, dtype=MEMORY_STATE)
        self._views = np.zeros(1, dtype=PAST_VIEWS)
        self._state["narrowest"], self._state["widest"] = door_rules.narrowest, door_rules.widest

    @property
    def arrays(self) -> tuple[FloatArray, NDArray[np.void], NDArray[np.void], NDArray[np.void]]:
        """(walls, doors, counters, past views) for a kernel that updates them in place.

        The walls have the rows that `kernels.remembered` names, shape (`WALL_ROWS`, room); the
        dtypes of the others are `REMEMBERED_DOOR`, `MEMORY_STATE` and `PAST_VIEWS`.
        """
        return self._walls, self._doors, self._state, self._views

    def clear(self) -> None:
        """Forget everything."""
        for name in COUNTERS:
            self._state[name] = 0

    def copy(self) -> SceneMemory:
        """A copy of the present memory for reading; it has no capacity for more."""
        copy = object.__new__(SceneMemory)
        copy._state, copy._views = self._state.copy(), self._views[:0]
        walls, doors = (int(self._state[name][0]) for name in ("walls", "doors"))
        room = walls + -walls % WIDTH
        copy._walls, copy._doors = self._walls[:, :room].copy(), self._doors[:doors].copy()
        return copy

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
            ranges: of the scan, metres, with `scan.plain_codes` for what is no return.
            angles: angle_min and angle_increment of the scan, radians.
            lidar_pose: of the lidar in the memory's frame.
        """
        remember(walls, doors, counts, ranges, *angles, lidar_pose, self.arrays)

    def see(self, scene: Scene, scan: Scan, lidar_pose: Pose) -> None:
        """Add a scan with its scene, such as one of a log; see `update`.

        Args:
            scene: the scene of the scan, lidar frame.
            scan: the scan.
            lidar_pose: of the lidar in the memory's frame.
        """
        from semnav_features.scan import plain_codes  # a simulated robot needs none

        walls, doors = np.zeros(len(scene.walls), WALL), np.zeros(len(scene.doors), DOOR)
        for array, items in ((walls, scene.walls), (doors, scene.doors)):
            for name, column in zip(ENDS, ends_of(items).T, strict=True):
                array[name] = column
        doors["confidence"] = [door.confidence for door in scene.doors]
        counts = np.zeros(COUNTS_SIZE, np.int64)
        counts[WALLS], counts[DOORS] = len(walls), len(doors)
        angles = scan.angle_min, scan.angle_increment
        ranges = plain_codes(scan.ranges, scan.range_min, scan.range_max)
        self.update(walls, doors, counts, ranges, angles, lidar_pose)

    def locate(self, scene: Scene, lidar_pose: Pose) -> Pose:
        """Correct the pose of a lidar by the walls that it sees again (`kernels.drift`).

        Call it before `see`.

        Args:
            scene: what was extracted from a scan, lidar frame.
            lidar_pose: of the lidar by odometry since the last scan, in the memory's frame.
        """
        from semnav_features.kernels.scene_drift import without_drift

        walls = ends_of(scene.placed(lidar_pose).walls)
        return without_drift(walls, self._walls, self._state["walls"][0], lidar_pose)

    @property
    def size(self) -> tuple[int, int]:
        """Number of walls and of doors that count."""
        return how_many_count(self.arrays)

    def scene(self) -> Scene:
        """The walls and doors that count, in the memory's frame, in the order first seen."""
        walls, doors, beliefs = what_counts(self.arrays)
        return Scene(PlainWalls(walls), RememberedDoors(doors, beliefs))
