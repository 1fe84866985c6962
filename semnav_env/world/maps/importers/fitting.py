"""Finds the jambs that a map shows near a doorway that was marked roughly."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import cast

import numpy as np
import shapely
from shapely import STRtree

from semnav_env.world.maps.doorways import NARROWEST_ROBOT
from semnav_env.world.maps.importers.labels import DoorLabel
from semnav_features.frames import FloatArray, Point, Pose, points_to_local, to_parent

MAX_JAMB_SHIFT = 0.6
"""Largest distance of a jamb beyond the marked one, metres."""

DOORWAY_HALF_DEPTH = 0.25
"""Distance from the marked line within which something stands in the doorway, metres."""

JAMB_ROUGHNESS = 0.1
"""Unevenness of the face of a jamb, metres."""

DISTANCE_TOLERANCE = 1e-6
"""Difference below which two distances are equal, metres: rounding errors."""


@dataclass(frozen=True)
class Fit:
    """A labelled doorway as the map shows it.

    Attributes:
        start: one jamb, (x, y) in metres.
        end: the other jamb.
        open: whether a robot can pass.
    """

    start: Point
    end: Point
    open: bool


def fit_door(label: DoorLabel, solids: STRtree) -> Fit | None:
    """Fit a labelled doorway to the walls: an open door at the gap, else a closed one.

    Of the gaps along the marked line (`Band`) that which the label shares most with is the opening;
    if it is narrower than any robot, the door is closed.

    Args:
        label: the label.
        solids: the walls of the map, segments.

    Returns:
        None if the opening has no jamb on one side.
    """
    band = Band.along(label.start, label.end, solids)
    shared = np.minimum(band.gaps[:, 1], band.length) - np.maximum(band.gaps[:, 0], 0.0)
    if shared.max(initial=0.0) <= 0.0:
        return Fit(label.start, label.end, False)
    gap = band.gaps[np.argmax(shared)]
    if gap[1] - gap[0] < NARROWEST_ROBOT:
        return Fit(label.start, label.end, False)
    return Fit(*band.jambs(gap), True) if band.is_closed(gap) else None


@dataclass(frozen=True, eq=False)
class Band:
    """Everything solid within `DOORWAY_HALF_DEPTH` of a line and its two extensions.

    The line is extended by `MAX_JAMB_SHIFT` at both ends.

    It casts its shadow square onto the line; the stretches without shadow are gaps.

    Attributes:
        frame: pose at the line's start that looks along it.
        length: length of the line, metres.
        pieces: the solid segments in that frame, shape (n, 2, 2).
        gaps: where along the line each begins and ends, shape (m, 2), the first from minus
            infinity on, the last to infinity.
    """

    frame: Pose
    length: float
    pieces: FloatArray
    gaps: FloatArray

    @classmethod
    def along(cls, start: Point, end: Point, solids: STRtree) -> Band:
        """The band along a line.

        Args:
            start: (x, y) in metres.
            end: likewise.
            solids: the walls, segments.
        """
        (x1, y1), (x2, y2) = start, end
        frame, length = (x1, y1, math.atan2(y2 - y1, x2 - x1)), math.dist(start, end)
        pieces = _pieces(frame, length, solids)
        shadows = _joined(pieces[:, :, 0])
        gaps = np.stack((shadows[:-1, 1], shadows[1:, 0]), axis=1)
        return cls(frame, length, pieces, gaps)

    def is_closed(self, gap: FloatArray) -> bool:
        """Whether a gap ends at something solid on both sides."""
        return bool(gap[0] > -MAX_JAMB_SHIFT and gap[1] < self.length + MAX_JAMB_SHIFT)

    def jambs(self, gap: FloatArray) -> tuple[Point, Point]:
        """The two jambs of a gap: on each side the solid point nearest to the line.

        Of several as near, as those of a wall that runs along the line, that at the gap.
        """
        first, last = gap.tolist()
        start = _jamb(self.pieces, first, first - JAMB_ROUGHNESS)
        end = _jamb(self.pieces, last, last + JAMB_ROUGHNESS)
        return to_parent(self.frame, start), to_parent(self.frame, end)


def _pieces(frame: Pose, width: float, solids: STRtree) -> FloatArray:
    """Ends of the pieces of walls near the label, in its frame, shape (n, 2, 2)."""
    reach = MAX_JAMB_SHIFT + width
    near = solids.geometries[
        solids.query(shapely.Point(frame[:2]), "dwithin", reach + DOORWAY_HALF_DEPTH)
    ]
    ends = points_to_local(frame, shapely.get_coordinates(near)).reshape(-1, 2, 2)
    band = shapely.box(-MAX_JAMB_SHIFT, -DOORWAY_HALF_DEPTH, reach, DOORWAY_HALF_DEPTH)
    inside = shapely.intersection(np.asarray(shapely.linestrings(ends)), band)
    lines = inside[shapely.get_type_id(inside) == shapely.GeometryType.LINESTRING]
    lines = lines[~shapely.is_empty(lines)]
    return np.asarray(shapely.get_coordinates(lines).reshape(-1, 2, 2))


def _joined(intervals: FloatArray) -> FloatArray:
    """The union of intervals, and an empty one at either end of everything, shape (m, 2)."""
    far = np.array(((-np.inf, -np.inf), (np.inf, np.inf)))
    rows = np.concatenate((np.sort(intervals, axis=1), far))
    rows = rows[np.argsort(rows[:, 0])]
    reach = np.maximum.accumulate(rows[:, 1])
    begins = np.flatnonzero(np.append(True, rows[1:, 0] > reach[:-1]))
    return np.stack((rows[begins, 0], reach[np.append(begins[1:] - 1, len(rows) - 1)]), axis=1)


def _jamb(pieces: FloatArray, edge: float, far: float) -> Point:
    """The solid point nearest to the marked line between the edge of a gap and a place beyond."""
    first, last = sorted((edge, far))
    lines = np.asarray(shapely.linestrings(pieces))
    solid = cast(shapely.MultiLineString, shapely.multilinestrings(lines))
    there = solid.intersection(shapely.box(first, -DOORWAY_HALF_DEPTH, last, DOORWAY_HALF_DEPTH))
    away = there.distance(shapely.LineString(((first, 0.0), (last, 0.0)))) + DISTANCE_TOLERANCE
    nearest = there.intersection(shapely.box(first, -away, last, away))
    x, y = min(shapely.get_coordinates(nearest).tolist(), key=lambda point: abs(point[0] - edge))
    return x, y
