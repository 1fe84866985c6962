"""Measures of motion: smoothness, clearance and collisions."""

from __future__ import annotations

import math

import numpy as np
import shapely
from numpy.typing import NDArray

from semnav_env.robots import RobotSpec
from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_env.world.maps.placement import corners
from semnav_features.frames import FloatArray

MAX_CLEARANCE = 10.0
"""Largest clearance that is reported, metres; farther obstacles do not matter."""

LEAST_PATH = 1.0
"""Least length of path by which collisions are divided, metres; it avoids a division by zero."""


def rms_jerk(path: FloatArray, period: float) -> float:
    """Root mean square of the jerk of the robot's centre, m/s^3.

    The jerk is the third derivative of the place (Flash and Hogan 1985), here the third difference
    over the cube of the period. A path of fewer than four points has none: 0.

    Args:
        path: path of the robot's centre, one point a step, shape (n, 2), metres.
        period: between two points, seconds.
    """
    if len(path) < 4:
        return 0.0
    jerk = np.diff(path, n=3, axis=0) / period**3
    return math.sqrt(float((jerk**2).sum(axis=1).mean()))


def clearances(poses: FloatArray, robot: RobotSpec, floor_plan: FloorPlan) -> FloatArray:
    """Euclidean distance of the footprint from the nearest solid segment, metres, shape (n,).

    The distance is 0 where they touch, and at most `MAX_CLEARANCE`. Only segments of the plan
    count.

    Args:
        poses: poses of the robot's centre, shape (n, 3), world frame.
        robot: its footprint counts.
        floor_plan: the solid segments.
    """
    if len(floor_plan.segments) == 0:
        return np.full(len(poses), MAX_CLEARANCE)
    bodies = footprints(poses, robot)
    (rows, _), distances = floor_plan.solids.query_nearest(
        bodies, return_distance=True, all_matches=False
    )
    found = np.full(len(poses), MAX_CLEARANCE)
    found[rows] = np.minimum(distances, MAX_CLEARANCE)
    return found


def footprints(poses: FloatArray, robot: RobotSpec) -> NDArray[np.object_]:
    """The rectangles that a robot covers at some poses, as Shapely polygons, shape (n,)."""
    cosine, sine = np.array([(math.cos(turn), math.sin(turn)) for turn in poses[:, 2].tolist()]).T
    x, y = corners(robot).T
    rings = (
        poses[:, :1] + cosine[:, None] * x - sine[:, None] * y,
        poses[:, 1:2] + sine[:, None] * x + cosine[:, None] * y,
    )
    polygons: NDArray[np.object_] = shapely.polygons(np.stack(rings, axis=-1))
    return polygons


def collisions_per_100m(collisions: int, path_length: float) -> float:
    """Collisions per 100 m of path; a path shorter than `LEAST_PATH` counts as that long."""
    return 100.0 * collisions / max(path_length, LEAST_PATH)
