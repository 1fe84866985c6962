"""From a doorway that somebody marked roughly to the jambs that a map shows there."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import shapely
from shapely import STRtree

from semnav_env.features.frames import FloatArray, Point, Pose, points_to_local, to_parent
from semnav_env.maps.doorways import NARROWEST_ROBOT
from semnav_env.maps.importers.labels import DoorLabel

ALONG = 0.6
"""A jamb lies at most this far beyond the marked one, metres."""

ACROSS = 0.25
"""What is this near to the marked line stands in the doorway, metres."""

JAMB = 0.1
"""How rough the face of a jamb is, metres."""


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
    """The way through a labelled doorway, or the label itself as a closed door.

    Everything solid within `ACROSS` of the marked line, prolonged by `ALONG` at both ends, casts
    its shadow square onto it. The stretch without shadow that the label shares most with lies
    between the jambs, which are the solid points nearest to the line within `JAMB` of its ends; if
    it is narrower than any robot, the door is closed.

    Args:
        label: the label.
        solids: the walls of the map, segments.

    Returns:
        None if the opening has no jamb on one side.
    """
    width = math.dist(label.start, label.end)
    frame = _frame(label)
    pieces = _pieces(frame, width, solids)
    shadows = _joined(pieces[:, :, 0])
    gaps = np.stack((shadows[:-1, 1], shadows[1:, 0]), axis=1)
    shared = np.minimum(gaps[:, 1], width) - np.maximum(gaps[:, 0], 0.0)
    first, last = gaps[np.argmax(shared)] if shared.max(initial=0.0) > 0.0 else (0.0, 0.0)
    if last - first < NARROWEST_ROBOT:
        return Fit(label.start, label.end, False)
    if first <= -ALONG or last >= width + ALONG:
        return None
    start, end = _jamb(pieces, first - JAMB, first), _jamb(pieces, last, last + JAMB)
    return Fit(to_parent(frame, start), to_parent(frame, end), True)


def _frame(label: DoorLabel) -> Pose:
    """The pose at the label's start that looks along it."""
    (x1, y1), (x2, y2) = label.start, label.end
    return x1, y1, math.atan2(y2 - y1, x2 - x1)


def _pieces(frame: Pose, width: float, solids: STRtree) -> FloatArray:
    """Ends of what of the walls is near the label, in its frame, shape (n, 2, 2)."""
    reach = ALONG + width
    near = solids.geometries[solids.query(shapely.Point(frame[:2]), "dwithin", reach + ACROSS)]
    ends = points_to_local(frame, shapely.get_coordinates(near)).reshape(-1, 2, 2)
    band = shapely.box(-ALONG, -ACROSS, reach, ACROSS)
    inside = shapely.intersection(shapely.linestrings(ends), band)
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


def _jamb(pieces: FloatArray, first: float, last: float) -> Point:
    """The solid point nearest to the marked line between two places along it."""
    solid = shapely.multilinestrings(shapely.linestrings(pieces))
    there = solid.intersection(shapely.box(first, -ACROSS, last, ACROSS))
    _, (x, y) = shapely.shortest_line(shapely.LineString(((first, 0.0), (last, 0.0))), there).coords
    return x, y
