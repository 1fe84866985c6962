"""Circles through points, fitted by linear algebra."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from semnav_features.frames import FloatArray
from tests.numpy_oracle.constants import CIRCLE_FIT


@dataclass(frozen=True, eq=False)
class Circle:
    """Metres, in the frame of the scanner."""

    centre: FloatArray
    radius: float

    def beyond(self, points: FloatArray) -> FloatArray:
        """Signed distances of points outside the circle, shape (k,)."""
        return np.asarray(np.linalg.norm(points - self.centre, axis=1) - self.radius)

    def bulges_at(self, point: FloatArray) -> bool:
        """Whether it bulges towards the scanner at one of its points."""
        return bool((self.centre - point) @ point > 0.0)

    def nearest(self, point: FloatArray) -> FloatArray:
        """The point of the circle that is nearest to a point."""
        away = point - self.centre
        return np.asarray(self.centre + self.radius / np.linalg.norm(away) * away)


@dataclass(frozen=True, eq=False)
class EdgeRay:
    """A ray that touches a circle: unit normal towards the centre, and how exact it is.

    `weight` is the error of a range over that of the distance at which the ray passes.
    """

    normal: FloatArray
    weight: float

    @classmethod
    def between(cls, hit: FloatArray, miss: FloatArray, point: FloatArray, sigma: float) -> EdgeRay:
        """The ray halfway from a beam that meets a column at `point` to the next, which passes.

        Its error is that of any place between the two, and a little for what noise does.
        """
        middle = (hit + miss) / np.linalg.norm(hit + miss)
        left = np.array((-middle[1], middle[0]))
        starts = hit[0] * miss[1] - hit[1] * miss[0] < 0.0
        spacing = float(np.linalg.norm(point) * np.linalg.norm(hit - miss))
        weight = sigma / float(np.hypot(spacing / np.sqrt(12.0), CIRCLE_FIT.edge_error * sigma))
        return cls(left if starts else -left, weight)


def algebraic_circle(points: FloatArray) -> Circle:
    """Taubin's fit, by singular values: Chernov, Circular and Linear Regression (2010), 5.9."""
    mean = points.mean(axis=0)
    centred = points - mean
    squares = (centred**2).sum(axis=1)
    size = squares.mean()
    design = np.column_stack(((squares - size) / (2.0 * np.sqrt(size)), centred))
    a, b, c = np.linalg.svd(design, full_matrices=False)[2][-1]
    a /= 2.0 * np.sqrt(size)
    centre = np.array((b, c)) / (-2.0 * a)
    return Circle(mean + centre, float(np.sqrt(centre @ centre + size)))


def refined(points: FloatArray, circle: Circle, rays: list[EdgeRay]) -> Circle:
    """Gauss-Newton steps: points weighted by their incidence, rays that touch the circle."""
    for _ in range(CIRCLE_FIT.refinements):
        away = points - circle.centre
        normals = away / np.linalg.norm(away, axis=1, keepdims=True)
        cosines = (normals * points).sum(axis=1) / np.linalg.norm(points, axis=1)
        weights = 1.0 / np.sqrt(cosines**2 + CIRCLE_FIT.least_cosine)
        jacobian = np.column_stack((normals, np.ones(len(points)))) * weights[:, None]
        errors = circle.beyond(points) * weights
        for ray in rays:
            jacobian = np.vstack((jacobian, ray.weight * np.array((*-ray.normal, 1.0))))
            touching = ray.normal @ circle.centre - circle.radius
            errors = np.append(errors, ray.weight * touching)
        if not np.isfinite(jacobian).all():
            return Circle(np.full(2, np.nan), np.nan)
        step = np.linalg.lstsq(jacobian, errors, rcond=None)[0]
        circle = Circle(circle.centre + step[:2], circle.radius + float(step[2]))
    return circle
