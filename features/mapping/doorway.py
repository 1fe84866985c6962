"""What the beams say of a door's opening: how open it is, and where it begins and ends."""

from __future__ import annotations

import math

import numpy as np

from semnav_env.features.frames import FloatArray, Pose, wrap_angle
from semnav_env.features.mapping.evidence import CELL, Cells
from semnav_env.features.mapping.lines import Line
from semnav_env.features.scan import Scan

_MIDDLE = 0.2
"""Share of the width at either jamb that the question of open or filled leaves out."""

_BESIDE = 0.25
"""Beams are counted so far beyond the jambs, too, metres."""

_JAMB = 1 / 3
"""Where a smaller share of the beams passes a piece belongs to the jamb. On the wall none does;
just inside it, of the beams that go either way, a third or more ends on the reveal or the leaf;
the edge lies halfway."""

_FEWEST = 10
"""From so many looks on the beams say where the jambs are."""

_SHIFT, _TURN = 0.05, math.radians(3.0)
"""Ends that are farther off the line, or turned by more, need to be looked at anew."""


class DoorwayEvidence:
    """The pieces of the line through two jambs, from a little before to a little after them.

    Args:
        ends: both jambs (x1, y1, x2, y2), metres.

    Attributes:
        looks: how many scans looked through it.
    """

    def __init__(self, ends: FloatArray) -> None:
        x1, y1, x2, y2 = ends.tolist()
        width = math.hypot(x2 - x1, y2 - y1)
        self.looks = 0
        self._line = Line(x1, y1, math.atan2(y2 - y1, x2 - x1), 0.0, 0.0)
        self._cells = Cells()
        self._cells.cover(-_BESIDE, width + _BESIDE)
        first, last = (round(share * width / CELL) for share in (_MIDDLE, 1.0 - _MIDDLE))
        self._middle = slice(first - self._cells.base, max(last, first + 1) - self._cells.base)

    def observe(self, scan: Scan, pose: Pose) -> None:
        """Let the beams of a scan say which pieces are open, seen from either side."""
        passes = self._cells.passes[self._middle]
        before = int(passes.sum())
        self._cells.observe(self._line, scan, pose, opening=True)
        self.looks += 2 * (int(passes.sum()) - before) > len(passes)

    @property
    def openness(self) -> float:
        """Share of the beams that came to the opening that went through it, 0 to 1."""
        through = int(self._cells.passes[self._middle].sum())
        filled = int(self._cells.hits[self._middle].sum())
        return through / max(through + filled, 1)

    def lies_along(self, ends: FloatArray) -> bool:
        """Whether two jambs still lie where the beams are counted."""
        x1, y1, x2, y2 = ends.tolist()
        off = max(abs(self._line.across((x, y))) for x, y in ((x1, y1), (x2, y2)))
        turn = wrap_angle(math.atan2(y2 - y1, x2 - x1) - self._line.heading)
        places = self._line.along((x1, y1)), self._line.along((x2, y2))
        last = (self._cells.base + len(self._cells.hits)) * CELL
        beside = min(places[0] - self._cells.base * CELL, last - places[1])
        return off <= _SHIFT and abs(turn) <= _TURN and beside >= 0.5 * _BESIDE

    def bounds(self, ends: FloatArray) -> FloatArray:
        """The jambs moved along the line to where beams begin to pass.

        Many beams tell that better than the ends of walls do, which stop short of the jambs.
        """
        if self.looks < _FEWEST:
            return ends
        counts = self._cells.passes + self._cells.hits
        shares = np.where(counts > 0, self._cells.passes / np.maximum(counts, 1), np.nan)
        centre = (self._middle.start + self._middle.stop) // 2
        steps = -_open_steps(shares[centre::-1]), _open_steps(shares[centre:])
        along = np.array((math.cos(self._line.heading), math.sin(self._line.heading)))
        moved = ends.copy()
        for jamb, step in zip((moved[:2], moved[2:]), steps, strict=True):
            if math.isfinite(step):
                place = (self._cells.base + centre + 0.5 + step) * CELL
                jamb += (place - self._line.along((jamb[0], jamb[1]))) * along
        return moved


def _open_steps(shares: FloatArray) -> float:
    """How many cells it is from the first to where the share falls below that of a jamb.

    Not finite if it is not told: the first is below, or none is, or nothing is known before.
    """
    below = np.flatnonzero(~(shares >= _JAMB))
    if not len(below) or below[0] == 0 or math.isnan(shares[below[0]]):
        return math.inf
    last = int(below[0]) - 1
    return last + float((shares[last] - _JAMB) / (shares[last] - shares[last + 1]))
