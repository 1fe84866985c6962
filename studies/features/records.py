"""What is noted of every true and every detected feature of a scan."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, field
from enum import IntEnum
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from semnav_features.frames import Point
from semnav_features.scene import Arc, Wall
from studies.doors.door_sightings import Gate

NAN = math.nan


class FeatureKind(IntEnum):
    """What is counted."""

    WALL = 0
    DOOR = 1
    FULL_CORNER = 2
    POTENTIAL_CORNER = 3
    CORRIDOR = 4
    ARC = 5

    @property
    def label(self) -> str:
        """In words."""
        return self.name.lower().replace("_", " ") + "s"


class Sighting(NamedTuple):
    """A true feature in one scan, and what became of it. NaN where a number has no meaning.

    Attributes:
        kind: see `FeatureKind`.
        range: of its middle, metres.
        bearing: of its middle, radians.
        gated: it is in good view, see `CountingLimits`.
        found: some detection is it.
        angle: error of a wall's direction, radians.
        place: error in metres of its ends (the mean of both), its point, midpoint or centre.
        size: error of a door's width, metres, or of an arc's radius as a share of it.
        type_right: 1 if a corner is inner or outer as it should be, else 0.
        length: of a wall, metres.
        covered: how much of the wall all detections cover, metres.
        longest: how much of it the longest one covers, metres.
    """

    kind: FeatureKind
    range: float
    bearing: float
    gated: bool
    found: bool
    angle: float = NAN
    place: float = NAN
    size: float = NAN
    type_right: float = NAN
    length: float = NAN
    covered: float = NAN
    longest: float = NAN


class Detection(NamedTuple):
    """A detected feature in one scan.

    Attributes:
        kind: see `FeatureKind`.
        range: of its middle, metres.
        bearing: of its middle, radians.
        right: it is a true one, in good view or not.
        confidence: of a door, 0 to 1; NaN for others.
    """

    kind: FeatureKind
    range: float
    bearing: float
    right: bool
    confidence: float = NAN


@dataclass(frozen=True)
class CountingLimits:
    """When a feature counts as in good view (gated), and what counts as finding it.

    Attributes:
        wall_beams: fewest beams of a wall in good view.
        wall_length: shortest wall in good view, metres.
        wall_beams_seen: fewest beams of a wall that counts as seen at all.
        wall_length_seen: shortest wall that counts as seen at all, metres.
        share: a wall is found if so much of it is covered, and right if so much of it covers.
        door: the gate of doors.
        point: a corner is found within this, metres.
        midpoint: a corridor is found if its midpoint is within this, metres.
        arc_beams: fewest beams of an arc in good view.
        arc_extent: least extent of an arc in good view, radians.
        arc_range: farthest centre of an arc in good view, metres.
        arc_radius: smallest and largest radius of an arc in good view, metres.
        centre: an arc is found if its centre is within this, metres.
    """

    wall_beams: int = 10
    wall_length: float = 0.5
    wall_beams_seen: int = 5
    wall_length_seen: float = 0.2
    share: float = 0.5
    door: Gate = field(default_factory=lambda: Gate(reach=5.0))
    point: float = 0.2
    midpoint: float = 0.3
    arc_beams: int = 8
    arc_extent: float = math.radians(90.0)
    arc_range: float = 4.0
    arc_radius: tuple[float, float] = (0.15, 1.0)
    centre: float = 0.15

    def shows(self, wall: Wall) -> bool:
        """Whether a true wall counts as seen."""
        return wall.beams >= self.wall_beams_seen and wall.length >= self.wall_length_seen

    def shows_well(self, item: Wall | Arc) -> bool:
        """Whether a true wall or arc is in good view."""
        if isinstance(item, Wall):
            return item.beams >= self.wall_beams and item.length >= self.wall_length
        thinnest, thickest = self.arc_radius
        return (
            item.beams >= self.arc_beams
            and item.extent >= self.arc_extent
            and math.hypot(*item.centre) <= self.arc_range
            and thinnest <= item.radius <= thickest
        )


Rows = tuple[list[Sighting], list[Detection]]

_TYPES = {"kind": "i1", "gated": "?", "found": "?", "right": "?"}


def as_table(rows: Iterable[NamedTuple], kind: type[NamedTuple]) -> NDArray[np.void]:
    """Sightings or detections as a structured array with their fields."""
    dtype = np.dtype([(name, _TYPES.get(name, "f8")) for name in kind._fields])
    return np.array([tuple(row) for row in rows], dtype=dtype)


def polar(point: Point) -> tuple[float, float]:
    """Range and bearing of a point."""
    return math.hypot(*point), math.atan2(point[1], point[0])


def middle(start: Point, end: Point) -> Point:
    """The point between two others."""
    return (start[0] + end[0]) / 2.0, (start[1] + end[1]) / 2.0
