"""The obstacles near the robot, remembered from lidar scans in the odometry frame."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Annotated, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from semnav_agents.planning.free import points_around
from semnav_agents.planning.obstacle_kernels import (
    CENTRE,
    OBSTACLE_STATE,
    TABLE_SHAPE,
    MemoryClock,
    MemoryLimits,
    remember,
)
from semnav_agents.planning.obstacle_selection import SelectionLimits, box_around, select
from semnav_env.world.maps.cell_budget import check_cells
from semnav_features.checked_fields import Bounds, Count, Length, Share, check_fields
from semnav_features.frames import FloatArray, Pose


@dataclass(frozen=True)
class MemorySettings:
    """Duration and resolution of the memory of obstacles.

    Attributes:
        radius: distance from the lidar beyond which hits are neither taken nor kept, metres.
        merge: distance to a remembered centre below which a hit refines it, metres.
        window: hits over which a centre's position is averaged.
        travel: distance driven since its last hit after which a centre is forgotten, metres.
        turned: angle turned since its last hit, in all, after which it is forgotten, radians.
        scans: scans since its last hit after which it is forgotten.
        through: distance behind a centre that a beam must reach to count against it, metres.
        sure: hits from which a centre counts as an obstacle.
        share: share of a neighbour's hits below which a centre is noise.
        blunt: length by which the averaging shortens the ends of walls, metres.
        capacity: largest number of centres; further ones are dropped.
    """

    radius: Length = 6.0
    merge: Length = 0.05
    window: Count = 40
    travel: Length = 8.0
    turned: Annotated[float, Bounds(0.0, 1e6, "rad")] = 10.0
    scans: Count = 600
    through: Length = 0.15
    sure: Count = 2
    share: Share = 0.12
    blunt: Length = 0.018
    capacity: Annotated[int, Bounds(1, 1_000_000)] = 8192

    def __post_init__(self) -> None:
        check_fields(self)

    @cached_property
    def limits(self) -> MemoryLimits:
        """What decides what is remembered, as kernels take it."""
        max_age = MemoryClock(float(self.scans), self.travel, self.turned)
        return MemoryLimits(self.radius, self.merge, self.window, self.through, max_age)

    @cached_property
    def selection(self) -> SelectionLimits:
        """What decides which centres count, as kernels take it."""
        return SelectionLimits(self.sure, self.share, self.blunt)


MemoryArrays: TypeAlias = tuple[np.ndarray, np.ndarray, NDArray[np.int32]]
"""State, centres and table of memories, see `remember`; shapes (n,), (n, capacity) and that of the
table."""


class ObstacleMemory:
    """Centres of the hits of recent scans, at most one in each voxel of 5 cm.

    A centre through which beams pass is cleared. A centre out of view is kept until the robot has
    driven or turned so far that odometry no longer determines its position.

    Args:
        settings: duration and resolution.
        arrays: its own part of those of many memories, with n = 1; new ones if not given.
    """

    def __init__(
        self, settings: MemorySettings | None = None, arrays: MemoryArrays | None = None
    ) -> None:
        self.settings = settings or MemorySettings()
        self._state, self._centres, self._table = arrays or memory_arrays(1, self.settings)

    def reset(self) -> None:
        """Forget everything."""
        self._state[:] = 0

    def update(
        self, lidar_pose_in_odom: Pose, ranges: ArrayLike, directions: FloatArray, range_max: float
    ) -> None:
        """Add one scan.

        Args:
            lidar_pose_in_odom: metres and radians.
            ranges: metres, shape (n,); what is not within (0.05, range_max) is no return.
            directions: unit vectors of the beams in the lidar frame, evenly spaced
                counter-clockwise, shape (n, 2).
            range_max: metres.

        Raises:
            ValueError: ranges and directions of different lengths, or a pose that is not finite.
        """
        distances = np.ascontiguousarray(ranges, dtype=np.float64)
        if distances.ndim != 1 or directions.shape != (len(distances), 2):
            raise ValueError(
                f"ranges have shape {distances.shape} and directions {directions.shape}; "
                "they must be (n,) and (n, 2)"
            )
        if not all(math.isfinite(value) for value in lidar_pose_in_odom):
            raise ValueError(f"lidar_pose_in_odom is {lidar_pose_in_odom}; it must be finite")
        if len(distances) < 3:
            return
        x, y, heading = lidar_pose_in_odom
        remember(
            self._state[0],
            self._centres[0],
            self._table,
            (float(x), float(y), float(heading)),
            distances,
            directions,
            float(range_max),
            self.settings.limits,
        )

    def points(self) -> FloatArray:
        """The obstacles, metres in the odometry frame, shape (N, 2)."""
        return self._select(0.0, 0.0, math.inf)

    def near(self, pose: Pose, reach: float) -> FloatArray:
        """Those of `points` around a pose, see `points_around`."""
        return points_around(pose, self._select(pose[0], pose[1], reach), reach)

    def _select(self, x: float, y: float, reach: float) -> FloatArray:
        centres = self._centres[0, : self._state["count"][0]]
        chosen: FloatArray = select(
            centres, self._table, box_around(x, y, reach), self.settings.selection
        )
        return chosen


def memory_arrays(count: int, settings: MemorySettings) -> MemoryArrays:
    """The arrays of some memories, which share a table."""
    return (
        np.zeros(count, OBSTACLE_STATE),
        np.zeros((count, settings.capacity), CENTRE),
        np.full(TABLE_SHAPE, -1, np.int32),
    )


def points_of_segments(segments: FloatArray, spacing: float = 0.02) -> FloatArray:
    """Points on line segments, both ends included, at most `spacing` metres apart.

    Args:
        segments: x1, y1, x2, y2 in metres, shape (n, 4).
        spacing: metres.

    Returns:
        shape (N, 2).

    Raises:
        FloorPlanError: there are more points than the budget allows.
    """
    starts, ends = segments[:, :2], segments[:, 2:]
    counts = point_counts(segments, spacing)
    check_cells(counts.sum(), f"points {spacing} m apart on {len(segments):,} segments")
    index = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
    owner = np.repeat(np.arange(len(segments)), counts)
    steps = (ends - starts) / (counts - 1)[:, None]
    points: FloatArray = starts[owner] + index[:, None] * steps[owner]
    points[np.cumsum(counts) - 1] = ends  # exactly, whatever the rounding
    return points


def point_counts(segments: FloatArray, spacing: float = 0.02) -> NDArray[np.intp]:
    """Number of the `points_of_segments` on each segment, shape (n,)."""
    lengths = np.hypot(segments[:, 2] - segments[:, 0], segments[:, 3] - segments[:, 1])
    return np.maximum(2, np.ceil(lengths / spacing).astype(np.intp) + 1)
