"""The robot's own map for a search: what is solid, free, safe, and looked at; odometry frame.

Beams are cast twice, as Visser et al. propose ("Beyond frontier exploration", RoboCup 2007): up to
a short range they make the floor safe to drive on, and up to a long one they show floor that is
probably free. What is free but not safe lies beyond the frontier, and is where to go and look.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from semnav_agents.searching.settings import SearchSettings
from semnav_env.world.grid.cells import Grid
from semnav_env.world.maps.cell_budget import check_cells
from semnav_features.frames import FloatArray, Point, Pose
from semnav_features.kernels.compiling import kernel

Mask = NDArray[np.bool_]

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
        grid: where the cells lie.
        hits: evidence that a cell is solid, shape (rows, columns).
        found: what cells were found to be, bits, same shape.
        tries: how often a look did not show what it was expected to, same shape.
        walls: cells of walls that the plan tells of, same shape; none without a plan.
        rooms: number of the plan's room of each cell, -1 for none, same shape.
    """

    def __init__(self, settings: SearchSettings, lower: Point, upper: Point) -> None:
        self.settings, self.grid = settings, Grid.over(lower, upper, settings.spacing)
        shape = self.grid.shape
        check_cells(math.prod(shape), f"maps of a search in steps of {settings.spacing} m")
        self.hits = np.zeros(shape, np.int64)
        self.found = np.zeros(shape, np.uint8)
        self.tries = np.zeros(shape, np.uint8)
        self.walls = np.zeros(shape, np.bool_)
        self.rooms = np.full(shape, -1)

    def update(
        self, eye: Pose, directions: FloatArray, ranges: FloatArray, fov: float, view: float
    ) -> None:
        """Take in a scan, with which the detector looks as well.

        Args:
            eye: believed pose of lidar and detector.
            directions: unit vectors of the beams, shape (n, 2).
            ranges: metres, shape (n,); the lidar's range for no return, NaN for no beam.
            fov: field of view of the detector, radians.
            view: range of the detector, metres.
        """
        s = self.settings
        reaches = (s.short_range, s.long_range, view, math.cos(fov / 2))
        _cast(self.hits, self.found, *self.grid.frame, eye, directions, ranges, *reaches)

    @property
    def solid(self) -> Mask:
        """Where something stands, or the plan has a wall."""
        return np.asarray((self.hits >= SOLID) | self.walls)

    def solid_at(self, point: Point) -> bool:
        """Whether something stands at a point."""
        row, column = self.grid.cell(point)
        return bool(self.hits[row, column] >= SOLID or self.walls[row, column])

    def has(self, bits: int) -> Mask:
        """Where cells were found to be that."""
        return np.asarray((self.found & bits) > 0)


def without_lost(ranges: FloatArray, range_max: float) -> FloatArray:
    """Ranges with NaN for the beams that do not return though a neighbour does.

    Most likely they got lost: what they would have passed has not been seen.

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
    """Walk along each beam cell by cell, and note what it passes and where it ends."""
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
