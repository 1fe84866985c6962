"""Arcs of a scan as landmarks: centre and radius with their covariance."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from semnav_features.elements import Arc
from semnav_features.frames import FloatArray
from semnav_features.kernels.circles import MIN_SQUARED_COSINE
from semnav_features.mapping.gaussians import PlaceEstimate
from semnav_features.mapping.landmark_settings import LandmarkSettings
from semnav_features.mapping.surface import range_noise
from semnav_features.scan import Scan
from semnav_features.scene import Scene

_MAX_DEVIATION = 1.0
"""Standard deviation of the centre or radius from which on an arc says nothing, metres."""


@dataclass(frozen=True, slots=True, eq=False)
class ArcSighting:
    """An arc that a scan shows.

    Attributes:
        circle: centre x, y and radius, with their covariance, shape (3, 3).
        arc: the arc.
    """

    circle: PlaceEstimate
    arc: Arc

    @property
    def place(self) -> PlaceEstimate:
        """The centre with its covariance, whatever the radius is."""
        return centre_of(self.circle)


def centre_of(circle: PlaceEstimate) -> PlaceEstimate:
    """The centre of a circle with its covariance, whatever the radius is."""
    return PlaceEstimate(circle.mean[:2], circle.covariance[:2, :2])


def arc_sightings(
    scene: Scene, scan: Scan, settings: LandmarkSettings = LandmarkSettings()
) -> list[ArcSighting]:
    """The arcs of a scan that are landmarks, with the covariances of their circles.

    A point p of an arc has the error |p - c| - r = -u . dc - dr, with u the unit vector from the
    centre c. So the information on (c, r) is the sum of w (u, 1) (u, 1)^T over the beams, with the
    weights of the extractor's fit (`kernels.circles`): the error of a range lies along its beam.
    The tangent rays beside a column, which the fit uses as well, are left out: they only add.

    Args:
        scene: extracted from `scan`, in its frame.
        scan: the scan.
        settings: reach and roughness.
    """
    noise = range_noise(scan.ranges, (scan.range_min, scan.range_max))
    found = []
    for arc in scene.arcs:
        if min(math.hypot(*arc.start), math.hypot(*arc.end)) > settings.reach:
            continue
        information = _information(arc, scan, noise, settings)
        values, vectors = np.linalg.eigh(information)
        if values[0] * _MAX_DEVIATION**2 > 1.0:
            circle = np.array((*arc.centre, arc.radius))
            found.append(ArcSighting(PlaceEstimate(circle, vectors / values @ vectors.T), arc))
    return found


def _information(arc: Arc, scan: Scan, noise: float, settings: LandmarkSettings) -> FloatArray:
    """What the beams of an arc tell of its centre and radius, shape (3, 3)."""
    start, end = (math.atan2(y, x) for x, y in (arc.start, arc.end))
    bearings = start + np.linspace(0.0, (end - start) % math.tau, max(arc.beams, 3))
    beams = np.stack((np.cos(bearings), np.sin(bearings)), axis=1)
    along = beams @ np.array(arc.centre)
    depth = np.sqrt(np.maximum(arc.radius**2 - (math.hypot(*arc.centre) ** 2 - along**2), 0.0))
    points = (along + np.where(arc.convex, -depth, depth))[:, None] * beams
    normals = (points - arc.centre) / arc.radius
    incidence = np.sum(normals * beams, axis=1) ** 2
    weights = 1.0 / (noise**2 * (incidence + MIN_SQUARED_COSINE) + settings.roughness**2)
    rows = np.column_stack((normals, np.ones(len(normals))))
    return np.asarray((rows * weights[:, None]).T @ rows, np.float64)
