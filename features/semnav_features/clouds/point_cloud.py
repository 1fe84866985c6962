"""A cloud of points from stereo cameras, depth cameras or a 3D lidar."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from semnav_features.frames import FloatArray, Pose, points_to_parent, relative

HEAD = np.array([0.0, 0.0, 0.5])
"""Default position of a cloud's sensor: above the robot's centre, metres."""


MAX_POINTS = 60_000
"""Largest number of points that detectors use: twice those of SPOT's cameras. It bounds the time of
a detector for larger clouds."""


@dataclass(frozen=True, eq=False)
class PointCloud:
    """Points in the robot frame: x forward, y left, z up from the floor, metres.

    Points that are not finite are left out: cameras write NaN where they saw nothing.

    Attributes:
        points_robot: shape (n, 3), float64.
        origins_robot: position of the camera that saw each point, shape (n, 3), by which a detector
            knows the free space between. None: all were seen from `HEAD`.

    Raises:
        ValueError: an array of another shape, or of something else than numbers.
    """

    points_robot: FloatArray = field(default_factory=lambda: np.zeros((0, 3)))
    origins_robot: FloatArray | None = None

    def __post_init__(self) -> None:
        """Check and clean the points."""
        points = as_points(self.points_robot)
        origins = HEAD if self.origins_robot is None else as_points(self.origins_robot)
        if self.origins_robot is not None and origins.shape != points.shape:
            raise ValueError(f"{len(origins)} origins for {len(points)} points; give one for each")
        kept = np.isfinite(points).all(axis=1) & np.isfinite(origins).all(axis=-1)
        object.__setattr__(self, "points_robot", points[kept])
        object.__setattr__(self, "origins_robot", np.broadcast_to(origins, points.shape)[kept])

    def __len__(self) -> int:
        return len(self.points_robot)

    @property
    def origins(self) -> FloatArray:
        """`origins_robot`, never None."""
        assert self.origins_robot is not None
        return self.origins_robot

    def thinned(self, count: int = MAX_POINTS) -> PointCloud:
        """At most a number of points, evenly chosen in order; the cloud itself if it is smaller."""
        if len(self) <= count:
            return self
        chosen = np.linspace(0, len(self) - 1, count).astype(np.intp)
        return PointCloud(self.points_robot[chosen], self.origins[chosen])

    def seen_from(self, pose: Pose, now: Pose) -> PointCloud:
        """The cloud in the robot frame of another pose.

        Args:
            pose: of the robot when the cloud was taken, any frame.
            now: pose from which it is to be seen, the same frame.
        """
        moved = relative(now, pose)
        return PointCloud(_moved(moved, self.points_robot), _moved(moved, self.origins))


def fused(clouds: Sequence[PointCloud], poses: Sequence[Pose]) -> PointCloud:
    """Several clouds as one, in the robot frame of the last pose.

    Args:
        clouds: one after the other.
        poses: of the robot at each, in one frame, as odometry gives them.

    Raises:
        ValueError: no cloud, or not one pose for each.
    """
    if not clouds or len(clouds) != len(poses):
        raise ValueError(f"{len(clouds)} clouds with {len(poses)} poses; give one pose for each")
    moved = [cloud.seen_from(pose, poses[-1]) for cloud, pose in zip(clouds, poses, strict=True)]
    points, origins = (
        np.concatenate(arrays)
        for arrays in zip(*((each.points_robot, each.origins) for each in moved), strict=True)
    )
    return PointCloud(points, origins)


def _moved(frame: Pose, points: FloatArray) -> FloatArray:
    return np.column_stack((points_to_parent(frame, points[:, :2]), points[:, 2]))


def as_points(points: ArrayLike) -> FloatArray:
    """An array of shape (n, 3), float64.

    Raises:
        ValueError: another shape, or no numbers.
    """
    try:
        array = np.asarray(points, dtype=np.float64)
    except (TypeError, ValueError):
        raise ValueError("a point cloud is an array of numbers of shape (n, 3)") from None
    if array.size == 0 and array.ndim <= 2:
        return np.zeros((0, 3))
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"a point cloud of shape {array.shape}; it must be (n, 3): x, y, z")
    return array
