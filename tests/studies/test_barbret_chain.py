"""The chain of Barbret's thesis, as it stands there."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings

from semnav_features import CornerKind, Scan
from semnav_features.frames import FloatArray
from studies.features.barbret_chain import SPLIT_DISTANCE, barbret_scene, flag_points
from tests.support.raycaster import polygon, polyline, scan_of
from tests.support.strategies import awkward_scans

HERE = (0.0, 0.0, 0.0)


def gap(width: float, turn: float = 0.0) -> FloatArray:
    """A wall before the scanner with a gap; the part to the left is turned by an angle."""
    half, tip = width / 2, (2.0 - 2.0 * math.sin(turn), width / 2 + 2.0 * math.cos(turn))
    return np.concatenate((polyline((2.0, -2.5), (2.0, -half)), polyline((2.0, half), tip)))


@pytest.mark.parametrize(("width", "doors"), [(0.7, 0), (0.85, 1), (1.0, 1), (1.15, 1), (1.3, 0)])
def test_a_gap_of_door_width_between_walls_in_line_is_a_door(width: float, doors: int) -> None:
    assert len(barbret_scene(scan_of(gap(width), HERE)).doors) == doors


@pytest.mark.parametrize(("degrees", "doors"), [(0.0, 1), (1.0, 1), (5.0, 0)])
def test_walls_more_than_two_degrees_out_of_line_have_no_door(degrees: float, doors: int) -> None:
    assert len(barbret_scene(scan_of(gap(1.0, math.radians(degrees)), HERE)).doors) == doors


def test_a_room_has_an_outer_corner_in_each_of_its_corners() -> None:
    room = polygon((2.0, 2.0), (-1.0, 2.0), (-1.0, -2.0), (2.0, -2.0))
    scene = barbret_scene(scan_of(room, HERE))
    kinds = [corner.kind for corner in scene.corners]
    assert kinds.count(CornerKind.OUTER) == 4
    assert CornerKind.INNER not in kinds


def test_a_corner_that_points_at_the_scanner_is_inner() -> None:
    pillar = polyline((2.0, -1.5), (1.0, 0.0), (2.0, 1.5))
    kinds = [corner.kind for corner in barbret_scene(scan_of(pillar, HERE)).corners]
    assert kinds.count(CornerKind.INNER) == 1


def test_points_beyond_six_metres_are_left_out_and_flag_their_neighbours() -> None:
    scan = Scan(np.array([3.0, 3.0, 7.0, 3.0, 3.0]), angle_min=0.0, angle_increment=0.006)
    flagged = flag_points(scan)
    assert flagged.ruptures.tolist() == [False, True, True, False]


def test_a_probe_from_a_potential_corner_meets_the_opposite_wall() -> None:
    sides = np.concatenate((polyline((-1.0, -0.8), (1.0, -0.8)), polyline((2.5, 0.8), (-1.0, 0.8))))
    widths = [math.dist(c.start, c.end) for c in barbret_scene(scan_of(sides, HERE)).corridors]
    assert any(width == pytest.approx(1.6, abs=0.05) for width in widths)


@settings(max_examples=50, deadline=None)
@given(awkward_scans())
def test_any_scan_gives_finite_walls_between_its_points(scan: Scan) -> None:
    scene = barbret_scene(scan)
    points = flag_points(scan).points
    for wall in scene.walls:
        away = points - np.array(wall.start)
        assert np.hypot(*away.T).min() < SPLIT_DISTANCE
        assert wall.beams > 3
