"""The walls of a map of lines: what two lines of one wall tell together."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from semnav_features import Scan, extract
from semnav_features.elements import Wall
from semnav_features.frames import ORIGIN, to_parent
from semnav_features.mapping import LineMap, MapSettings
from semnav_features.mapping.duplicate_walls import without_duplicates
from semnav_features.mapping.line_cells import CELL_LENGTH
from semnav_features.mapping.lines import Line, fuse, gap, line_of
from semnav_features.mapping.map_wall import MapWall

small = st.floats(-0.02, 0.02)
metres = st.floats(-5.0, 5.0)
variances = st.floats(1e-6, 1e-2)
lines = st.builds(Line, small, small, small, variances, variances)
poses = st.tuples(metres, metres, st.floats(-math.pi, math.pi))


@given(lines, lines, metres)
def test_fusing_is_symmetric(a, b, place):
    there, back = fuse(a, b), fuse(b, a)
    point = there.point(place)
    # The two frames are turned by up to 0.04 rad, of which the formula keeps the first order.
    assert abs(back.across(point)) < 0.05 * (1.0 + abs(place))
    assert there.angle_variance == pytest.approx(back.angle_variance, rel=0.1)


@given(lines)
def test_a_line_fused_with_itself_halves_its_covariance(line):
    fused = fuse(line, line)
    assert fused.heading == pytest.approx(line.heading)
    assert abs(line.across((fused.x, fused.y))) < 1e-12
    assert fused.offset_variance == pytest.approx(line.offset_variance / 2)
    assert fused.angle_variance == pytest.approx(line.angle_variance / 2)


@given(lines, lines)
def test_fusing_makes_nothing_less_certain(a, b):
    fused = fuse(a, b)
    assert fused.offset_variance <= min(a.offset_variance, b.offset_variance)
    assert fused.angle_variance <= min(a.angle_variance, b.angle_variance)


def test_two_stretches_fix_a_direction_better_than_one():
    rng = np.random.default_rng(0)
    errors = []
    for _ in range(300):
        (c1, c2), (t1, t2) = rng.normal(0.0, 0.01, 2), rng.normal(0.0, 0.02, 2)
        a, b = Line(0.0, c1, t1, 1e-4, 4e-4), Line(5.0, c2, t2, 1e-4, 4e-4)
        fused = fuse(a, b)
        errors.append((fused.heading, fused.angle_variance))
    heading, variance = np.array(errors).T
    assert np.std(heading) < 0.003
    assert np.mean(heading**2 / variance) == pytest.approx(1.0, abs=0.25)


@given(poses)
def test_a_wall_keeps_its_ends_wherever_its_frame_is(frame):
    wall = Wall((1.0, 2.0), (4.0, 2.5), beams=20, residual=0.01)
    line = line_of(wall, frame)
    for end in (wall.start, wall.end):
        assert abs(line.across(to_parent(frame, end))) < 1e-9


@given(poses, st.booleans())
@pytest.mark.parametrize(
    ("new", "joined"),
    [
        ((2.0, 3.0), (1.0, 4.0)),
        ((0.0, 3.0), (0.0, 4.0)),
        ((2.0, 5.0), (1.0, 5.0)),
        ((0.0, 5.0), (0.0, 5.0)),
    ],
    ids=["inside", "extends the start", "extends the end", "extends both"],
)
def test_the_four_cases_of_weerakoons_figure_5(new, joined, frame, swapped):
    def wall(first, last):
        seen = Wall((first, 1.0), (last, 1.0), beams=50, residual=0.01)
        ends = to_parent(frame, seen.start), to_parent(frame, seen.end)
        return MapWall.of(line_of(seen, frame), *ends)

    known, other = wall(1.0, 4.0), wall(*new)
    if swapped:
        known, other = other, known
    known.absorb(other)
    found = known.as_wall(known.extent)
    for place, point in zip(joined, (found.start, found.end), strict=True):
        assert point == pytest.approx(to_parent(frame, (place, 1.0)), abs=1e-6)
    seen = known.cells.seen
    both = min(new[1], 4.0) - max(new[0], 1.0)
    assert np.count_nonzero(seen) == pytest.approx((joined[1] - joined[0]) / CELL_LENGTH, abs=3)
    assert np.count_nonzero(seen == 2) == pytest.approx(both / CELL_LENGTH, abs=3)


@given(metres, metres, st.floats(0.0, 5.0), st.floats(0.0, 5.0))
def test_a_gap_is_the_same_from_either_side(a, b, length_a, length_b):
    one, other = (a, a + length_a), (b, b + length_b)
    assert gap(one, other) == gap(other, one)
    assert (gap(one, other) < 0) == (min(one[1], other[1]) > max(one[0], other[0]))


def test_a_short_line_along_a_long_one_is_a_double():
    """A line that faces the other way is the back of the wall, and stays."""
    long, short = Wall((0.0, 0.0), (5.0, 0.0)), Wall((1.0, 0.03), (2.0, 0.05))
    back, far = Wall((4.0, -0.05), (1.0, -0.05)), Wall((1.0, 0.3), (2.0, 0.3))
    assert without_duplicates((short, long, back, far)) == (long, back, far)


def test_a_wall_whose_ends_are_far_away_is_mapped():
    """A corridor that is seen 9.9 m far in both directions; the walls are 1 m away."""
    angles = np.linspace(-math.pi, math.pi, 1440, endpoint=False)
    with np.errstate(divide="ignore"):
        ranges = 1.0 / np.abs(np.sin(angles))
    scan = Scan(ranges, angles[0], angles[1] - angles[0], range_max=9.9)
    line_map = LineMap(MapSettings(wall_hits=1))
    line_map.add(extract(scan), scan, ORIGIN)
    assert len(line_map.walls) == 2
    assert all(wall.length > 15.0 for wall in line_map.walls)
