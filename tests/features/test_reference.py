from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from semnav_features import ExtractorSettings, Scan, Scene, extract
from tests.numpy_oracle import extract_reference
from tests.support.raycaster import heidelberg, scan_of
from tests.support.strategies import Opening, Room, awkward_scans, openings, rooms

seeds = st.integers(0, 2**32 - 1)


def assert_same(scene: Scene, expected: Scene) -> None:
    places, expected_places = _places(scene), _places(expected)
    assert [len(kind) for kind in places] == [len(kind) for kind in expected_places]
    for kind, expected_kind in zip(places, expected_places, strict=True):
        np.testing.assert_allclose(kind, expected_kind, rtol=0, atol=1e-9)
    for wall, other in zip(scene.walls, expected.walls, strict=True):
        assert wall.residual == pytest.approx(other.residual, abs=1e-6)
        assert wall.angle_deviation == pytest.approx(other.angle_deviation, rel=1e-6)
        assert wall.offset_deviation == pytest.approx(other.offset_deviation, rel=1e-6)
        assert wall.centroid == pytest.approx(other.centroid, abs=1e-9)
        assert wall.beams == other.beams
        assert (wall.start_rupture, wall.end_rupture) == (other.start_rupture, other.end_rupture)
        assert (wall.start_break, wall.end_break) == (other.start_break, other.end_break)
    for arc, same in zip(scene.arcs, expected.arcs, strict=True):
        assert (arc.convex, arc.beams) == (same.convex, same.beams)
    assert [c.kind for c in scene.corners] == [c.kind for c in expected.corners]


def _places(scene: Scene) -> list[list[tuple[float, ...]]]:
    return [
        [(*wall.start, *wall.end) for wall in scene.walls],
        [(*door.start, *door.end) for door in scene.doors],
        [corner.point for corner in scene.corners],
        [(*corridor.start, *corridor.end) for corridor in scene.corridors],
        [(*arc.centre, arc.radius, *arc.start, *arc.end, arc.residual) for arc in scene.arcs],
    ]


@settings(max_examples=40, deadline=None)
@given(openings(0.5, 2.5), seeds, st.sampled_from([0.005, 0.02, 0.05]), st.booleans())
def test_kernels_agree_with_the_reference_in_corridors(
    opening: Opening, seed: int, sigma: float, dropouts: bool
) -> None:
    rng = np.random.default_rng(seed)
    scan = scan_of(opening.segments, opening.pose, sigma=sigma, rng=rng)
    ranges = np.where(rng.random(811) < 0.02 * dropouts, np.nan, scan.ranges)
    scan = Scan(ranges, scan.angle_min, scan.angle_increment)
    assert_same(extract(scan), extract_reference(scan))


@settings(max_examples=30, deadline=None)
@given(rooms(), seeds)
def test_kernels_agree_with_the_reference_in_rooms(room: Room, seed: int) -> None:
    scan = scan_of(room.segments, room.pose, sigma=0.02, rng=np.random.default_rng(seed))
    chosen = ExtractorSettings(sigma=0.01, split_distance=0.05, rupture_range=4.0)
    assert_same(extract(scan, chosen), extract_reference(scan, chosen))


@settings(max_examples=30, deadline=None)
@given(st.one_of(rooms(), openings(0.5, 2.5)), seeds, st.integers(357, 363))
def test_kernels_agree_with_the_reference_on_full_circles(
    place: Room | Opening, seed: int, beams: int
) -> None:
    rng = np.random.default_rng(seed)
    turn = 2.0 * math.pi * (beams - 1) / 360.0
    scan = scan_of(place.segments, place.pose, beams, turn, sigma=0.02, rng=rng)
    assert_same(extract(scan), extract_reference(scan))


@settings(max_examples=30, deadline=None)
@given(openings(0.5, 2.5), seeds, st.sampled_from([0.005, 0.02]))
def test_robust_kernels_agree_with_the_reference(opening: Opening, seed: int, sigma: float) -> None:
    rng = np.random.default_rng(seed)
    scan = scan_of(opening.segments, opening.pose, sigma=sigma, rng=rng)
    chosen = ExtractorSettings(robust_fit=True)
    assert_same(extract(scan, chosen), extract_reference(scan, chosen))


def test_kernels_agree_with_the_reference_within_a_round_wall() -> None:
    ranges = 0.5 * (1.0 + np.random.default_rng(0).uniform(0.0, 1e-3, 42))
    scan = Scan(ranges, 0.0, 2.0 * math.pi / 21)  # twice around
    scene = extract(scan)
    assert_same(scene, extract_reference(scan))
    assert [arc.beams for arc in scene.arcs] == [21]


@settings(max_examples=100, deadline=None)
@given(awkward_scans(), seeds)
def test_kernels_agree_with_the_reference_on_awkward_scans(scan: Scan, seed: int) -> None:
    unequal = scan.ranges * (1.0 + np.random.default_rng(seed).uniform(0.0, 1e-3, len(scan.ranges)))
    scan = Scan(unequal, scan.angle_min, scan.angle_increment)  # no ties, which rounding decides
    assert_same(extract(scan), extract_reference(scan))


@settings(max_examples=40, deadline=None)
@given(rooms(), seeds, st.floats(0.1, 1.0), st.sampled_from([0.005, 0.02, 0.04]))
def test_kernels_agree_with_the_reference_on_columns(
    room: Room, seed: int, radius: float, sigma: float
) -> None:
    rng = np.random.default_rng(seed)
    centre = (rng.uniform(0.0, room.width), rng.uniform(0.0, room.height))
    within = math.dist(centre, room.pose[:2]) < 1.01 * radius
    circles = [(centre, 3.0 * radius if within else radius)]
    scan = scan_of(room.segments, room.pose, sigma=sigma, rng=rng, circles=circles)
    assert_same(extract(scan), extract_reference(scan))


@pytest.mark.parametrize("one_sided", [True, False])
def test_kernels_agree_with_the_reference_in_a_real_hallway(one_sided: bool) -> None:
    segments, _ = heidelberg()
    rng = np.random.default_rng(3)
    chosen = ExtractorSettings(one_sided_doors=one_sided)
    for x in np.linspace(-2.0, 7.0, 15):
        pose = (float(x), -0.2 + 0.24 * (float(x) + 2.5), rng.uniform(-math.pi, math.pi))
        scan = scan_of(segments, pose, sigma=0.02, rng=rng)
        assert_same(extract(scan, chosen), extract_reference(scan, chosen))


def test_kernels_agree_with_the_reference_in_a_round_room() -> None:
    ranges = 1.0 + np.random.default_rng(0).uniform(0.0, 1e-3, 50)
    scan = Scan(ranges, 0.0, 0.125)
    assert_same(extract(scan), extract_reference(scan))
    assert len(extract(scan).arcs) == 1
