"""Estimates from beams how open a doorway is, and where its jambs are."""

from __future__ import annotations

import math

import numpy as np

from semnav_features.frames import FloatArray, Pose, wrap_angle
from semnav_features.mapping.line_cells import CELL_LENGTH, LineCells
from semnav_features.mapping.lines import Line
from semnav_features.scan import Scan

_JAMB_SHARE = 0.2
"""Share of the width at either jamb that does not count for whether the doorway is open."""

_JAMB_MARGIN = 0.25
"""Length beyond each jamb on which beams are counted as well, metres."""

_JAMB_PASS_SHARE = 1 / 3
"""Share of passing beams at which a jamb is taken to lie.

On the wall no beam passes. Just inside the jamb, of the beams that go either way, a third or more
ends on the reveal or the leaf; the edge lies halfway."""

_MIN_LOOKS = 10
"""Least number of scans through the doorway before beams determine the jambs."""

_MAX_SHIFT, _MAX_ROTATION = 0.05, math.radians(3.0)
"""Largest offset of the jambs from the line, metres, and largest rotation of the door, radians,
before beams are counted from zero again."""


class DoorwayEvidence:
    """Counts of the beams that reach the line through two jambs, a little beyond both jambs.

    Args:
        ends: both jambs (x1, y1, x2, y2), metres.

    Attributes:
        looks: number of scans that saw through it.
    """

    def __init__(self, ends: FloatArray) -> None:
        x1, y1, x2, y2 = ends.tolist()
        width = math.hypot(x2 - x1, y2 - y1)
        self.looks = 0
        self._line = Line(x1, y1, math.atan2(y2 - y1, x2 - x1), 0.0, 0.0)
        self._cells = LineCells()
        self._cells.cover(-_JAMB_MARGIN, width + _JAMB_MARGIN)
        first, last = (
            round(share * width / CELL_LENGTH) for share in (_JAMB_SHARE, 1.0 - _JAMB_SHARE)
        )
        self._middle = slice(first - self._cells.base, max(last, first + 1) - self._cells.base)

    def observe(self, scan: Scan, pose: Pose) -> None:
        """Count the beams of a scan that pass or end in each cell, seen from either side."""
        passes = self._cells.passes[self._middle]
        before = int(passes.sum())
        self._cells.observe(self._line, scan, pose, opening=True)
        self.looks += 2 * (int(passes.sum()) - before) > len(passes)

    @property
    def openness(self) -> float:
        """Share of the beams at the opening that passed through it, 0 to 1."""
        through = int(self._cells.passes[self._middle].sum())
        filled = int(self._cells.hits[self._middle].sum())
        return through / max(through + filled, 1)

    def lies_along(self, ends: FloatArray) -> bool:
        """Whether two jambs still lie where the beams are counted."""
        x1, y1, x2, y2 = ends.tolist()
        off = max(abs(self._line.across((x, y))) for x, y in ((x1, y1), (x2, y2)))
        heading_change = wrap_angle(math.atan2(y2 - y1, x2 - x1) - self._line.heading)
        places = self._line.along((x1, y1)), self._line.along((x2, y2))
        last = (self._cells.base + len(self._cells.hits)) * CELL_LENGTH
        beside = min(places[0] - self._cells.base * CELL_LENGTH, last - places[1])
        return (
            off <= _MAX_SHIFT
            and abs(heading_change) <= _MAX_ROTATION
            and beside >= 0.5 * _JAMB_MARGIN
        )

    def bounds(self, ends: FloatArray) -> FloatArray:
        """The jambs moved along the line to where beams begin to pass.

        Many beams determine this better than the ends of walls, which stop short of the jambs.
        """
        if self.looks < _MIN_LOOKS:
            return ends
        counts = self._cells.passes + self._cells.hits
        shares = np.where(counts > 0, self._cells.passes / np.maximum(counts, 1), np.nan)
        centre = (self._middle.start + self._middle.stop) // 2
        steps = -_open_steps(shares[centre::-1]), _open_steps(shares[centre:])
        along = np.array((math.cos(self._line.heading), math.sin(self._line.heading)))
        moved = ends.copy()
        for jamb, step in zip((moved[:2], moved[2:]), steps, strict=True):
            if math.isfinite(step):
                place = (self._cells.base + centre + 0.5 + step) * CELL_LENGTH
                jamb += (place - self._line.along((jamb[0], jamb[1]))) * along
        return moved


def _open_steps(shares: FloatArray) -> float:
    """Number of cells, with a fraction, from the first to where the share falls to that of a jamb.

    Infinite where that is unknown: the first is below already, none is, or one has no counts.
    """
    below = np.flatnonzero(~(shares >= _JAMB_PASS_SHARE))
    if not len(below) or below[0] == 0 or math.isnan(shares[below[0]]):
        return math.inf
    last = int(below[0]) - 1
    return last + float((shares[last] - _JAMB_PASS_SHARE) / (shares[last] - shares[last + 1]))
