"""Hypothesis strategies: scans of every kind, rooms, and corridors with openings."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from semnav_features import Scan
from semnav_features.frames import FloatArray, Point, Pose
from tests.support.raycaster import polyline

awkward_ranges = st.one_of(
    st.floats(0.05, 12.0),
    st.sampled_from([math.nan, math.inf, -math.inf, 0.0, -1.0, 1e-300, 10.0, 0.05]),
)


@st.composite
def awkward_scans(draw: st.DrawFn) -> Scan:
    """Scans of 1 to 80 beams with anything in them, at any spacing."""
    ranges = draw(hnp.arrays(np.float64, st.integers(1, 80), elements=awkward_ranges))
    increment = draw(st.one_of(st.floats(0.002, 0.2), st.sampled_from([1e-9, 1.0, 3.2, 7.0])))
    increment = min(increment, 4.0 * math.pi / len(ranges)) * draw(st.sampled_from([1, -1]))
    return Scan(ranges, draw(st.floats(-7.0, 7.0)), increment)


@dataclass(frozen=True)
class Room:
    """A rectangle with its lower left corner at the origin, and a scanner at `pose` in it."""

    width: float
    height: float
    pose: Pose

    @property
    def corners(self) -> list[Point]:
        """Counter-clockwise from the origin."""
        return [(0.0, 0.0), (self.width, 0.0), (self.width, self.height), (0.0, self.height)]

    @property
    def segments(self) -> FloatArray:
        """The four walls, shape (4, 2, 2)."""
        return polyline(*self.corners, self.corners[0])


@st.composite
def rooms(draw: st.DrawFn) -> Room:
    """Rooms of 2.4 to 6 m, the scanner a metre or more from every wall."""
    width, height = draw(st.floats(2.4, 6.0)), draw(st.floats(2.4, 6.0))
    x, y = draw(st.floats(1.0, width - 1.0)), draw(st.floats(1.0, height - 1.0))
    return Room(width, height, (x, y, draw(st.floats(-math.pi, math.pi))))


@dataclass(frozen=True)
class Opening:
    """A corridor along x with one opening of `width` in its right wall, starting at x = 0.

    Behind it is a room, `wider` than the opening by so much on either side; the wall between is
    0.1 m thick. A room that is no wider is a side corridor.

    The scanner is at `pose`, looking along the corridor.
    """

    corridor: float
    width: float
    pose: Pose
    wider: float = 1.0

    @property
    def segments(self) -> FloatArray:
        """Walls of the corridor and of what lies behind the opening, shape (n, 2, 2)."""
        right = -self.corridor / 2
        inside, behind, low, high = right - 0.1, right - 4.0, -self.wider, self.width + self.wider
        return np.concatenate(
            (
                polyline((-6.0, right), (0.0, right), (0.0, inside), (low, inside), (low, behind)),
                polyline((low, behind), (high, behind), (high, inside)),
                polyline((high, inside), (self.width, inside), (self.width, right), (6.0, right)),
                polyline((6.0, right), (6.0, -right), (-6.0, -right), (-6.0, right)),
            )
        )

    @property
    def jambs(self) -> tuple[Point, Point]:
        """Start and end of the opening with the corridor on its left."""
        return (0.0, -self.corridor / 2), (self.width, -self.corridor / 2)


@st.composite
def openings(draw: st.DrawFn, narrowest: float, widest: float) -> Opening:
    """Openings seen from 0.5 to 1.5 m before them."""
    corridor, width = draw(st.floats(1.6, 2.6)), draw(st.floats(narrowest, widest))
    sideways = draw(st.floats(0.5 - corridor / 2, corridor / 2 - 0.5))
    pose = draw(st.floats(-1.5, -0.5)), sideways, draw(st.floats(-0.4, 0.4))
    return Opening(corridor, width, pose)
