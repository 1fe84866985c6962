"""Landmarks of a map: corners and columns that were seen from several places, fused."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np

from semnav_features.elements import Arc, CornerKind
from semnav_features.frames import FloatArray, Point, Pose, heading_between, wrap_angle
from semnav_features.mapping.arc_sightings import ArcSighting, centre_of
from semnav_features.mapping.corner_sightings import CornerSighting, kind_of
from semnav_features.mapping.gaussians import PlaceEstimate, fused, placed, squared_distance
from semnav_features.mapping.landmark_settings import LandmarkSettings

_CIRCLE_AGREEMENT = 11.34
"""Squared Mahalanobis distance of two circles that may be one: 99 % for three unknowns."""

_FULL_CIRCLE = math.tau - 1e-6
"""Largest extent of an arc, radians; its ends would change places beyond."""


@dataclass(slots=True, eq=False)
class MapCorner:
    """A corner of a map.

    Attributes:
        place: (x, y) in the map, with its covariance.
        arrives: heading of the wall that ends there, radians; None if none was seen.
        leaves: heading of the wall that starts there; None if none was seen.
        sightings: number of scans that showed it.
        born: number of the scan that showed it first.
    """

    place: PlaceEstimate
    arrives: float | None
    leaves: float | None
    sightings: int = 1
    born: int = 0

    @classmethod
    def of(
        cls, seen: CornerSighting, frame: Pose, pose_covariance: FloatArray, born: int = 0
    ) -> MapCorner:
        """A corner that one scan shows, from a pose with the errors of `pose_covariance`."""
        place = placed(seen.place, frame, pose_covariance)
        arrives, leaves = (
            None if h is None else wrap_angle(frame[2] + h) for h in (seen.arrives, seen.leaves)
        )
        return cls(place, arrives, leaves, born=born)

    @property
    def point(self) -> Point:
        """(x, y) in metres."""
        return float(self.place.mean[0]), float(self.place.mean[1])

    @property
    def covariance(self) -> FloatArray:
        """Of `point`, m^2, shape (2, 2)."""
        return self.place.covariance

    @property
    def kind(self) -> CornerKind:
        """Full, inner or outer, as soon as both walls have been seen, if by different scans."""
        return kind_of(self.arrives, self.leaves)

    def is_one_with(self, other: MapCorner, settings: LandmarkSettings, factor: float) -> bool:
        """Whether two may be one corner: a wall that both have, and places that agree."""
        turns = [
            abs(wrap_angle(a - b))
            for a, b in ((self.arrives, other.arrives), (self.leaves, other.leaves))
            if a is not None and b is not None
        ]
        return (
            bool(turns)
            and max(turns) <= settings.heading_tolerance
            and squared_distance(self.place, other.place) <= settings.agreement * factor
        )

    def absorb(self, other: MapCorner) -> None:
        """Fuse another estimate of the same corner."""
        self.place = fused(self.place, other.place)
        weights = self.sightings, other.sightings
        self.arrives = _mean_heading(self.arrives, other.arrives, weights)
        self.leaves = _mean_heading(self.leaves, other.leaves, weights)
        self.sightings += other.sightings
        self.born = min(self.born, other.born)

    def scaled(self, factor: float) -> MapCorner:
        """The same with a covariance that is larger by a factor."""
        return replace(self, place=PlaceEstimate(self.place.mean, factor * self.place.covariance))


def _mean_heading(a: float | None, b: float | None, weights: tuple[int, int]) -> float | None:
    if a is None or b is None:
        return b if a is None else a
    return wrap_angle(a + weights[1] / sum(weights) * wrap_angle(b - a))


@dataclass(slots=True, eq=False)
class MapArc:
    """A column or a curved wall of a map.

    Attributes:
        circle: centre x, y and radius, with their covariance, shape (3, 3).
        convex: whether it was seen from outside.
        parts: seen parts of the circle: start and extent, radians, counter-clockwise.
        beams: number of beams that support it.
        sightings: number of scans that showed it.
        born: number of the scan that showed it first.
    """

    circle: PlaceEstimate
    convex: bool
    parts: list[tuple[float, float]] = field(default_factory=list)
    beams: int = 0
    sightings: int = 1
    born: int = 0

    @classmethod
    def of(
        cls, seen: ArcSighting, frame: Pose, pose_covariance: FloatArray, born: int = 0
    ) -> MapArc:
        """An arc that one scan shows, from a pose with the errors of `pose_covariance`."""
        circle = placed(seen.circle, frame, pose_covariance)
        arc = seen.arc
        first = arc.end if arc.convex else arc.start
        start = wrap_angle(frame[2] + heading_between(arc.centre, first))
        return cls(circle, arc.convex, [(start, arc.extent)], arc.beams, born=born)

    @property
    def centre(self) -> Point:
        """(x, y) in metres."""
        return float(self.circle.mean[0]), float(self.circle.mean[1])

    @property
    def radius(self) -> float:
        """Metres."""
        return float(self.circle.mean[2])

    @property
    def place(self) -> PlaceEstimate:
        """The centre with its covariance, whatever the radius is."""
        return centre_of(self.circle)

    def is_one_with(self, other: MapArc, settings: LandmarkSettings, factor: float) -> bool:
        """Whether two may be one: circles that agree, seen from the same side of them.

        Two columns cannot stand in one place, so a column that is seen from in front and from
        behind is one, though its two arcs do not overlap. Parts of a curved wall that lie apart
        are one if they belong to one circle.
        """
        return (
            self.convex == other.convex
            and squared_distance(self.circle, other.circle) <= _CIRCLE_AGREEMENT * factor
        )

    def absorb(self, other: MapArc) -> None:
        """Fuse another estimate of the same circle, and join the seen parts."""
        self.circle = fused(self.circle, other.circle)
        self.parts = joined([*self.parts, *other.parts])
        self.beams += other.beams
        self.sightings += other.sightings
        self.born = min(self.born, other.born)

    def scaled(self, factor: float) -> MapArc:
        """The same with covariances that are larger by a factor."""
        circle = PlaceEstimate(self.circle.mean, factor * self.circle.covariance)
        return replace(self, circle=circle)

    def as_arc(self) -> Arc:
        """The shortest arc that holds all seen parts."""
        start, extent = hull(self.parts)
        ends = [
            (
                self.centre[0] + self.radius * math.cos(angle),
                self.centre[1] + self.radius * math.sin(angle),
            )
            for angle in (start, start + min(extent, _FULL_CIRCLE))
        ]
        first, last = reversed(ends) if self.convex else ends
        return Arc(self.centre, self.radius, first, last, self.convex, self.beams)


def joined(parts: list[tuple[float, float]]) -> list[tuple[float, float]]:
    """Parts of a circle (start, extent) without overlaps; one part if they cover all of it."""
    done: list[tuple[float, float]] = []
    origin = parts[0][0]
    for start, extent in sorted(((a - origin) % math.tau, e) for a, e in parts):
        if done and start <= sum(done[-1]):
            begin = done[-1][0]
            done[-1] = begin, max(sum(done[-1]), start + extent) - begin
        else:
            done.append((start, extent))
    while len(done) > 1 and sum(done[-1]) >= math.tau + done[0][0]:  # the last reaches the first
        begin, extent = done[-1]
        reached = math.tau + sum(done.pop(0))
        done[-1] = begin, max(begin + extent, reached) - begin
    return [(wrap_angle(origin + a), min(e, math.tau)) for a, e in done]


def hull(parts: list[tuple[float, float]]) -> tuple[float, float]:
    """Start and extent of the shortest arc that holds all parts of a circle."""
    ordered = sorted((a % math.tau, e) for a, e in joined(parts))
    starts = [a for a, _ in ordered]
    gaps = [
        (starts[(k + 1) % len(starts)] - a - e) % math.tau if len(starts) > 1 else math.tau - e
        for k, (a, e) in enumerate(ordered)
    ]
    widest = int(np.argmax(gaps))
    return wrap_angle(starts[(widest + 1) % len(starts)]), math.tau - gaps[widest]
