"""Corners, corridors and arcs of a scan against the truth, each by the place of one point."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import TypeVar

import numpy as np

from semnav_features.frames import Point
from semnav_features.scene import Arc, Corner, CornerKind, CorridorProbe, Scene, Wall
from studies.features.records import (
    NAN,
    CountingLimits,
    Detection,
    FeatureKind,
    Rows,
    Sighting,
    polar,
)

T = TypeVar("T", Corner, CorridorProbe, Arc)

MAX_CORNER_GAP = 0.02
"""A true wall with an end this close to a true corner is one of its walls, metres."""


def compare_corners(truth: Scene, found: Scene, limits: CountingLimits, full: bool) -> Rows:
    """Full corners (inner and outer) or potential ones, each found once.

    A corner is in good view if all its walls are.
    """
    kind = FeatureKind.FULL_CORNER if full else FeatureKind.POTENTIAL_CORNER
    wanted = [c for c in truth.corners if (c.kind is not CornerKind.POTENTIAL) is full]
    given = [c for c in found.corners if (c.kind is not CornerKind.POTENTIAL) is full]
    pairs = _pairs(wanted, given, lambda corner: corner.point, limits.point)
    sightings = []
    for k, corner in enumerate(wanted):
        gated = _is_clear_corner(corner, truth.walls, limits)
        place, type_right = NAN, NAN
        if k in pairs:
            match = given[pairs[k]]
            place, type_right = (
                math.dist(corner.point, match.point),
                float(match.kind is corner.kind),
            )
        numbers = (NAN, place, NAN, type_right)
        sightings.append(Sighting(kind, *polar(corner.point), gated, k in pairs, *numbers))
    return sightings, _detections(kind, given, lambda corner: corner.point, pairs)


def _is_clear_corner(corner: Corner, walls: Sequence[Wall], limits: CountingLimits) -> bool:
    ends = [(wall, end) for wall in walls for end in (wall.start, wall.end)]
    near = [wall for wall, end in ends if math.dist(end, corner.point) < MAX_CORNER_GAP]
    return all(limits.shows_well(wall) for wall in near)


def compare_corridors(
    truth: Sequence[CorridorProbe], found: Sequence[CorridorProbe], limits: CountingLimits
) -> Rows:
    """Corridors by their midpoints, each found once; all are in good view."""
    pairs = _pairs(truth, found, lambda corridor: corridor.midpoint, limits.midpoint)
    sightings = [
        Sighting(
            FeatureKind.CORRIDOR,
            *polar(corridor.midpoint),
            True,
            k in pairs,
            place=math.dist(corridor.midpoint, found[pairs[k]].midpoint) if k in pairs else NAN,
        )
        for k, corridor in enumerate(truth)
    ]
    return sightings, _detections(FeatureKind.CORRIDOR, found, lambda each: each.midpoint, pairs)


def compare_arcs(truth: Sequence[Arc], found: Sequence[Arc], limits: CountingLimits) -> Rows:
    """Arcs by their centres, each found once."""
    pairs = _pairs(truth, found, lambda arc: arc.centre, limits.centre)
    sightings = []
    for k, arc in enumerate(truth):
        place = size = NAN
        if k in pairs:
            match = found[pairs[k]]
            place = math.dist(arc.centre, match.centre)
            size = abs(match.radius - arc.radius) / arc.radius
        gated = limits.shows_well(arc)
        sightings.append(
            Sighting(FeatureKind.ARC, *polar(arc.centre), gated, k in pairs, NAN, place, size)
        )
    return sightings, _detections(FeatureKind.ARC, found, lambda arc: arc.centre, pairs)


def _detections(
    kind: FeatureKind, found: Sequence[T], place: Callable[[T], Point], pairs: dict[int, int]
) -> list[Detection]:
    right = set(pairs.values())
    return [Detection(kind, *polar(place(item)), k in right) for k, item in enumerate(found)]


def _pairs(
    truth: Sequence[T], found: Sequence[T], place: Callable[[T], Point], tolerance: float
) -> dict[int, int]:
    """Which found feature is which true one: the nearest pairs first, each feature once."""
    if not truth or not found:
        return {}
    a, b = (np.array([place(item) for item in items]) for items in (truth, found))
    distances = np.hypot(*(a[:, None] - b[None]).transpose(2, 0, 1))
    rows, columns = np.nonzero(distances <= tolerance)
    pairs: dict[int, int] = {}
    taken: set[int] = set()
    for k in np.argsort(distances[rows, columns], kind="stable").tolist():
        row, column = int(rows[k]), int(columns[k])
        if row not in pairs and column not in taken:
            pairs[row] = column
            taken.add(column)
    return pairs
