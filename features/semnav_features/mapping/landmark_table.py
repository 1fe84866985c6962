"""Data association of landmarks: finds the known one that a sighting shows."""

from __future__ import annotations

from collections.abc import Callable
from typing import Generic, Protocol, Self, TypeVar

import numpy as np

from semnav_features.frames import FloatArray
from semnav_features.mapping.gaussians import PlaceEstimate, squared_distance
from semnav_features.mapping.landmark_settings import LandmarkSettings

_NEAR = 1.5
"""Landmarks farther apart than this are never compared, metres."""


_PRIOR_FREEDOM = 10.0
"""Unknowns whose sightings count as scattered as their covariances say, before any is seen."""


class Landmark(Protocol):
    """What corners and arcs of a map have in common."""

    sightings: int
    born: int

    @property
    def place(self) -> PlaceEstimate:
        """(x, y) with its covariance."""

    def is_one_with(self, other: Self, settings: LandmarkSettings, factor: float) -> bool:
        """Whether two may be the same landmark, if covariances are larger by a factor."""

    def absorb(self, other: Self) -> None:
        """Fuse another estimate of the same landmark."""

    def scaled(self, factor: float) -> Self:
        """The same with covariances that are larger by a factor."""


_L = TypeVar("_L", bound=Landmark)


class LandmarkTable(Generic[_L]):
    """Landmarks of one kind, in the order in which they were first seen.

    Args:
        settings: which two are one.
    """

    def __init__(self, settings: LandmarkSettings) -> None:
        self.landmarks: list[_L] = []
        self._settings = settings
        self._squares = self._freedom = _PRIOR_FREEDOM
        self._points: FloatArray = np.empty((0, 2))

    @property
    def variance_factor(self) -> float:
        """Factor by which the sightings scatter more than their covariances say, at least 1.

        The variance of unit weight of an adjustment by least squares: the mean squared Mahalanobis
        distance of sightings from the landmarks they were fused with, for each unknown. Covariances
        that follow from noise alone leave out what the extractor does wrong.
        """
        return max(1.0, self._squares / self._freedom)

    def same(self, seen: _L) -> list[int]:
        """Numbers of the landmarks that may be the one that is seen, the likeliest first."""
        off = self._points[: len(self.landmarks)] - seen.place.mean
        near = np.flatnonzero(np.abs(off).max(axis=1, initial=0.0) < _NEAR)
        found = [
            (squared_distance(seen.place, self.landmarks[k].place), int(k))
            for k in near
            if self.landmarks[k].is_one_with(seen, self._settings, self.variance_factor)
        ]
        return [k for _, k in sorted(found)]

    def add(self, seen: _L) -> None:
        """Fuse a sighting with the landmark that it shows, or keep it as a new one.

        Two landmarks that have come to agree with it and with each other are fused, too.
        """
        same = self.same(seen)
        if not same:
            self._append(seen)
            return
        first, *others = same
        known = self.landmarks[first]
        self._squares += squared_distance(seen.place, known.place)
        self._freedom += len(known.place.mean)
        known.absorb(seen)
        factor = self.variance_factor
        again = [k for k in others if self.landmarks[k].is_one_with(known, self._settings, factor)]
        for k in again:
            known.absorb(self.landmarks[k])
        self._points[first] = known.place.mean
        if again:
            gone = {id(self.landmarks[k]) for k in again}
            self.keep(lambda landmark: id(landmark) not in gone)

    def keep(self, is_kept: Callable[[_L], bool]) -> None:
        """Forget all other landmarks."""
        kept = [landmark for landmark in self.landmarks if is_kept(landmark)]
        self.landmarks, self._points = [], np.empty((0, 2))
        for landmark in kept:
            self._append(landmark)

    def _append(self, landmark: _L) -> None:
        if len(self.landmarks) == len(self._points):
            room = np.full((max(len(self._points), 64), 2), np.nan)
            self._points = np.concatenate((self._points, room))
        self._points[len(self.landmarks)] = landmark.place.mean
        self.landmarks.append(landmark)
