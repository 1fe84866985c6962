"""The places of the cells of a grid."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from semnav_features.frames import FloatArray, Point


@dataclass(frozen=True)
class Grid:
    """Cells in rows, each known by its middle: row 0 is the southernmost, column 0 the westernmost.

    Attributes:
        west: x of the first column, metres.
        south: y of the first row, metres.
        spacing: distance between neighbouring cells of a row or a column, metres.
        rows: how many.
        columns: how many.
    """

    west: float
    south: float
    spacing: float
    rows: int
    columns: int

    @classmethod
    def over(
        cls, lower: Point, upper: Point, spacing: float, before: int = 0, after: int = 1
    ) -> Grid:
        """The grid over a rectangle.

        Args:
            lower: its lower left corner, (x, y) in metres.
            upper: its upper right corner.
            spacing: of the cells, metres.
            before: rows and columns below and left of it.
            after: rows and columns above and right of it; 1 for the cells on its far sides.
        """
        (west, south), (east, north) = lower, upper
        rows, columns = (
            math.ceil(length / spacing) + before + after for length in (north - south, east - west)
        )
        return cls(west - before * spacing, south - before * spacing, spacing, rows, columns)

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns."""
        return self.rows, self.columns

    @property
    def frame(self) -> tuple[float, float, float]:
        """West, south and spacing, as the kernels take them."""
        return self.west, self.south, self.spacing

    @property
    def x(self) -> FloatArray:
        """Where the columns lie, metres, shape (columns,)."""
        return np.asarray(self.west + self.spacing * np.arange(self.columns), np.float64)

    @property
    def y(self) -> FloatArray:
        """Where the rows lie, metres, shape (rows,)."""
        return np.asarray(self.south + self.spacing * np.arange(self.rows), np.float64)

    def points(self, cells: NDArray[np.int64]) -> FloatArray:
        """The middles of cells (row, column), metres, shape (n, 2)."""
        points: FloatArray = np.array((self.west, self.south)) + self.spacing * cells[:, ::-1]
        return points

    def cell(self, point: Point) -> tuple[int, int]:
        """The cell (row, column) of a point, the nearest one inside the grid."""
        column = round((point[0] - self.west) / self.spacing)
        row = round((point[1] - self.south) / self.spacing)
        return min(max(row, 0), self.rows - 1), min(max(column, 0), self.columns - 1)

    def cells(self, x: FloatArray, y: FloatArray) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """Rows and columns of points, the nearest ones inside the grid; arrays of one shape."""
        column = np.rint((x - self.west) / self.spacing).astype(np.intp)
        row = np.rint((y - self.south) / self.spacing).astype(np.intp)
        return row.clip(0, self.rows - 1), column.clip(0, self.columns - 1)
