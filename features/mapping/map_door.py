"""A door of the map: what its sightings agree on, and whether its opening stayed open."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from semnav_env.features.elements import Door, Wall
from semnav_env.features.frames import FloatArray, Point, Pose
from semnav_env.features.mapping.evidence import Cells
from semnav_env.features.mapping.lines import Line
from semnav_env.features.scan import Scan

_MIDDLE = 0.2
"""Share of the width at either jamb that the question of open or filled leaves out."""

_SNAP_ALONG, _SNAP_ACROSS = 0.15, 0.1
"""So near to a jamb a wall's end along the door's line is taken for the jamb, metres."""

_IN_LINE = math.cos(math.radians(12.0))
"""So well in line with the door is a wall that ends at its jamb."""


@dataclass(slots=True, eq=False)
class MapDoor:
    """A door that was seen in several scans.

    Attributes:
        seen: both jambs of every sighting, rows (x1, y1, x2, y2) in metres, in one direction.
        ends: the median of the sightings.
        through: how many pieces of its opening beams went through, over all scans.
        filled: on how many they ended.
        looks: how many scans looked through the opening.
    """

    seen: list[FloatArray]
    ends: FloatArray = field(init=False)
    through: int = 0
    filled: int = 0
    looks: int = 0

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
        heading = math.atan2(y2 - y1, x2 - x1)
        left = (x2 - x1) * (pose[1] - y1) > (y2 - y1) * (pose[0] - x1)
        line = Line(x1, y1, heading, 0, 0) if left else Line(x2, y2, heading + math.pi, 0, 0)
        cells = Cells()
        cells.cover(_MIDDLE * width, (1.0 - _MIDDLE) * width)
        cells.observe(line, scan, pose)
        through, filled = int(cells.passes.sum()), int(cells.hits.sum())
        self.through += through
        self.filled += filled
        self.looks += 2 * through > len(cells.hits)

    @property
    def openness(self) -> float:
        """Share of what beams told of the opening that they went through it, 0 to 1."""
        return self.through / max(self.through + self.filled, 1)

    def as_door(self, walls: Sequence[Wall]) -> Door:
        """The door of a scene, its jambs at the ends of the map's walls where those are near."""
        x1, y1, x2, y2 = self.ends.tolist()
        start = _jamb((x1, y1), (x2, y2), walls) or (x1, y1)
        end = _jamb((x2, y2), (x1, y1), walls) or (x2, y2)
        share = min(1.0, len(self.seen) / max(self.looks, 1))
        return Door(start, end, sightings=len(self.seen), confidence=share * self.openness)


def _jamb(jamb: Point, across: Point, walls: Sequence[Wall]) -> Point | None:
    """The nearest end of a wall that runs on from a jamb in the door's line, if one is near."""
    width = math.dist(jamb, across)
    ux, uy = (jamb[0] - across[0]) / width, (jamb[1] - across[1]) / width
    best, nearest = None, _SNAP_ALONG
    for wall in walls:
        for end, other in ((wall.start, wall.end), (wall.end, wall.start)):
            dx, dy = end[0] - jamb[0], end[1] - jamb[1]
            along = abs(dx * ux + dy * uy)
            if along >= nearest or abs(dy * ux - dx * uy) > _SNAP_ACROSS:
                continue
            runs_on = (other[0] - end[0]) * ux + (other[1] - end[1]) * uy
            if runs_on > _IN_LINE * wall.length:
                best, nearest = end, along
    return best
