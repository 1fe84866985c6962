"""The exact outline of what a lidar sees, by an angular sweep over wall segments.

Between two neighbouring directions in which a segment begins or ends, two segments cross, or a
segment leaves the lidar's range, the same segment is nearest. So one ray between each two of
these directions tells the whole outline exactly.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray

from semnav_features.frames import FloatArray
from semnav_features.lidar_spec import LidarSpec

SAME_DIRECTION_ANGLE = 1e-7
"""Directions closer together than this are one, radians."""

END_SNAP = 1e-9
"""A point of a segment this close to its end is the end, metres."""

NO_OWNER = -1
"""Owner of a direction without a return."""


@dataclass(frozen=True, eq=False)
class Outline:
    """Stretches in beam order, each on one segment or without a return, lidar frame.

    Attributes:
        angles: where each begins and where the last one ends, radians, shape (n + 1,).
        owners: row of the segment that is seen, or `NO_OWNER`, shape (n,).
        starts: first point of each, metres, shape (n, 2); NaN where nothing is seen.
        ends: last point of each, shape (n, 2).
        full: the sweep is a full circle, so the last stretch is followed by the first.
    """

    angles: FloatArray
    owners: NDArray[np.intp]
    starts: FloatArray
    ends: FloatArray
    full: bool

    def ranges(self, angles: FloatArray) -> FloatArray:
        """How far one sees in these directions, metres, shape (k,).

        Infinite without a return, zero outside of the lidar's field of view.
        """
        turned = (
            self.angles[0]
            + (angles - self.angles[0] + SAME_DIRECTION_ANGLE) % math.tau
            - SAME_DIRECTION_ANGLE
        )
        outside = turned > self.angles[-1] + SAME_DIRECTION_ANGLE
        places = np.searchsorted(self.angles[1:-1], turned, side="right")
        stretches = np.concatenate((self.starts[places], self.ends[places]), axis=1)
        a, along = stretches[:, :2], stretches[:, 2:] - stretches[:, :2]
        facing = np.cos(angles) * along[:, 1] - np.sin(angles) * along[:, 0]
        distances = (a[:, 0] * along[:, 1] - a[:, 1] * along[:, 0]) / facing
        distances = np.where(self.owners[places] == NO_OWNER, np.inf, distances)
        return np.where(outside, 0.0, distances)


def crossings(segments: FloatArray) -> FloatArray:
    """Where segments, shape (n, 4), cross or touch one another: points, shape (m, 2)."""
    lines = np.asarray(shapely.linestrings(segments.reshape(-1, 2, 2)))
    a, b = shapely.STRtree(lines).query(lines, predicate="intersects")
    meeting = shapely.intersection(lines[a[a < b]], lines[b[a < b]])
    return np.asarray(shapely.get_coordinates(meeting), dtype=np.float64)


def sweep(segments: FloatArray, marks: FloatArray, spec: LidarSpec, begin: float) -> Outline:
    """The outline that a lidar at the origin sees.

    Args:
        segments: what stops beams, lidar frame, metres, shape (n, 4).
        marks: all points at which another segment may become the nearest, shape (m, 2): ends,
            crossings, and `at_range` of the lidar's limits.
        spec: the lidar; its noise does not matter.
        begin: direction in which the sweep begins, radians; `spec.angle_min` unless the lidar
            sees all around.
    """
    full = sees_all_around(spec)
    span = math.tau if full else (spec.beams - 1) * spec.angle_increment
    edges = _edges(np.arctan2(marks[:, 1], marks[:, 0]) - begin, span)
    middles = begin + 0.5 * (edges[:-1] + edges[1:])
    owners, distances = nearest(segments, middles)
    owners[(distances >= spec.range_max) | (distances < spec.range_min)] = NO_OWNER
    first = np.flatnonzero(np.diff(owners, prepend=NO_OWNER - 1))
    last = np.append(first[1:], len(owners))
    angles, owners = begin + np.append(edges[first], edges[last[-1]]), owners[first]
    starts = points_at(segments, owners, angles[:-1])
    return Outline(angles, owners, starts, points_at(segments, owners, angles[1:]), full)


def sees_all_around(spec: LidarSpec) -> bool:
    """Whether no direction is without a beam."""
    return spec.beams * spec.angle_increment >= math.tau - 1e-6


def nearest(segments: FloatArray, angles: FloatArray) -> tuple[NDArray[np.intp], FloatArray]:
    """The first segment along each ray from the origin, and how far it is.

    Returns:
        Rows, shape (m,), and metres, shape (m,); infinity where there is none.
    """
    if not len(segments):
        return np.full(len(angles), NO_OWNER, dtype=np.intp), np.full(len(angles), np.inf)
    distances = distances_along(segments, angles)
    rows = distances.argmin(axis=1)
    return rows, distances[np.arange(len(angles)), rows]


def distances_along(segments: FloatArray, angles: FloatArray) -> FloatArray:
    """How far along each ray each segment is: metres, shape (m, n); infinity if it is missed."""
    a, along = segments[:, :2], segments[:, 2:] - segments[:, :2]
    cos, sin = np.cos(angles)[:, None], np.sin(angles)[:, None]
    with np.errstate(divide="ignore", invalid="ignore"):
        facing = cos * along[:, 1] - sin * along[:, 0]
        distance = (a[:, 0] * along[:, 1] - a[:, 1] * along[:, 0]) / facing
        place = (a[:, 0] * sin - a[:, 1] * cos) / facing
        met = (distance >= 0.0) & (place >= 0.0) & (place <= 1.0)
    return np.where(met, distance, np.inf)


def points_at(segments: FloatArray, rows: NDArray[np.intp], angles: FloatArray) -> FloatArray:
    """Where rays meet the segments of these rows, shape (k, 2); NaN for `NO_OWNER`."""
    if not len(segments):
        return np.full((len(rows), 2), np.nan)
    a, along = segments[rows, :2], segments[rows, 2:] - segments[rows, :2]
    cos, sin = np.cos(angles), np.sin(angles)
    with np.errstate(divide="ignore", invalid="ignore"):  # the row of `NO_OWNER` is any segment's
        place = (a[:, 0] * sin - a[:, 1] * cos) / (cos * along[:, 1] - sin * along[:, 0])
    snap = END_SNAP / np.hypot(*along.T)
    place = np.where(place < snap, 0.0, np.where(place > 1.0 - snap, 1.0, place))
    points = np.where((place == 1.0)[:, None], segments[rows, 2:], a + place[:, None] * along)
    return np.where((rows == NO_OWNER)[:, None], np.nan, points)


def at_range(segments: FloatArray, limit: float) -> FloatArray:
    """Where segments are `limit` metres from the origin, shape (k, 2)."""
    a, along = segments[:, :2], segments[:, 2:] - segments[:, :2]
    square, middle = (along**2).sum(axis=1), (a * along).sum(axis=1)
    inside = middle**2 - square * ((a**2).sum(axis=1) - limit**2)
    a, along, square, middle = (x[inside > 0.0] for x in (a, along, square, middle))
    root = np.sqrt(inside[inside > 0.0])
    places = np.stack(((-middle - root) / square, (-middle + root) / square))
    points = a + places[..., None] * along
    return np.asarray(points[(places > 0.0) & (places < 1.0)])


def _edges(angles: FloatArray, span: float) -> FloatArray:
    """Sorted distinct directions from 0 to `span`, both included."""
    turned = np.sort(angles % (math.tau))
    turned = turned[(turned > SAME_DIRECTION_ANGLE) & (turned < span - SAME_DIRECTION_ANGLE)]
    kept = turned[np.diff(turned, prepend=0.0) > SAME_DIRECTION_ANGLE]
    return np.concatenate(([0.0], kept, [span]))
