"""The robot's map for a search: solid, free, safe and searched cells, odometry frame.

Beams are cast twice, as Visser et al. propose ("Beyond frontier exploration", RoboCup 2007). Up to
a short range they make the floor safe to drive on, and up to a long range they show floor that is
probably free. Floor that is free but not safe lies beyond the frontier, and is the next to explore.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from semnav_agents.searching.outlines import HITS, Mask, cells_near, drawn, outline_points
from semnav_agents.searching.settings import SearchSettings
from semnav_env.world.grid.cells import Grid
from semnav_env.world.maps.cell_budget import check_cells
from semnav_features.frames import FloatArray, Point, Pose
from semnav_features.kernels.compiling import kernel

HIT, MOST_HITS, SOLID = 4, 40, 4
"""What a beam that ends in a cell adds, the most that a cell has, and from what on it is solid. A
beam that passes takes one away."""

GRAZING = 0.3
"""Distance before the end of a beam up to which it counts as passing, metres: walls are grazed."""

FREE, SAFE, LOOKED = 1, 2, 4
"""What a cell was found to be, as bits."""


class SearchMap:
    """A grid in the odometry frame.

    Args:
        settings: of the search.
        lower: its lower left corner, (x, y) in metres.
        upper: its upper right corner.

    Raises:
        FloorPlanError: it would have too many cells.

    Attributes:
        grid: corner and size of the cells.
        hits: evidence that a cell is solid, shape (rows, columns).
        ends: where the beams in a cell ended, `HITS`, same shape.
        found: properties of each cell, bits, same shape.
        tries: how often a cell stayed unseen from a pose that was expected to show it, same shape.
        walls: cells of walls of the plan, same shape; none without a plan.
        rooms: number of the plan's room of each cell, -1 for none, same shape.
    """

    def __init__(self, settings: SearchSettings, lower: Point, upper: Point) -> None:
        self.settings, self.grid = settings, Grid.over(lower, upper, settings.spacing)
        shape = self.grid.shape
        check_cells(math.prod(shape), f"maps of a search in steps of {settings.spacing} m")
        self.hits = np.zeros(shape, np.int64)
        self.ends = np.zeros(shape, HITS)
        self.found = np.zeros(shape, np.uint8)
        self.tries = np.zeros(shape, np.uint8)
        self.walls = np.zeros(shape, np.bool_)
        self.rooms = np.full(shape, -1)

    def add_hits(self, points: FloatArray) -> None:
        """Add points of the outlines of what is solid, shape (n, 2)."""
        cells = self.grid.cells(*points.T)
        x, y = (points - self.grid.points(np.column_stack(cells))).T
        np.add.at(self.ends["count"], cells, 1.0)
        np.add.at(self.ends["x"], cells, x)
        np.add.at(self.ends["y"], cells, y)

    def update(
        self, eye: Pose, directions: FloatArray, ranges: FloatArray, fov: float, view: float
    ) -> None:
        """Add a scan and the view of the detector at the same pose.

        Args:
            eye: believed pose of lidar and detector.
            directions: unit vectors of the beams, shape (n, 2).
            ranges: metres, shape (n,); the lidar's range for no return, NaN for no beam.
            fov: field of view of the detector, radians.
            view: range of the detector, metres.
        """
        s = self.settings
        reaches = (s.short_range, s.long_range, view, math.cos(fov / 2))
        _cast(self.hits, self.ends, self.found, *self.grid.frame, eye, directions, ranges, *reaches)

    @property
    def solid(self) -> Mask:
        """Cells with an obstacle or a wall of the plan."""
        return np.asarray((self.hits >= SOLID) | self.walls)

    def sight(self) -> tuple[Mask, Mask]:
        """The outlines that end lines of sight, and the cells near them; see `outlines`."""
        spacing = self.grid.spacing
        outline = drawn(outline_points(self.ends, self.solid, spacing), spacing)
        return outline, cells_near(outline)

    def solid_at(self, point: Point) -> bool:
        """Whether an obstacle stands at a point."""
        row, column = self.grid.cell(point)
        return bool(self.hits[row, column] >= SOLID or self.walls[row, column])

    def has(self, bits: int) -> Mask:
        """Cells that have a property."""
        return np.asarray((self.found & bits) > 0)


def without_lost(ranges: FloatArray, range_max: float) -> FloatArray:
    """Ranges with NaN for the beams that do not return though a neighbour does.

    Such beams were most likely lost, so the floor along them has not been seen.

    Args:
        ranges: metres, `range_max` for no return, shape (n,).
        range_max: of the lidar, metres.
    """
    none = ranges >= range_max
    beside = np.hstack((True, none[:-1])) & np.hstack((none[1:], True))
    return np.where(none & ~beside, np.nan, ranges)


@kernel
def _cast(
    hits: NDArray[np.int64],
    ends: np.ndarray,
    found: NDArray[np.uint8],
    west: float,
    south: float,
    spacing: float,
    eye: Pose,
    directions: FloatArray,
    ranges: FloatArray,
    short: float,
    long: float,
    view: float,
    least_cosine: float,
) -> None:
    """Traverse each beam cell by cell; note the cells that it passes and the cell of its end."""
    rows, columns = hits.shape
    c, s = math.cos(eye[2]), math.sin(eye[2])
    step = spacing
    for k in range(len(ranges)):
        reach = ranges[k]
        if not reach > 0.0:
            continue
        dx = c * directions[k, 0] - s * directions[k, 1]
        dy = s * directions[k, 0] + c * directions[k, 1]
        looks = directions[k, 0] >= least_cosine
        last_row, last_column = -1, -1
        for i in range(int(min(reach, long) / step)):
            away = i * step
            column = round((eye[0] + away * dx - west) / spacing)
            row = round((eye[1] + away * dy - south) / spacing)
            if not (0 <= row < rows and 0 <= column < columns):
                break
            found[row, column] |= FREE
            if away < short:
                found[row, column] |= SAFE
            if looks and away < view:
                found[row, column] |= LOOKED
            moved = row != last_row or column != last_column
            if moved and away < reach - GRAZING and hits[row, column] > 0:
                hits[row, column] -= 1
            last_row, last_column = row, column
        if reach < long:
            column = round((eye[0] + reach * dx - west) / spacing)
            row = round((eye[1] + reach * dy - south) / spacing)
            if 0 <= row < rows and 0 <= column < columns:
                hits[row, column] = min(hits[row, column] + HIT, MOST_HITS)
                ends[row, column].count += 1.0
                ends[row, column].x += eye[0] + reach * dx - west - spacing * column
                ends[row, column].y += eye[1] + reach * dy - south - spacing * row
