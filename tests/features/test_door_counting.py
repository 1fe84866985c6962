"""Which doors a corridor counts."""

from __future__ import annotations

import math

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from semnav_features.frames import FloatArray, Point, Pose, middle_of, to_local, wrap_angle
from semnav_features.kernels.corridor_survey import PROBE_COUNT
from semnav_features.kernels.door_counting import (
    AHEAD,
    COUNTED,
    LEFT,
    PROBE_SPACING,
    PROBED_BEHIND,
    RIGHT,
    SIDE_SAMPLES,
    count_doors,
)

SIDE_OFFSET, END_OFFSET = 0.4, 0.6

places = st.tuples(st.floats(-4, 12), st.floats(-3, 3))
ends = st.tuples(places, st.floats(-1, 1), st.floats(-1, 1))
"""A jamb, and from there to the other one, metres."""

poses = st.tuples(st.floats(-9, 9), st.floats(-9, 9), st.floats(-4, 4))


def plainly_counted(
    start: Point, end: Point, width: float, corridor_end: float, sides: FloatArray
) -> tuple[float, int, float] | None:
    """Along, side and outward heading of a door in the frame of the axis; None if left out."""
    along, offset = middle_of(start, end)
    if along < 0.0:
        return None
    normal = math.atan2(end[0] - start[0], -(end[1] - start[1]))
    if abs(end[0] - start[0]) < abs(end[1] - start[1]):
        ends_it = abs(along - corridor_end) <= END_OFFSET and abs(offset) <= width
        side, towards = AHEAD, 0.0
    else:
        side = LEFT if offset > 0 else RIGHT
        towards = math.copysign(math.pi / 2, offset)
        ends_it = any(_meets(sides[side], start, end, share) for share in SIDE_SAMPLES)
    if not ends_it:
        return None
    return along, side, normal + math.pi if math.cos(normal - towards) < 0 else normal


def _meets(side: FloatArray, start: Point, end: Point, share: float) -> bool:
    along, offset = (a + share * (b - a) for a, b in zip(start, end, strict=True))
    probe = round((along + PROBED_BEHIND) / PROBE_SPACING)
    return 0 <= probe < len(side) and abs(side[probe] - abs(offset)) < SIDE_OFFSET


@given(
    doors=st.lists(ends, max_size=8),
    frame=poses,
    width=st.floats(0.5, 3),
    end=st.floats(1, 12) | st.just(math.inf),
    gap=st.integers(0, PROBE_COUNT),
)
def test_doors_count_as_plain_geometry_says(
    doors: list[tuple[Point, float, float]], frame: Pose, width: float, end: float, gap: int
) -> None:
    given_ends = [(x, y, x + dx, y + dy) for (x, y), dx, dy in doors]
    sides = np.full((2, PROBE_COUNT), width)
    sides[:, gap : gap + 20] = np.inf
    array = np.array(given_ends, np.float64).reshape(-1, 4)
    counted = np.empty(len(array), COUNTED)
    limits = SIDE_OFFSET, END_OFFSET
    count = count_doors(array, frame, width, end, sides[0], sides[1], *limits, counted)
    found = counted[:count].tolist()
    expected = []
    for k, (x1, y1, x2, y2) in enumerate(given_ends):
        start, last = to_local(frame, (x1, y1)), to_local(frame, (x2, y2))
        told = plainly_counted(start, last, width, end, sides)
        if told is not None:
            along, side, normal = told
            expected.append((along, k, side, wrap_angle(frame[2] + normal)))
    assert found == expected
