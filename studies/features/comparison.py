"""One scene against its truth: what was found, what was missed, what is wrong."""

from __future__ import annotations

import math
from collections.abc import Sequence

from semnav_features.scan import Scan
from semnav_features.scene import Door, Scene, Wall
from studies.doors.door_sightings import View, matches
from studies.features.overlap import Overlap
from studies.features.places import compare_arcs, compare_corners, compare_corridors
from studies.features.records import (
    NAN,
    CountingLimits,
    Detection,
    FeatureKind,
    Rows,
    Sighting,
    middle,
    polar,
)


def compare(scan: Scan, truth: Scene, found: Scene, limits: CountingLimits) -> Rows:
    """What became of every true feature of a scan, and what every detected one is.

    A true feature that is not in good view is no demand, but finding it is right.

    Args:
        scan: what was measured.
        truth: what is in view, lidar frame.
        found: what an extractor made of the scan, lidar frame.
        limits: what is in good view, and what counts as found.
    """
    parts = (
        compare_walls(truth, found, limits),
        compare_doors(scan, truth.doors, found.doors, limits),
        compare_corners(truth, found, limits, full=True),
        compare_corners(truth, found, limits, full=False),
        compare_corridors(truth.corridors, found.corridors, limits),
        compare_arcs(truth.arcs, found.arcs, limits),
    )
    return [s for part in parts for s in part[0]], [d for part in parts for d in part[1]]


def compare_walls(truth: Scene, found: Scene, limits: CountingLimits) -> Rows:
    """A wall is found if detected walls cover enough of it, and right the other way round."""
    walls = [wall for wall in truth.walls if limits.shows(wall)]
    overlap, back = Overlap(walls, found.walls), Overlap(found.walls, truth.walls)
    sightings = []
    covers = zip(overlap.covered.tolist(), overlap.longest.tolist(), strict=True)
    for k, (wall, (covered, longest)) in enumerate(zip(walls, covers, strict=True)):
        is_found = covered >= limits.share * wall.length
        angle, place = _wall_errors(wall, found.walls[overlap.best(k)]) if is_found else (NAN, NAN)
        where = polar(middle(wall.start, wall.end))
        lengths = (wall.length, covered, longest)
        gated = limits.shows_well(wall)
        sightings.append(
            Sighting(FeatureKind.WALL, *where, gated, is_found, angle, place, NAN, NAN, *lengths)
        )
    right = (back.covered >= limits.share * back.lengths).tolist()
    detections = [
        Detection(FeatureKind.WALL, *polar(middle(wall.start, wall.end)), is_right)
        for wall, is_right in zip(found.walls, right, strict=True)
    ]
    return sightings, detections


def _wall_errors(wall: Wall, found: Wall) -> tuple[float, float]:
    angle = abs(math.remainder(wall.heading - found.heading, math.tau))
    return angle, (math.dist(wall.start, found.start) + math.dist(wall.end, found.end)) / 2.0


def compare_doors(
    scan: Scan, truth: Sequence[Door], found: Sequence[Door], limits: CountingLimits
) -> Rows:
    """Doors by the gate; detections within its reach count."""
    reach = limits.door.reach
    near = [d for d in found if max(math.hypot(*d.start), math.hypot(*d.end)) <= reach]
    sightings = []
    for door in truth:
        view = limits.door.view(scan, door.start, door.end)
        if view is View.HIDDEN:
            continue
        hits = [_door_errors(door, d) for d in near if matches(d, door.start, door.end)]
        place, size = min(hits, default=(NAN, NAN))
        gated = view is View.GATED
        where = polar(door.midpoint)
        sightings.append(Sighting(FeatureKind.DOOR, *where, gated, bool(hits), NAN, place, size))
    detections = [
        Detection(
            FeatureKind.DOOR,
            *polar(door.midpoint),
            any(matches(door, true.start, true.end) for true in truth),
            door.confidence,
        )
        for door in near
    ]
    return sightings, detections


def _door_errors(door: Door, found: Door) -> tuple[float, float]:
    place = (math.dist(door.start, found.start) + math.dist(door.end, found.end)) / 2.0
    return place, abs(door.width - found.width)
