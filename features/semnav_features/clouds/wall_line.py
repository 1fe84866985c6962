"""The upright plane through both jambs, as a line on the floor plan."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from semnav_features.clouds.voxels import voxel_grid
from semnav_features.frames import FloatArray, Pose


@dataclass(frozen=True)
class LineSearch:
    """Limits of the search for the wall line, in the frame of the expected door.

    Attributes:
        turn: largest angle to the expected line, radians.
        turn_sigma: standard deviation of that angle, radians: of the believed heading.
        turn_step: between the angles that are tried, radians.
        offset: largest distance from the expected middle, besides three sigmas, metres.
        cell: width of the strips that are counted, metres.
        band: largest distance of the points that the line is fitted to, metres.
        lines: number of lines that are tried.
    """

    turn: float = 0.3
    turn_sigma: float = 0.1
    turn_step: float = 0.03
    offset: float = 0.10
    cell: float = 0.03
    band: float = 0.07
    lines: int = 5


@dataclass(frozen=True)
class WallLine:
    """A line t = offset + slope s in the frame of the expected door.

    Attributes:
        offset: metres, at s = 0.
        slope: no unit.
        covariance: of (offset, slope), shape (2, 2).
        support: share of the voxels near the door that lie on it.
    """

    offset: float
    slope: float
    covariance: FloatArray
    support: float

    @property
    def frame(self) -> Pose:
        """Its frame in that of the expected door: x along the line."""
        return 0.0, self.offset, math.atan(self.slope)


def wall_lines(
    points: FloatArray, sigma: float, search: LineSearch = LineSearch()
) -> list[WallLine]:
    """The lines with the most upright surface on them, near the expected one, best first.

    A Hough transform over angles and offsets, which needs no random draws, then total least
    squares over the points in the band. Voxels vote, so that what is near does not count more;
    Gaussians weight angles and offsets by how well the door's place is known.

    Args:
        points: frame of the expected door, above the floor, metres, shape (n, 3).
        sigma: standard deviation of the door's place, metres.
        search: limits.

    Returns:
        At most `search.lines`; none where fewer than ten voxels lie on any line.
    """
    voxels = voxel_grid(points)
    if len(voxels) < _LEAST_VOXELS:
        return []
    angles = np.arange(-search.turn, search.turn + 1e-9, search.turn_step)
    reach = search.offset + 3.0 * sigma
    edges = np.arange(-reach, reach + search.cell, search.cell)
    across = np.cos(angles) * voxels[:, 1:2] - np.sin(angles) * voxels[:, :1]
    votes = np.array([np.histogram(column, edges)[0] for column in across.T], dtype=np.float64)
    middles = edges[:-1] + 0.5 * search.cell
    votes *= np.exp(-0.5 * (middles / (sigma + search.offset)) ** 2)
    votes *= np.exp(-0.5 * (angles[:, None] / search.turn_sigma) ** 2)
    found = []
    for _ in range(search.lines):
        angle, offset = np.unravel_index(votes.argmax(), votes.shape)
        line = _fitted(voxels, math.tan(angles[angle]), middles[offset], search)
        if line is not None:
            found.append(line)
        taken = max(angle - 2, 0), max(offset - 2, 0)
        votes[taken[0] : angle + 3, taken[1] : offset + 3] = 0.0
    return found


_LEAST_VOXELS = 10
"""Fewest voxels that make a line."""


def _fitted(voxels: FloatArray, slope: float, offset: float, search: LineSearch) -> WallLine | None:
    """Total least squares, done again with the points in the band of each result."""
    near = voxels[:0, :2]
    values = centre = np.zeros(2)
    for _ in range(3):
        away = (voxels[:, 1] - offset - slope * voxels[:, 0]) / math.hypot(1.0, slope)
        near = voxels[np.abs(away) <= search.band, :2]
        if len(near) < _LEAST_VOXELS:
            return None
        centre = near.mean(axis=0)
        values, vectors = np.linalg.eigh(np.cov(near.T))
        along = vectors[:, 1]
        if abs(along[0]) < math.cos(search.turn + 0.1):
            return None
        slope = float(along[1] / along[0])
        offset = float(centre[1] - slope * centre[0])
    # The variance of a voxel across the line, over how many there are and how far they reach.
    variances = values[0] / len(near) * np.array([1.0, 1.0 / values[1]])
    jacobian = np.array([[1.0, -centre[0]], [0.0, 1.0]])
    spread = np.asarray(jacobian @ np.diag(variances) @ jacobian.T, dtype=np.float64)
    return WallLine(offset, slope, spread, len(near) / len(voxels))
