"""A map of landmarks: corners and columns with their covariances, and a pose found by them."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from semnav_features.elements import Corner
from semnav_features.frames import FloatArray, Pose, relative, wrap_angle
from semnav_features.mapping.arc_sightings import arc_sightings
from semnav_features.mapping.corner_sightings import corner_sightings
from semnav_features.mapping.gaussians import PlaceEstimate, squared_distance
from semnav_features.mapping.landmark_settings import LandmarkSettings
from semnav_features.mapping.landmark_table import Landmark, LandmarkTable
from semnav_features.mapping.map_landmarks import MapArc, MapCorner
from semnav_features.scan import Scan
from semnav_features.scene import Scene

_CLEANUP_PERIOD = 200
"""Scans after which a landmark that does not count is forgotten."""

_STEPS = 3
"""Gauss-Newton steps of a pose: the last moves it by less than a tenth of a millimetre."""

_L = TypeVar("_L", bound=Landmark)

_Pair = tuple[PlaceEstimate, PlaceEstimate]
"""A place in the scanner's frame, and that of the landmark it shows, in the map."""


@dataclass(frozen=True, slots=True, eq=False)
class LandmarkFix:
    """The pose of a scanner by landmarks.

    Attributes:
        pose: in the map.
        information: inverse covariance of x, y and heading, shape (3, 3).
        matched: number of landmarks that were used.
    """

    pose: Pose
    information: FloatArray
    matched: int


class LandmarkMap:
    """Corners and arcs of many scans, each fused from its sightings by least squares.

    After Weerakoon et al., sections II-D and II-E and table II (corners), and Yan et al., section 3
    (arcs). In place of a new fit to all old points every landmark is an estimate with a
    covariance, and a sighting is one more of them (`gaussians.fused`).

    Args:
        settings: every limit.

    Attributes:
        scans: number of scans it is made from.
    """

    scans: int

    def __init__(self, settings: LandmarkSettings = LandmarkSettings()) -> None:
        self.scans = 0
        self._settings = settings
        self._corners: LandmarkTable[MapCorner] = LandmarkTable(settings)
        self._arcs: LandmarkTable[MapArc] = LandmarkTable(settings)
        self._last: Pose | None = None

    @property
    def corners(self) -> tuple[MapCorner, ...]:
        """The corners that were seen often enough, oldest first."""
        return self._counting(self._corners)

    @property
    def arcs(self) -> tuple[MapArc, ...]:
        """The columns and curved walls that were seen often enough, oldest first."""
        return self._counting(self._arcs)

    @property
    def scene(self) -> Scene:
        """Its corners and arcs."""
        corners = tuple([Corner(corner.point, corner.kind) for corner in self.corners])
        return Scene(corners=corners, arcs=tuple([arc.as_arc() for arc in self.arcs]))

    def add(self, scene: Scene, scan: Scan, pose: Pose) -> None:
        """Add what a scan shows; scans from nearly the same pose count once.

        Args:
            scene: extracted from the scan, in its frame.
            scan: the scan.
            pose: of the scan in the map.
        """
        if self._last is not None and not self._moved(self._last, pose):
            return
        self._last = pose
        self.scans += 1
        covariance = self._settings.pose_covariance
        for corner in corner_sightings(scene, scan, self._settings):
            self._corners.add(MapCorner.of(corner, pose, covariance, self.scans))
        for arc in arc_sightings(scene, scan, self._settings):
            self._arcs.add(MapArc.of(arc, pose, covariance, self.scans))
        if self.scans % _CLEANUP_PERIOD == 0:
            self._corners.keep(self._is_worth_keeping)
            self._arcs.keep(self._is_worth_keeping)

    def locate(self, scene: Scene, scan: Scan, pose: Pose, information: FloatArray) -> LandmarkFix:
        """Correct a pose by the landmarks that a scan shows again.

        With the landmarks m_j, the sightings p_i, and the guess x_0 of the pose x = (t, a) it
        minimises, by Gauss-Newton steps,

            sum (t + R(a) p_i - m_j)^T S^-1 (t + R(a) p_i - m_j) + (x - x_0)^T I (x - x_0),

        where S is the covariance of sighting and landmark together. A sighting is paired with the
        likeliest landmark within the errors of both and of the guess. What no landmark determines
        stays as guessed. Call it before `add`.

        Args:
            scene: extracted from the scan, in its frame.
            scan: the scan.
            pose: the guess x_0, in the map.
            information: I, inverse covariance of x, y and heading of the guess, shape (3, 3).
        """
        covariance: FloatArray = np.asarray(np.linalg.inv(information), np.float64)
        corners = [
            (seen.place, MapCorner.of(seen, pose, covariance))
            for seen in corner_sightings(scene, scan, self._settings)
        ]
        arcs = [
            (seen.place, MapArc.of(seen, pose, covariance))
            for seen in arc_sightings(scene, scan, self._settings)
        ]
        pairs = [*self._pairs(self._corners, corners), *self._pairs(self._arcs, arcs)]
        if not pairs:
            return LandmarkFix(pose, information, 0)
        return _fitted(pairs, np.array(pose), information)

    def _pairs(
        self, known: LandmarkTable[_L], seen: Iterable[tuple[PlaceEstimate, _L]]
    ) -> list[_Pair]:
        """Sightings with the landmarks they show: each landmark once, by the likeliest sighting."""
        best: dict[int, tuple[float, _Pair]] = {}
        for local, here in seen:
            for k in known.same(here):
                landmark = known.landmarks[k]
                if landmark.sightings < self._settings.sightings:
                    continue
                distance = squared_distance(here.place, landmark.place)
                if k not in best or distance < best[k][0]:
                    best[k] = distance, (local, landmark.place)
                break
        return [pair for _, pair in best.values()]

    def _counting(self, table: LandmarkTable[_L]) -> tuple[_L, ...]:
        fewest = self._settings.sightings
        factor = table.variance_factor
        return tuple([m.scaled(factor) for m in table.landmarks if m.sightings >= fewest])

    def _is_worth_keeping(self, landmark: Landmark) -> bool:
        recent = self.scans - landmark.born < _CLEANUP_PERIOD
        return recent or landmark.sightings >= self._settings.sightings

    def _moved(self, last: Pose, pose: Pose) -> bool:
        x, y, heading_change = relative(last, pose)
        s = self._settings
        return math.hypot(x, y) >= s.least_move or abs(heading_change) >= s.least_turn


def _fitted(pairs: list[_Pair], guess: FloatArray, information: FloatArray) -> LandmarkFix:
    """The pose with the least squared errors; see `LandmarkMap.locate`."""
    found = guess.copy()
    for _ in range(_STEPS):
        c, s = math.cos(found[2]), math.sin(found[2])
        rotation = np.array(((c, -s), (s, c)))
        off = found - guess
        matrix, gradient = information.copy(), information @ off
        for seen, known in pairs:
            lever = rotation @ seen.mean
            jacobian = np.array(((1.0, 0.0, -lever[1]), (0.0, 1.0, lever[0])))
            covariance = rotation @ seen.covariance @ rotation.T + known.covariance
            weighted = np.linalg.solve(covariance, jacobian).T
            matrix += weighted @ jacobian
            gradient += weighted @ (found[:2] + lever - known.mean)
        found = found - np.linalg.solve(matrix, gradient)
    x, y, heading = found.tolist()
    return LandmarkFix((x, y, wrap_angle(heading)), matrix, len(pairs))
