"""A door of the map: what its sightings agree on, and whether its opening stayed open."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from semnav_env.features.elements import Door
from semnav_env.features.frames import FloatArray, Pose
from semnav_env.features.mapping.evidence import Cells
from semnav_env.features.mapping.lines import Line
from semnav_env.features.scan import Scan

_MIDDLE = 0.2
"""Share of the width at either jamb that the question of open or filled leaves out."""


@dataclass(slots=True, eq=False)
class MapDoor:
    """A door that was seen in several scans.

    Attributes:
        seen: both jambs of every sighting, rows (x1, y1, x2, y2) in metres, in one direction.
        ends: the median of the sightings.
        looks: how many scans looked through the opening.
        through: how many pieces of it beams went through, over all scans.
        filled: how many they did not get through.
    """

    seen: list[FloatArray]
    ends: FloatArray = field(init=False)
    looks: int = 0
    through: int = 0
    filled: int = 0

    def __post_init__(self) -> None:
        self.ends = np.median(self.seen, axis=0)

    def see(self, door: FloatArray) -> None:
        """Add a sighting."""
        self.seen.append(door)
        self.ends = np.median(self.seen, axis=0)

    def distance(self, door: FloatArray) -> float:
        """How far the jambs of a sighting in the same direction are off, at most, metres."""
        off = door - self.ends
        return max(math.hypot(off[0], off[1]), math.hypot(off[2], off[3]))

    def apart(self, other: MapDoor) -> float:
        """Between the middles of two doors, metres."""
        off = (self.ends[:2] + self.ends[2:] - other.ends[:2] - other.ends[2:]) / 2
        return math.hypot(off[0], off[1])

    def observe(self, scan: Scan, pose: Pose) -> None:
        """Let the beams of a scan say whether the opening is open, seen from either side."""
        x1, y1, x2, y2 = self.ends.tolist()
        width = math.hypot(x2 - x1, y2 - y1)
        cells = Cells()
        cells.cover(_MIDDLE * width, (1.0 - _MIDDLE) * width)
        line = Line(x1, y1, math.atan2(y2 - y1, x2 - x1), 0.0, 0.0)
        cells.observe(line, scan, pose, opening=True)
        through = int(cells.passes.sum())
        self.through += through
        self.filled += int(cells.hits.sum())
        self.looks += 2 * through > len(cells.passes)

    @property
    def openness(self) -> float:
        """Share of the beams that came to the opening that went through it, 0 to 1."""
        return self.through / max(self.through + self.filled, 1)

    def as_door(self) -> Door:
        """The door of a scene."""
        x1, y1, x2, y2 = self.ends.tolist()
        share = min(1.0, len(self.seen) / max(self.looks, 1))
        confidence = share * self.openness
        return Door((x1, y1), (x2, y2), sightings=len(self.seen), confidence=confidence)
