"""Counts, piece by piece along a line, the beams that end on it and those that pass it."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from semnav_features.frames import FloatArray, Pose
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.segmentation import is_return
from semnav_features.mapping.lines import Line
from semnav_features.scan import Scan

CELL_LENGTH = 0.025
"""Length of a piece, metres."""

_MAX_HIT_DISTANCE = 0.06
"""A beam that ends this near to the line ends on it, metres."""

_PASS_DEPTH, _OPENING_DEPTH = 0.2, 0.3
"""A beam passed a wall, or an opening that a robot is to pass, if it ends this far behind the line,
metres; no robot fits into less than the second."""

_MIN_INCIDENCE_SINE = math.sin(math.radians(12.0))
"""Sine of the angle between beam and line below which a beam does not count."""

_MIN_LINE_DISTANCE = 0.15
"""A scanner nearer to the line than this can tell nothing, metres."""

MAX_BEAM_LENGTH = 8.0
"""Beams count up to this distance, metres."""

Counts = NDArray[np.int32]


@dataclass(slots=True, eq=False)
class LineCells:
    """For each piece of a line, how many scans show that something is there, and how many that not.

    Attributes:
        base: number of the first cell; cell k covers k CELL to (k + 1) CELL along the line.
        seen: in how many scans it was part of an extracted wall, shape (n,).
        hits: in how many a beam ended there, shape (n,).
        passes: in how many a beam went through, shape (n,).
    """

    base: int = 0
    seen: Counts = field(default_factory=lambda: np.zeros(0, np.int32))
    hits: Counts = field(default_factory=lambda: np.zeros(0, np.int32))
    passes: Counts = field(default_factory=lambda: np.zeros(0, np.int32))

    def cover(self, first: float, last: float) -> None:
        """Make room for the stretch from `first` to `last`, metres along the line."""
        low, high = math.floor(first / CELL_LENGTH), math.floor(last / CELL_LENGTH) + 1
        if not len(self.hits):
            self.base = low
        before = max(0, self.base - low)
        after = max(0, high - self.base - len(self.hits))
        if before or after:
            self.seen = np.pad(self.seen, (before, after))
            self.hits = np.pad(self.hits, (before, after))
            self.passes = np.pad(self.passes, (before, after))
            self.base -= before

    def see(self, first: float, last: float) -> None:
        """Count a wall that was extracted from `first` to `last`, metres along the line."""
        self.cover(first, last)
        low, high = round(first / CELL_LENGTH) - self.base, round(last / CELL_LENGTH) - self.base
        self.seen[max(low, 0) : high] += 1

    def add(self, other: LineCells, shift: float) -> None:
        """Add the counts of another line's cells, `shift` metres farther along than these."""
        if not len(other.hits):
            return
        low = other.base + round(shift / CELL_LENGTH)
        self.cover(low * CELL_LENGTH + 1e-9, (low + len(other.hits)) * CELL_LENGTH - 1e-9)
        place = slice(low - self.base, low - self.base + len(other.hits))
        self.seen[place] += other.seen
        self.hits[place] += other.hits
        self.passes[place] += other.passes

    def observe(self, line: Line, scan: Scan, pose: Pose, opening: bool = False) -> None:
        """Count what the beams of a scan from `pose` say of the cells.

        Args:
            line: along which the cells lie, from its point (x, y).
            scan: the scan.
            pose: of the lidar in the frame of the line.
            opening: count for an opening, which is seen from either side, instead of a wall. What
                lies a little behind the line then blocks it, too, and a beam without a return
                passed it.
        """
        limits = scan.range_min, scan.range_max
        angles = scan.angle_min, scan.angle_increment
        place = line.x, line.y, line.heading
        _observe(
            scan.ranges,
            angles,
            limits,
            pose,
            place,
            opening,
            self.base,
            self.hits,
            self.passes,
        )


@kernel
def _observe(
    ranges: FloatArray,
    angles: tuple[float, float],
    limits: tuple[float, float],
    pose: tuple[float, float, float],
    line: tuple[float, float, float],
    opening: bool,
    base: int,
    hits: Counts,
    passes: Counts,
) -> None:
    """Follow the beam nearest to each cell's middle to the line; see `LineCells.observe`."""
    c, s = math.cos(line[2]), math.sin(line[2])
    dx, dy = pose[0] - line[0], pose[1] - line[1]
    along, across = c * dx + s * dy, c * dy - s * dx
    if abs(across) < _MIN_LINE_DISTANCE:
        return
    side = 1.0 if across > 0.0 else -1.0
    deep = _OPENING_DEPTH if opening else _PASS_DEPTH
    for k in range(len(hits)):
        place = (base + k + 0.5) * CELL_LENGTH
        towards = math.atan2(-across, place - along) + line[2] - pose[2] - angles[0]
        towards -= 2.0 * math.pi * math.floor(towards / (2.0 * math.pi))
        beam = int(towards / angles[1] + 0.5)
        if beam >= len(ranges):
            continue
        sine = math.sin(angles[0] + beam * angles[1] + pose[2] - line[2])
        if abs(sine) < _MIN_INCIDENCE_SINE or abs(across) > MAX_BEAM_LENGTH * abs(sine):
            continue
        reach = ranges[beam]
        if not is_return(reach, *limits):
            too_near = reach == -math.inf or 0.0 < reach < limits[0]  # nothing to tell (REP 117)
            passes[k] += opening and not too_near
            continue
        front = side * (across + reach * sine)
        if front < -deep:
            passes[k] += 1
        elif front <= _MAX_HIT_DISTANCE and (
            opening or (side > 0.0 and front >= -_MAX_HIT_DISTANCE)
        ):
            hits[k] += 1
