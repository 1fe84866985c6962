"""Corners in a scan: inner, outer and potential ones."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from semnav_features import CornerKind, extract
from semnav_features.frames import Point
from tests.numpy_oracle.corners import corner_kind
from tests.support.raycaster import polyline, scan_of

quick = settings(max_examples=60, deadline=None)


@st.composite
def wedges(draw: st.DrawFn) -> tuple[Point, Point, Point]:
    """Far end, corner and far end of two walls of 1 m, both seen from the origin."""
    corner = draw(st.floats(2.0, 5.0)), 0.0
    right = math.radians(draw(st.floats(-160.0, -20.0)))
    left = math.radians(draw(st.floats(20.0, 160.0)))
    ends = [(corner[0] + math.cos(a), math.sin(a)) for a in (right, left)]
    return ends[0], corner, ends[1]


@quick
@given(wedges())
def test_a_corner_is_inner_if_it_points_at_the_scanner(
    wedge: tuple[Point, Point, Point],
) -> None:
    before, corner, after = wedge
    sides = [math.atan2(y - corner[1], x - corner[0]) for x, y in (before, after)]
    assume(abs(sides[1] - sides[0] - math.pi) > math.radians(55.0))  # flatter is no corner
    scene = extract(scan_of(polyline(*wedge), (0.0, 0.0, 0.0)))
    full = [found for found in scene.corners if found.kind is not CornerKind.POTENTIAL]
    assert len(full) == 1
    assert full[0].point == pytest.approx(corner, abs=1e-6)
    chord = before[0] + (after[0] - before[0]) * before[1] / (before[1] - after[1])
    assert full[0].kind is (CornerKind.INNER if chord > corner[0] else CornerKind.OUTER)


@given(wedges())
def test_formula_3_1_holds_unless_an_inner_corner_is_obtuse(
    wedge: tuple[Point, Point, Point],
) -> None:
    before, corner, after = wedge
    chord = before[0] + (after[0] - before[0]) * before[1] / (before[1] - after[1])
    sides = [math.atan2(y - corner[1], x - corner[0]) for x, y in (before, after)]
    opening = sides[1] - sides[0]
    assume(abs(opening - math.pi) > 1e-3)
    if chord < corner[0]:
        assert corner_kind(*wedge) is CornerKind.OUTER
    elif opening <= math.pi / 2:
        assert corner_kind(*wedge) is CornerKind.INNER


def test_walls_are_extended_to_their_corner() -> None:
    segments = np.concatenate(
        (polyline((2.0, -1.5), (2.0, 0.8)), polyline((1.8, 1.0), (-1.0, 1.0)))
    )
    corners = extract(scan_of(segments, (0.0, 0.0, 0.0))).corners
    outer = [corner for corner in corners if corner.kind is CornerKind.OUTER]
    assert len(outer) == 1
    assert outer[0].point == pytest.approx((2.0, 1.0), abs=1e-6)


def test_both_loose_ends_of_a_wall_are_potential_corners() -> None:
    scene = extract(scan_of(polyline((2.0, -1.0), (2.0, 1.0)), (0.0, 0.0, 0.0)))
    wall = scene.walls[0]
    assert wall.start_rupture
    assert wall.end_rupture
    assert [c.kind for c in scene.corners] == [CornerKind.POTENTIAL] * 2
    assert [c.point for c in scene.corners] == [wall.start, wall.end]
