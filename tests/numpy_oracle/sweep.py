"""The beams of a scan: which returned, and where they ended."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from semnav_features.frames import FloatArray
from semnav_features.scan import Scan
from semnav_features.settings import ExtractorSettings
from tests.numpy_oracle.breakpoints import threshold


@dataclass(frozen=True, eq=False)
class Sweep:
    """At most one full turn of a scan, or a full circle unrolled twice over.

    Attributes:
        ranges: metres, shape (n,).
        directions: unit vectors of the beams, shape (n, 2).
        returned: which beams have a usable return, shape (n,).
        increment: angle between beams, radians.
        angle_min: direction of beam 0, radians.
        turn: how many beams a circle has that is unrolled; else 0.
    """

    ranges: FloatArray
    directions: FloatArray
    returned: NDArray[np.bool_]
    increment: float
    angle_min: float
    turn: int = 0

    @classmethod
    def of(cls, scan: Scan, settings: ExtractorSettings) -> Sweep:
        """The usable part of a scan; a range beyond `rupture_range` is no return (2.1)."""
        turn = 2.0 * math.pi / scan.angle_increment * (1.0 + 1e-9) + 1.0
        ranges = scan.ranges[: int(min(turn, len(scan.ranges)))]
        angles = scan.angle_min + scan.angle_increment * np.arange(len(ranges))
        directions = np.stack((np.cos(angles), np.sin(angles)), axis=1)
        returned = scan.valid[: len(ranges)] & (ranges > 0.0) & (ranges < settings.rupture_range)
        return cls(ranges, directions, returned, scan.angle_increment, scan.angle_min)

    @property
    def is_ring(self) -> bool:
        """Whether the first beam comes after the last one."""
        return self.turn > 0

    def points(self, beams: list[int]) -> FloatArray:
        """Where beams ended (1.2), shape (k, 2)."""
        return self.ranges[beams, None] * self.directions[beams]

    def connected_groups(self, settings: ExtractorSettings) -> list[list[int]]:
        """Beams that returned, cut at ruptures and adaptive breakpoints."""
        groups: list[list[int]] = []
        for beam in map(int, np.flatnonzero(self.returned[: self.turn or None])):
            if groups and self._joined(groups[-1][-1], beam, settings):
                groups[-1].append(beam)
            else:
                groups.append([beam])
        return groups

    def _joined(self, before: int, beam: int, settings: ExtractorSettings) -> bool:
        step = beam - before
        if step > settings.dropout_beams + 1:
            return False
        ranges = float(self.ranges[before]), float(self.ranges[beam])
        reach = threshold(*ranges, step * self.increment, settings)
        if step > 1:
            reach = min(reach, settings.merge_gap)
        first, second = self.points([before, beam])
        return bool(np.linalg.norm(second - first) <= reach)
