"""Evidence of a cloud for each strip of a wall line: solid, or seen through."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, TypeAlias

import numpy as np
from numpy.typing import NDArray

from semnav_features.checked_fields import Bounds, Length, check_fields
from semnav_features.frames import FloatArray

Indices: TypeAlias = NDArray[np.intp]


Size: TypeAlias = Annotated[float, Bounds(0.001, 100.0, "m")]


@dataclass(frozen=True)
class StripRules:
    """Settings for the count of strips of a wall.

    Attributes:
        strip: width of a strip, metres.
        level: height of the cells that a strip is made of, metres.
        band: largest distance of a point on the wall from its line, metres: half the depth of a
            frame, and the errors of near points.
        beyond: least distance of a point behind the line that was seen through it, metres.
        doubt: as in `Strips`.
        high: height up to which cells count, metres: below a lintel.
    """

    strip: Size = 0.02
    level: Size = 0.05
    band: Length = 0.09
    beyond: Length = 0.15
    doubt: Annotated[float, Bounds(0.0, 1e6)] = 4.0
    high: Length = 1.9

    def __post_init__(self) -> None:
        check_fields(self)


@dataclass(frozen=True)
class Strips:
    """Evidence along a wall line.

    Attributes:
        left: left edge of the first strip, metres along the line.
        size: width of a strip, metres.
        solid: cells with points on the wall, shape (n,).
        open: cells that were seen through, shape (n,).
        doubt: cells that are added to a count, so that few cells say little.
    """

    left: float
    size: float
    solid: FloatArray
    open: FloatArray
    doubt: float

    def balance(self, first: Indices, stop: Indices) -> FloatArray:
        """Solidity of parts of the wall: (solid - open) / (solid + open + doubt), from -1 to 1.

        Args:
            first: strip with which each stretch begins.
            stop: strip before which it ends.
        """
        difference = self._sums(self.solid - self.open, first, stop)
        return difference / (self._sums(self.solid + self.open, first, stop) + self.doubt)

    def mean_balance(self, first: Indices, stop: Indices) -> FloatArray:
        """The mean over the strips of a part of the wall: 0 if nothing is known of it."""
        each = (self.solid - self.open) / (self.solid + self.open + self.doubt)
        return self._sums(each, first, stop) / (stop - first)

    @staticmethod
    def _sums(values: FloatArray, first: Indices, stop: Indices) -> FloatArray:
        total = np.r_[0.0, np.cumsum(values)]
        return np.asarray(total[stop] - total[first])


def strips_along(
    points: FloatArray, origins: FloatArray, reach: float, rules: StripRules = StripRules()
) -> Strips:
    """Count the cells of each strip.

    Args:
        points: x along the line, y across it, z up, metres, shape (n, 3).
        origins: where the cameras were, the same frame, shape (n, 3).
        reach: how far to either side of the origin, metres.
        rules: sizes.
    """
    count = math.ceil(2.0 * reach / rules.strip)
    left = -0.5 * count * rules.strip
    on = (np.abs(points[:, 1]) <= rules.band) & (points[:, 2] >= 2.0 * rules.level)
    through = (points[:, 1] * np.sign(origins[:, 1]) < -rules.beyond) & (
        np.abs(origins[:, 1]) > rules.level
    )
    a, b = origins[through], points[through]
    share = a[:, 1] / (a[:, 1] - b[:, 1])
    crossing = a + share[:, None] * (b - a)
    solid, seen_through = (_cells(each, left, count, rules) for each in (points[on], crossing))
    return Strips(left, rules.strip, solid, seen_through, rules.doubt)


def _cells(points: FloatArray, left: float, count: int, rules: StripRules) -> FloatArray:
    """Number of cells of each strip that have points in them."""
    levels = round(rules.high / rules.level)
    strip = np.floor((points[:, 0] - left) / rules.strip)
    level = np.floor(points[:, 2] / rules.level)
    inside = (strip >= 0) & (strip < count) & (level >= 0) & (level < levels)
    filled = np.zeros((count, levels), dtype=bool)
    filled[strip[inside].astype(np.intp), level[inside].astype(np.intp)] = True
    return np.asarray(filled.sum(axis=1), dtype=np.float64)
