"""Data association of lines: finds the known lines that may be the same as a new one."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from semnav_features.frames import FloatArray, Point
from semnav_features.mapping.lines import Line

_METRES_PER_RADIAN = 2.0
"""Difference in distance that counts as much as a radian of difference in direction, metres."""


class LineIndex:
    """A k-d tree over (theta, d), the parameters x cos(theta) + y sin(theta) = d.

    After Weerakoon et al., (10) and section II-E, with d measured from the scanner instead of
    the map's origin: far from the origin a small error of the direction is a large error of d.
    Theta enters as a point on a circle, so that -pi and pi are neighbours.

    Args:
        lines: the lines to search, rows (x, y, heading), shape (n, 3).
        names: the name of each line in the answer, shape (n,).
        origin: point from which d is measured, metres.
    """

    def __init__(self, lines: FloatArray, names: NDArray[np.intp], origin: Point) -> None:
        self._origin = origin
        self._names = names
        self._tree = cKDTree(self._keys(lines)) if len(lines) else None

    def near(self, line: Line, angle: float, offset: float) -> list[int]:
        """Names of the lines that differ by at most an angle and an offset, or little more."""
        if self._tree is None:
            return []
        key = self._keys(np.array([(line.x, line.y, line.heading)]))[0]
        radius = math.hypot(_METRES_PER_RADIAN * angle, offset)
        found = self._tree.query_ball_point(key, radius)
        return sorted(int(self._names[k]) for k in found)

    def _keys(self, lines: FloatArray) -> FloatArray:
        dx, dy = lines[:, 0] - self._origin[0], lines[:, 1] - self._origin[1]
        c, s = np.cos(lines[:, 2]), np.sin(lines[:, 2])
        keys: FloatArray = np.stack(
            (_METRES_PER_RADIAN * c, _METRES_PER_RADIAN * s, c * dy - s * dx), axis=1
        )
        return keys
