"""Scans of every kind, empty, huge and odd: each gives a finite scene or an error that helps."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings

from semnav_features import ExtractorSettings, Scan, Scene, extract
from tests.support.raycaster import full_circle, polyline, scan_of
from tests.support.strategies import Room, awkward_scans


@settings(max_examples=200, deadline=None)
@given(awkward_scans())
def test_any_scan_gives_a_finite_scene(scan: Scan) -> None:
    assert_finite(extract(scan))


def assert_finite(scene: Scene) -> None:
    points = [p for w in scene.walls for p in (w.start, w.end)]
    points += [p for door in scene.doors for p in (door.start, door.end)]
    points += [corner.point for corner in scene.corners]
    points += [p for corridor in scene.corridors for p in (corridor.start, corridor.end)]
    assert np.isfinite(np.array(points, dtype=float)).all()
    assert all(math.isfinite(wall.residual) and wall.residual >= 0.0 for wall in scene.walls)


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, 0.0, -3.0, 1e-3, 10.0, 11.0])
@pytest.mark.parametrize("beams", [1, 2, 3, 811])
def test_a_scan_without_returns_gives_an_empty_scene(value: float, beams: int) -> None:
    assert extract(Scan(np.full(beams, value), -2.356, 0.0058)) == Scene()


@pytest.mark.parametrize("beams", [1, 2])
def test_one_or_two_returns_are_no_feature(beams: int) -> None:
    assert extract(Scan(np.ones(beams), 0.0, 0.01)) == Scene()


@pytest.mark.parametrize("beams", [180, 1080, 1081])
def test_the_number_of_beams_does_not_matter(beams: int) -> None:
    scan = scan_of(polyline((2.0, -3.0), (2.0, 3.0)), (0.0, 0.0, 0.0), beams)
    walls = extract(scan).walls
    assert len(walls) == 1
    assert walls[0].length == pytest.approx(6.0, abs=0.4)


def test_a_huge_scan_of_noise_gives_a_scene() -> None:
    rng = np.random.default_rng(5)
    assert_finite(extract(Scan(2.0 + 0.1 * rng.normal(size=200_000), -3.0, 3e-5)))


@pytest.mark.parametrize("increment", [5e-324, 1e-12, 0.1745329, 0.3, 1.0, 4.0])
def test_any_angle_increment_gives_a_scene(increment: float) -> None:
    beams = int(min(50.0, 4.0 * math.pi / increment))
    assert_finite(extract(Scan(np.linspace(1.0, 2.0, beams), 0.3, increment)))


@pytest.mark.parametrize("ranges", [[1.0, 2.0], np.ones(811), None, "scan"])
def test_bare_ranges_are_refused_with_the_way_to_a_scan(ranges: object) -> None:
    with pytest.raises(TypeError, match=r"Scan\(ranges, angle_min"):
        extract(ranges)  # type: ignore[arg-type]


def test_enormous_ranges_are_no_returns() -> None:
    farther, none = (
        Scan([2.0] * 60 + [far] * 40, 0.0, 0.01, range_max=1000.0) for far in (1e300, math.inf)
    )
    settings = ExtractorSettings(rupture_range=1000.0)
    assert extract(farther, settings) == extract(none, settings) != Scene()


def test_beams_beyond_a_full_turn_are_left_out() -> None:
    room = Room(4.0, 4.0, (2.0, 2.0, 0.3))
    once = full_circle(room.segments, room.pose, 720)
    ranges = np.concatenate((once.ranges, np.full(500, 1.0)))
    again = Scan(ranges, once.angle_min, once.angle_increment)
    assert extract(again) == extract(once)


def test_wrong_settings_are_refused_with_what_is_right() -> None:
    with pytest.raises(TypeError, match="ExtractorSettings, not dict"):
        extract(Scan([1.0, 1.0], 0.0, 0.1), {"sigma": 0.02})  # type: ignore[arg-type]
