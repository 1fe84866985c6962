"""Thin outlines of what beams hit, for lines of sight that pass close to it.

Hits scatter by some centimetres, so that the cells in which beams ended are a band that is thicker
than what stands there, and gaps between two pieces of furniture look closed. As in a normal
distributions transform (Biber and Strasser 2003) each cell keeps where its hits lie on average.
With the hits around it this gives a point of the outline, and points of neighbouring cells are
joined by lines.
"""

from __future__ import annotations

import math
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from semnav_features.frames import FloatArray
from semnav_features.kernels.compiling import kernel

Mask: TypeAlias = NDArray[np.bool_]
"""Some cells of a grid, shape (rows, columns)."""

HITS = np.dtype([("count", "f8"), ("x", "f8"), ("y", "f8")])
"""The beams that ended in a cell: their number, and the sums of x and y from its middle, metres."""

FINER = 4
"""Cells of an outline in a cell of the map, along each side: 1.25 cm."""

NOISE = 0.02
"""Standard deviation of a hit, metres: that of the lidar (SICK TiM561 data sheet)."""

JOINED = 0.08
"""Largest distance between the points of neighbouring cells that are of one outline, metres: they
are 0.05 to 0.07 m apart along a wall. A narrower gap between two things is taken for closed. With
0.10 m a gap of 0.13 m was closed."""


@kernel
def outline_points(hits: np.ndarray, solid: Mask, spacing: float) -> FloatArray:
    """A point of the outline for each solid cell: the mean of its hits, freed from noise.

    Wiener's filter: with the covariance C of the cells around it, the mean m of the hits in a cell
    is drawn towards the mean M of these cells, to M + (I - N C^-1) (m - M), where N is the
    covariance of the noise. So a cell before a wall is drawn onto it, and not along it. Cells
    weigh as the root of the number of their hits: with the number itself, what was looked at for
    long draws away what stands beside it, and leaves a hole.

    Args:
        hits: of each cell, `HITS`, shape (rows, columns).
        solid: cells that count, same shape; one without hits counts as one hit in its middle.
        spacing: of the cells, metres.

    Returns:
        x and y, in cells from the middle of the first one, shape (rows, columns, 2).
    """
    rows, columns = solid.shape
    points = np.full((rows, columns, 2), np.nan)
    for row in range(rows):
        for column in range(columns):
            if solid[row, column]:
                x, y = _freed_from_noise(hits, solid, row, column, spacing)
                points[row, column, 0], points[row, column, 1] = column + x, row + y
    return points


@kernel
def _freed_from_noise(
    hits: np.ndarray, solid: Mask, row: int, column: int, spacing: float
) -> tuple[float, float]:
    """The point of one cell, in cells from its middle; see `outline_points`."""
    rows, columns = solid.shape
    own_x, own_y = _mean_of(hits, row, column, spacing)
    n, x, y, xx, xy, yy = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(max(row - 1, 0), min(row + 2, rows)):
        for j in range(max(column - 1, 0), min(column + 2, columns)):
            if solid[i, j]:
                count, (u, v) = math.sqrt(max(hits[i, j].count, 1.0)), _mean_of(hits, i, j, spacing)
                u, v = u + j - column, v + i - row
                n, x, y = n + count, x + count * u, y + count * v
                xx, xy, yy = xx + count * u * u, xy + count * u * v, yy + count * v * v
    x, y = x / n, y / n
    xx, xy, yy = xx / n - x * x, xy / n - x * y, yy / n - y * y
    angle = 0.5 * math.atan2(2.0 * xy, xx - yy)  # of the larger eigenvalue of C
    half, middle = math.hypot(0.5 * (xx - yy), xy), 0.5 * (xx + yy)
    c, s, noise = math.cos(angle), math.sin(angle), (NOISE / spacing) ** 2
    along = (c * (own_x - x) + s * (own_y - y)) * _kept(middle + half, noise)
    across = (c * (own_y - y) - s * (own_x - x)) * _kept(middle - half, noise)
    return x + c * along - s * across, y + s * along + c * across


@kernel
def _mean_of(hits: np.ndarray, row: int, column: int, spacing: float) -> tuple[float, float]:
    """Mean of the hits of a cell, in cells from its middle."""
    count = max(hits[row, column].count, 1.0)
    return hits[row, column].x / count / spacing, hits[row, column].y / count / spacing


@kernel
def _kept(variance: float, noise: float) -> float:
    """The share of a distance from the mean that is no noise, along an axis of the covariance."""
    return max(0.0, 1.0 - noise / max(variance, 1e-9))


@kernel
def drawn(points: FloatArray, spacing: float) -> Mask:
    """Draw the outlines: a line between the points of each two neighbouring cells.

    Args:
        points: of the solid cells, see `outline_points`.
        spacing: of the cells, metres.

    Returns:
        The cells of an outline, three of them thick so that no ray slips through, shape
        (`FINER` rows, `FINER` columns).
    """
    rows, columns = points.shape[:2]
    outline = np.zeros((FINER * rows, FINER * columns), np.bool_)
    for row in range(rows):
        for column in range(columns):
            if math.isnan(points[row, column, 0]):
                continue
            here = points[row, column]
            _draw_line(outline, here, here)
            for i, j in ((0, 1), (1, -1), (1, 0), (1, 1)):
                if not (row + i < rows and 0 <= column + j < columns):
                    continue
                other = points[row + i, column + j]
                if math.hypot(other[0] - here[0], other[1] - here[1]) * spacing <= JOINED:
                    _draw_line(outline, here, other)
    return outline


@kernel
def _draw_line(outline: Mask, start: FloatArray, end: FloatArray) -> None:
    """Draw a line, ends in cells of the map; each cell of the outline with its four neighbours."""
    rows, columns = outline.shape
    steps = int(2 * FINER * math.hypot(end[0] - start[0], end[1] - start[1])) + 1
    for k in range(steps + 1):
        column = int((start[0] + (end[0] - start[0]) * k / steps + 0.5) * FINER)
        row = int((start[1] + (end[1] - start[1]) * k / steps + 0.5) * FINER)
        for i, j in ((0, 0), (0, 1), (0, -1), (1, 0), (-1, 0)):
            if 0 <= row + i < rows and 0 <= column + j < columns:
                outline[row + i, column + j] = True


@kernel
def cells_near(outline: Mask) -> Mask:
    """The cells of the map with an outline in them or in a neighbour, shape (rows, columns)."""
    rows, columns = outline.shape[0] // FINER, outline.shape[1] // FINER
    near = np.zeros((rows, columns), np.bool_)
    for row in range(FINER * rows):
        for column in range(FINER * columns):
            if outline[row, column]:
                i, j = row // FINER, column // FINER
                near[max(i - 1, 0) : i + 2, max(j - 1, 0) : j + 2] = True
    return near


@kernel
def crossed(outline: Mask, x: float, y: float, dx: float, dy: float) -> bool:
    """Whether a ray meets an outline, or leaves the map, within one cell of the map.

    Args:
        outline: its cells, see `drawn`.
        x: where the ray is, in cells of the map from the middle of the first one.
        y: the same along the rows.
        dx: unit vector of the ray.
        dy: the same along the rows.
    """
    rows, columns = outline.shape
    for k in range(FINER):
        column, row = int(FINER * (x + 0.5) + k * dx), int(FINER * (y + 0.5) + k * dy)
        if not (0 <= row < rows and 0 <= column < columns) or outline[row, column]:
            return True
    return False
