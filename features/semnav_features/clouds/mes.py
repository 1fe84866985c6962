"""The detector of Mes 2021, chapter 6: her steps, her parameters, each of which can be left out."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from enum import Enum

import numpy as np

from semnav_features.clouds.clusters import euclidean_clusters
from semnav_features.clouds.crop import CropBox, crop
from semnav_features.clouds.detected_door import DetectedDoor
from semnav_features.clouds.outliers import remove_outliers
from semnav_features.clouds.plane import plane_inliers
from semnav_features.clouds.point_cloud import PointCloud
from semnav_features.clouds.upright_line import UprightLine, pair_apart, upright_line
from semnav_features.clouds.voxels import voxel_grid
from semnav_features.elements import Door
from semnav_features.frames import FloatArray

JAMB_SIGMA = 0.05
"""Standard deviation of a jamb along either axis, metres: the side of her voxels."""

WIDTH_SIGMA = 0.10
"""Standard deviation of a jamb that was put beside the other one, metres."""


class MesStep(Enum):
    """A step that an ablation leaves out."""

    CROP = "crop"
    OUTLIERS = "outlier removal"
    PLANE = "plane"
    VOXELS = "voxel grid"
    CLUSTER_SIZES = "cluster sizes"
    LINES = "upright line"
    PAIR = "pair"


@dataclass(frozen=True)
class MesDetector:
    """The pipeline of Mes 2021.

    Attributes:
        margins: margins of the crop, which was made by hand in the thesis.
        without: steps that are left out. Without lines a cluster's mean is its jamb; without the
            pair the two largest clusters are.
    """

    margins: CropBox = field(default_factory=CropBox)
    without: frozenset[MesStep] = frozenset()

    def find_door(
        self, cloud: PointCloud, expected: Door, sigma: float, rng: np.random.Generator
    ) -> DetectedDoor | None:
        """The door in a cloud, or one jamb of it, or None.

        Args:
            cloud: robot frame.
            expected: where the door should be, robot frame.
            sigma: standard deviation of that place, metres.
            rng: of both RANSACs.

        Returns:
            Where no pair is as far apart as jambs are, the line nearest to an expected jamb is
            the one that was found, as in her figures 8.3b, 8.4b and 8.4c.

        Raises:
            ValueError: see `crop`.
        """
        points = cloud.thinned().points_robot
        if self._does(MesStep.CROP):
            points = crop(points, expected, sigma, self.margins)
        lines = self.lines(self.thinned(points, rng), rng)
        if self._does(MesStep.PAIR):
            pair = pair_apart(lines)
        else:
            largest = sorted(lines, key=lambda line: -line.support)[:2]
            pair = (largest[0], largest[1]) if len(largest) == 2 else None
        return _whole(pair, expected) if pair else _half(lines, expected)

    def thinned(self, points: FloatArray, rng: np.random.Generator) -> FloatArray:
        """Outlier removal, plane and voxel grid."""
        if self._does(MesStep.OUTLIERS):
            points = remove_outliers(points)
        if self._does(MesStep.PLANE):
            points = points[plane_inliers(points, rng)]
        return voxel_grid(points) if self._does(MesStep.VOXELS) else points

    def lines(self, points: FloatArray, rng: np.random.Generator) -> list[UprightLine]:
        """Clusters, and an upright line in each."""
        sizes = {} if self._does(MesStep.CLUSTER_SIZES) else {"largest": len(points)}
        clusters = euclidean_clusters(points, **sizes)
        if not self._does(MesStep.LINES):
            return [_middle(cluster) for cluster in clusters]
        found = (upright_line(cluster, rng) for cluster in clusters)
        return [line for line in found if line is not None]

    def _does(self, step: MesStep) -> bool:
        return step not in self.without


def _middle(cluster: FloatArray) -> UprightLine:
    x, y, _ = cluster.mean(axis=0).tolist()
    low, high = float(cluster[:, 2].min()), float(cluster[:, 2].max())
    return UprightLine((x, y), low, high, len(cluster))


def _whole(pair: tuple[UprightLine, UprightLine], expected: Door) -> DetectedDoor:
    """Both jambs, in the order of the expected door."""
    start, end = (line.point for line in pair)
    straight = math.dist(start, expected.start) + math.dist(end, expected.end)
    swapped = math.dist(end, expected.start) + math.dist(start, expected.end)
    if swapped < straight:
        start, end = end, start
    return DetectedDoor(start, end, 1.0, JAMB_SIGMA**2 * np.eye(4))


def _half(lines: list[UprightLine], expected: Door) -> DetectedDoor | None:
    """The one line that is nearest to an expected jamb, and the other jamb put beside it."""
    ends = expected.start, expected.end
    choices = [(math.dist(line.point, end), line, end) for line in lines for end in ends]
    if not choices:
        return None
    _, line, end = min(choices, key=lambda choice: choice[0])
    dx, dy = line.point[0] - end[0], line.point[1] - end[1]
    start, stop = ((x + dx, y + dy) for x, y in ends)
    at_start = end == expected.start
    unseen = np.array([0.0, 0.0, 1.0, 1.0] if at_start else [1.0, 1.0, 0.0, 0.0])
    shared = JAMB_SIGMA**2 * np.tile(np.eye(2), (2, 2))
    covariance = np.asarray(shared + WIDTH_SIGMA**2 * np.diag(unseen), dtype=np.float64)
    return DetectedDoor(start, stop, 0.5, covariance, at_start, not at_start)
