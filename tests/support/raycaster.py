"""A brute-force lidar over wall segments, independent of the simulator's."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from semnav_env.world.maps import load_floor_plan
from semnav_features import Scan
from semnav_features.frames import FloatArray, Point, Pose

FIELD_OF_VIEW = math.radians(270.0)


def polygon(*corners: tuple[float, float]) -> FloatArray:
    """The sides of a closed polygon as segments, shape (n, 2, 2)."""
    points = np.array(corners, dtype=float)
    return np.stack((points, np.roll(points, -1, axis=0)), axis=1)


def polyline(*corners: tuple[float, float]) -> FloatArray:
    """The segments between successive points, shape (n - 1, 2, 2)."""
    points = np.array(corners, dtype=float)
    return np.stack((points[:-1], points[1:]), axis=1)


def cast(segments: FloatArray, pose: Pose, angles: FloatArray) -> FloatArray:
    """Distance to the nearest segment along every beam; infinity where there is none."""
    directions = np.stack((np.cos(angles + pose[2]), np.sin(angles + pose[2])), axis=1)
    start = segments[:, 0] - np.array(pose[:2])
    along = segments[:, 1] - segments[:, 0]
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        cross = directions[:, :1] * along[:, 1] - directions[:, 1:] * along[:, 0]
        distance = (start[:, 0] * along[:, 1] - start[:, 1] * along[:, 0]) / cross
        place = start[:, 0] * directions[:, 1:] - start[:, 1] * directions[:, :1]
        place = place / cross
        hit = (distance > 0) & (place >= -1e-12) & (place <= 1 + 1e-12)
    return np.where(hit, distance, np.inf).min(axis=1)


def cast_circle(centre: Point, radius: float, pose: Pose, angles: FloatArray) -> FloatArray:
    """Distance to a circle along every beam: its near side, or its far side from within."""
    directions = np.stack((np.cos(angles + pose[2]), np.sin(angles + pose[2])), axis=1)
    away = np.array(centre) - np.array(pose[:2])
    along = directions @ away
    square = along**2 - (away @ away - radius**2)
    half = np.sqrt(np.where(square >= 0.0, square, np.nan))
    near, far = along - half, along + half
    distance = np.where(near > 0.0, near, far)
    return np.where(distance > 0.0, distance, np.inf)


def scan_of(
    segments: FloatArray,
    pose: Pose,
    beams: int = 811,
    field_of_view: float = FIELD_OF_VIEW,
    sigma: float = 0.0,
    rng: np.random.Generator | None = None,
    range_max: float = 10.0,
    circles: Sequence[tuple[Point, float]] = (),
) -> Scan:
    """A scan with the scanner at `pose`, x forward, and normal noise if a generator is given.

    Besides the segments it sees circles, given by centre and radius.
    """
    increment = field_of_view / (beams - 1)
    angles = -field_of_view / 2 + increment * np.arange(beams)
    ranges = cast(segments, pose, angles)
    for centre, radius in circles:
        ranges = np.minimum(ranges, cast_circle(centre, radius, pose, angles))
    if rng is not None:
        ranges = ranges + rng.normal(0.0, sigma, beams)
    return Scan(ranges, -field_of_view / 2, increment, range_max=range_max)


def full_circle(segments: FloatArray, pose: Pose, beams: int = 1080) -> Scan:
    return scan_of(segments, pose, beams, 2.0 * math.pi * (beams - 1) / beams)


def heidelberg() -> tuple[FloatArray, dict[str, FloatArray]]:
    """What the measured corridor's drawing shows, as segments, and its doors' jambs by name."""
    plan = load_floor_plan("heidelberg_hallway")
    drawn = [polyline(*surface.points) for surface in plan.surfaces if not surface.assumed]
    return np.concatenate(drawn), {d.name: np.array([d.start, d.end]) for d in plan.doors}
