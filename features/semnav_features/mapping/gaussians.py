"""Estimates with covariances: moved between frames, compared, and fused by least squares."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from semnav_features.frames import FloatArray, Pose


class PlaceEstimate(NamedTuple):
    """A vector of unknowns whose first two are a place, with its covariance.

    Attributes:
        mean: shape (n,), metres.
        covariance: shape (n, n), m^2.
    """

    mean: FloatArray
    covariance: FloatArray


def placed(local: PlaceEstimate, frame: Pose, pose_covariance: FloatArray) -> PlaceEstimate:
    """An estimate in the parent of its frame, with the errors of the frame's own pose.

    A place p becomes R p + t. So its covariance becomes R C R^T + J P J^T, with P of the pose and
    J = (1, R p turned by a quarter). Other unknowns, such as a radius, stay as they are.

    Args:
        local: in `frame`.
        frame: pose of the frame in its parent.
        pose_covariance: of x, y and heading of that pose, shape (3, 3).
    """
    c, s = math.cos(frame[2]), math.sin(frame[2])
    rotation = np.eye(len(local.mean))
    rotation[:2, :2] = (c, -s), (s, c)
    mean = rotation @ local.mean
    covariance = rotation @ local.covariance @ rotation.T
    jacobian = np.array(((1.0, 0.0, -mean[1]), (0.0, 1.0, mean[0])))
    covariance[:2, :2] += jacobian @ pose_covariance @ jacobian.T
    mean[:2] += frame[:2]
    return PlaceEstimate(mean, covariance)


def fused(a: PlaceEstimate, b: PlaceEstimate) -> PlaceEstimate:
    """The least-squares estimate from two independent ones.

    It minimises (x - a)^T A^-1 (x - a) + (x - b)^T B^-1 (x - b) with the covariances A and B:

        x = a + A (A + B)^-1 (b - a),    with the covariance A - A (A + B)^-1 A.

    This form needs no inverse of A or B alone.
    """
    gain = np.linalg.solve(a.covariance + b.covariance, a.covariance).T
    mean = a.mean + gain @ (b.mean - a.mean)
    covariance = a.covariance - gain @ a.covariance
    return PlaceEstimate(mean, 0.5 * (covariance + covariance.T))


def squared_distance(a: PlaceEstimate, b: PlaceEstimate) -> float:
    """Squared Mahalanobis distance of two estimates; chi-square if they are of one thing."""
    off = b.mean - a.mean
    return float(off @ np.linalg.solve(a.covariance + b.covariance, off))
