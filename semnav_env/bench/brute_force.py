"""A lidar by brute force in NumPy: the yardstick of the benchmark, and what tests compare with."""

from __future__ import annotations

import numpy as np

from semnav_env.features.frames import FloatArray, Pose, points_to_local


def brute_force_ranges(pose: Pose, segments: FloatArray, angles: FloatArray) -> FloatArray:
    """Intersect every beam with every segment.

    Args:
        pose: of the lidar in the world.
        segments: x1, y1, x2, y2 in metres, shape (m, 4).
        angles: of the beams in the lidar frame, radians, shape (n,).

    Returns:
        Distance to the nearest hit in metres, shape (n,); +inf where there is none at all.
    """
    ends = points_to_local(pose, segments.reshape(-1, 2, 2))
    a, along = ends[:, 0], ends[:, 1] - ends[:, 0]
    cos, sin = np.cos(angles)[:, None], np.sin(angles)[:, None]
    with np.errstate(divide="ignore", invalid="ignore"):
        facing = cos * along[:, 1] - sin * along[:, 0]
        distance = (a[:, 0] * along[:, 1] - a[:, 1] * along[:, 0]) / facing
        place = (a[:, 0] * sin - a[:, 1] * cos) / facing
    met = (distance >= 0.0) & (place >= -1e-12) & (place <= 1.0 + 1e-12)
    nearest: FloatArray = np.where(met, distance, np.inf).min(axis=1, initial=np.inf)
    return nearest
