"""What the beams say of a stretch of line, piece by piece: something is there, or nothing is."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from numba import njit
from numpy.typing import NDArray

from semnav_env.features.frames import FloatArray, Pose
from semnav_env.features.mapping.lines import Line
from semnav_env.features.scan import Scan

CELL = 0.025
"""Length of a piece, metres."""

_ON = 0.06
"""A beam that ends this near to the line ends on it, metres."""

_THROUGH = 0.2
"""A beam that ends this far behind the line went through it, metres."""

_FLATTEST = math.sin(math.radians(12.0))
"""Sine of the flattest incidence at which a beam counts."""

_NEAREST = 0.15
"""From nearer to the line than this nothing can be told, metres."""

REACH = 8.0
"""Beams count up to this distance, metres."""

Counts = NDArray[np.int32]


@dataclass(slots=True, eq=False)
class Cells:
    """Per piece of a line, how many scans had a beam end there, and how many one go through.

    Attributes:
        base: number of the first cell; cell k covers k CELL to (k + 1) CELL along the line.
        hits: shape (n,).
        passes: shape (n,).
    """

    base: int = 0
    hits: Counts = field(default_factory=lambda: np.zeros(0, np.int32))
    passes: Counts = field(default_factory=lambda: np.zeros(0, np.int32))

    def cover(self, first: float, last: float) -> None:
        """Make room for the stretch from `first` to `last`, metres along the line."""
        low, high = math.floor(first / CELL), math.floor(last / CELL) + 1
        if not len(self.hits):
            self.base = low
        before = max(0, self.base - low)
        after = max(0, high - self.base - len(self.hits))
        if before or after:
            self.hits = np.pad(self.hits, (before, after))
            self.passes = np.pad(self.passes, (before, after))
            self.base -= before

    def add(self, other: Cells, shift: float) -> None:
        """Add the counts of another line's cells, `shift` metres farther along than these."""
        if not len(other.hits):
            return
        low = other.base + round(shift / CELL)
        self.cover(low * CELL + 1e-9, (low + len(other.hits)) * CELL - 1e-9)
        place = slice(low - self.base, low - self.base + len(other.hits))
        self.hits[place] += other.hits
        self.passes[place] += other.passes

    def observe(self, line: Line, scan: Scan, pose: Pose) -> int:
        """Count what a scan from `pose` says of the cells; returns of how many it says anything.

        Args:
            line: along which the cells lie, from its point (x, y).
            scan: the scan.
            pose: of the lidar in the frame of the line.
        """
        limits = scan.range_min, min(scan.range_max, REACH)
        angles = scan.angle_min, scan.angle_increment
        place = line.x, line.y, line.heading
        return int(
            _observe(scan.ranges, angles, limits, pose, place, self.base, self.hits, self.passes)
        )


@njit(cache=True, error_model="numpy")
def _observe(
    ranges: FloatArray,
    angles: tuple[float, float],
    limits: tuple[float, float],
    pose: tuple[float, float, float],
    line: tuple[float, float, float],
    base: int,
    hits: Counts,
    passes: Counts,
) -> int:
    """Follow the beam nearest to each cell's middle to the line; see `Cells.observe`."""
    c, s = math.cos(line[2]), math.sin(line[2])
    dx, dy = pose[0] - line[0], pose[1] - line[1]
    along, across = c * dx + s * dy, c * dy - s * dx
    if abs(across) < _NEAREST:
        return 0
    side = 1.0 if across > 0.0 else -1.0
    told = 0
    for k in range(len(hits)):
        place = (base + k + 0.5) * CELL
        towards = math.atan2(-across, place - along) + line[2] - pose[2] - angles[0]
        towards -= 2.0 * math.pi * math.floor(towards / (2.0 * math.pi))
        beam = int(towards / angles[1] + 0.5)
        if beam >= len(ranges) or not limits[0] <= ranges[beam] < 1e9:
            continue
        sine = math.sin(angles[0] + beam * angles[1] + pose[2] - line[2])
        if abs(sine) < _FLATTEST or abs(across) > limits[1] * abs(sine):
            continue
        front = side * (across + min(ranges[beam], 1e3) * sine)
        if abs(front) <= _ON and side > 0.0:
            hits[k] += 1
            told += 1
        elif front < -_THROUGH:
            passes[k] += 1
            told += 1
    return told
