"""Columns seen from several places: by one scan, merged as Yan et al. do, by least squares."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from shapely import box

from semnav_env.world.lidar import Lidar
from semnav_env.world.maps import FloorPlan, Surface
from semnav_features import Arc, ExtractorSettings, extract
from semnav_features.frames import FloatArray, Point, Pose, points_to_parent
from semnav_features.kernels.circles import algebraic_circle
from semnav_features.mapping import LandmarkMap, LandmarkSettings
from semnav_features.scan import Scan

SIDES = 360
"""Sides of the polygon that stands for a column; it is within 0.02 mm of a circle of 1 m."""


@dataclass(frozen=True)
class ColumnErrors:
    """One column that was seen from several places.

    Attributes:
        first: errors of the first arc alone: centre and radius, metres.
        refitted: of the circle through all points of all arcs.
        fused: of the estimate fused by least squares.
        nees: normalised error squared of `fused`, chi-square with three degrees of freedom.
        columns: number of columns in the map; 1 is right.
    """

    first: tuple[float, float]
    refitted: tuple[float, float]
    fused: tuple[float, float]
    nees: float
    columns: int


def hall(radius: float) -> FloorPlan:
    """A hall of 12 x 12 m with a column in the middle."""
    angles = np.linspace(0.0, math.tau, SIDES + 1)[:-1]
    ring = [(radius * math.cos(a), radius * math.sin(a)) for a in angles]
    square = ((-6.0, -6.0), (6.0, -6.0), (6.0, 6.0), (-6.0, 6.0), (-6.0, -6.0))
    surfaces = Surface(square), Surface((*ring, ring[0]))
    return FloorPlan("hall", surfaces, (), (), (), (), box(-7.0, -7.0, 7.0, 7.0))


def column_errors(radius: float, views: int, sigma: float, trial: int) -> ColumnErrors | None:
    """Walk around a column; None if fewer than two scans show an arc.

    Args:
        radius: of the column, metres.
        views: number of scans, from all around.
        sigma: standard deviation of a range, metres.
        trial: seed of places and noise.
    """
    rng = np.random.default_rng(trial)
    plan = hall(radius)
    lidar = Lidar(plan, replace(Lidar(plan).spec, sigma=sigma, dropout=0.0))
    exact = LandmarkSettings(position=0.0, angle=0.0, sightings=1)
    landmarks, arcs, points = LandmarkMap(exact), list[tuple[Arc, Pose]](), list[FloatArray]()
    for step in range(views):
        bearing, distance = math.tau * (step + rng.random()) / views, radius + rng.uniform(1.0, 3.0)
        x, y = distance * math.cos(bearing), distance * math.sin(bearing)
        pose = (x, y, bearing + math.pi + rng.uniform(-0.5, 0.5))
        scan = lidar.scan(pose, key=(trial, 0, step))
        scene = extract(scan, ExtractorSettings(sigma=sigma))
        landmarks.add(scene, scan, pose)
        for arc in scene.arcs:
            arcs.append((arc, pose))
            points.append(points_to_parent(pose, _points(arc, scan)))
    if len(arcs) < 2 or not landmarks.arcs:
        return None
    first = _error(_placed(*arcs[0]), arcs[0][0].radius, radius)
    best = max(landmarks.arcs, key=lambda arc: arc.sightings)
    off = best.circle.mean - (0.0, 0.0, radius)
    nees = float(off @ np.linalg.solve(best.circle.covariance, off))
    refitted = _refit(np.concatenate(points), radius)
    return ColumnErrors(
        first, refitted, _error(best.centre, best.radius, radius), nees, len(landmarks.arcs)
    )


def _placed(arc: Arc, pose: Pose) -> Point:
    x, y = points_to_parent(pose, np.array(arc.centre)).tolist()
    return x, y


def _points(arc: Arc, scan: Scan) -> FloatArray:
    """The points of a scan that lie on an arc, shape (n, 2)."""
    angles = scan.angles
    ranges = np.where(scan.valid, scan.ranges, 0.0)
    points = ranges[:, None] * np.stack((np.cos(angles), np.sin(angles)), axis=1)
    start, end = (math.atan2(y, x) for x, y in (arc.start, arc.end))
    between = (angles - start) % math.tau <= (end - start) % math.tau
    near = np.abs(np.hypot(*(points - arc.centre).T) - arc.radius) < 4.0 * max(arc.residual, 0.005)
    chosen: FloatArray = points[between & near & scan.valid]
    return chosen


def _refit(points: FloatArray, radius: float) -> tuple[float, float]:
    """Yan et al., section 3: the merged arc is fitted to the data of all of them, as one arc is."""
    x, y, r = algebraic_circle(
        np.ascontiguousarray(points[:, 0]), np.ascontiguousarray(points[:, 1]), 0, len(points) - 1
    )
    return _error((x, y), r, radius)


def _error(centre: Point, found: float, radius: float) -> tuple[float, float]:
    return math.hypot(*centre), abs(found - radius)
