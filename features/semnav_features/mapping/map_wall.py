"""A wall of a map: a line that was seen many times, with its solid cells."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from semnav_features.elements import Wall
from semnav_features.frames import Point, Pose
from semnav_features.mapping.line_cells import CELL_LENGTH, LineCells
from semnav_features.mapping.lines import Line, fuse
from semnav_features.scan import Scan

Stretch = tuple[float, float]
"""Begin and end of a segment along a line, metres."""


@dataclass(slots=True, eq=False)
class MapWall:
    """A wall that grows with every scan that shows it.

    Attributes:
        line: its line; places along it are counted from its point.
        extent: seen extent along its line.
        born: number of the scan that showed it first.
        sightings: number of scans that showed it.
        cells: evidence of beams, cell by cell.
    """

    line: Line
    extent: Stretch
    born: int = 0
    sightings: int = 1
    cells: LineCells = field(default_factory=LineCells)

    @classmethod
    def of(cls, line: Line, start: Point, end: Point, born: int = 0) -> MapWall:
        """A wall that was seen once."""
        wall = cls(line, (line.along(start), line.along(end)), born)
        wall.cells.see(*wall.extent)
        return wall

    def stretch_of(self, other: MapWall) -> Stretch:
        """The extent of another wall along this one's line."""
        ends = [self.line.along(other.line.point(place)) for place in other.extent]
        return min(ends), max(ends)

    def absorb(self, other: MapWall) -> None:
        """Join another wall: fuse the lines and join the extents.

        In all four cases of Weerakoon et al., figure 5: the other lies inside this one and adds
        nothing to its length, extends its start, extends its end, or extends both.

        Args:
            other: seen along the same line.
        """
        reach = self.stretch_of(other)
        reach = min(reach[0], self.extent[0]), max(reach[1], self.extent[1])
        line = fuse(self.line, other.line)
        self.cells.add(other.cells, self.line.along((other.line.x, other.line.y)))
        # Places are counted from the line's point, which the fusion has moved along.
        shift = self.line.along((line.x, line.y))
        whole = round(shift / CELL_LENGTH) * CELL_LENGTH
        x, y = line.point(whole - shift)
        self.line = Line(x, y, line.heading, line.offset_variance, line.angle_variance)
        self.cells.base -= round(shift / CELL_LENGTH)
        self.extent = reach[0] - whole, reach[1] - whole
        self.cells.cover(*self.extent)
        self.born = min(self.born, other.born)
        self.sightings += other.sightings

    def observe(self, scan: Scan, pose: Pose) -> None:
        """Count the beams of a scan that end on or pass through each cell of the wall."""
        self.cells.observe(self.line, scan, pose)

    def solid(self, fewest: int, share: float, widest_gap: float) -> list[Stretch]:
        """The existing segments of the wall.

        Args:
            fewest: least number of scans in which a piece was there.
            share: least share of the scans whose beams ended on a piece that showed it as part of
                a wall.
            widest_gap: length up to which missing pieces are bridged that no beam passed, metres;
                of pieces that beams passed at most two are bridged.
        """
        cells = self.cells
        support = np.maximum(cells.hits, cells.seen)
        there = (support >= fewest) & (support > cells.passes) & (cells.seen >= share * cells.hits)
        seen_through = (cells.passes >= fewest) & (cells.passes >= support)
        joined: list[tuple[int, int]] = []
        for first, stop in _runs(there):
            if joined:
                hole = slice(joined[-1][1], first)
                length = first - joined[-1][1]
                limit = 2 if seen_through[hole].any() else widest_gap / CELL_LENGTH
                if length <= limit:
                    joined[-1] = (joined[-1][0], stop)
                    continue
            joined.append((first, stop))
        return [self._stretch(first, stop) for first, stop in joined]

    def _stretch(self, first: int, stop: int) -> Stretch:
        """Cells as places; the outermost end where the wall was last seen to end."""
        low, high = (self.cells.base + first) * CELL_LENGTH, (self.cells.base + stop) * CELL_LENGTH
        return max(low, float(self.extent[0])), min(high, float(self.extent[1]))

    def as_wall(self, stretch: Stretch) -> Wall:
        """A stretch of it as a wall of a scene."""
        middle = self.line.point(0.0)
        return Wall(
            self.line.point(stretch[0]),
            self.line.point(stretch[1]),
            beams=int(self.cells.hits.sum()),
            angle_deviation=math.sqrt(self.line.angle_variance),
            offset_deviation=math.sqrt(self.line.offset_variance),
            centroid=middle,
        )


def _runs(mask: np.ndarray) -> list[tuple[int, int]]:
    """Begin and end of each run of True."""
    edges = np.flatnonzero(np.diff(np.concatenate(([0], mask.view(np.int8), [0]))))
    return [(int(a), int(b)) for a, b in edges.reshape(-1, 2)]
