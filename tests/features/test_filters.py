"""Filters of the ranges: they remove what they should and move no clean wall."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from semnav_features import ExtractorSettings, Scan, Scene, extract
from semnav_features.extraction import beam_directions, sensor_of
from semnav_features.frames import FloatArray
from semnav_features.kernels.chain import begin_sweep
from semnav_features.kernels.filters import filter_ranges
from semnav_features.kernels.full_circle import count_beams_per_turn
from semnav_features.kernels.scratch import allocate_scratch
from tests.numpy_oracle.filters import filtered
from tests.numpy_oracle.sweep import Sweep
from tests.support.raycaster import polyline, scan_of
from tests.support.strategies import Opening, Room, awkward_scans, openings, rooms

PLAIN = ExtractorSettings()
UNVEILED = ExtractorSettings(veil_angle=math.radians(8.0))
seeds = st.integers(0, 2**32 - 1)
halves = st.integers(1, 4)
filters = st.builds(
    ExtractorSettings,
    veil_angle=st.sampled_from([0.0, math.radians(3.0), math.radians(10.0)]),
    median_beams=st.integers(0, 4),
    sigma=st.sampled_from([0.0, 0.02]),
)


def filtered_ranges(scan: Scan, chosen: ExtractorSettings) -> FloatArray:
    beams = len(beam_directions(len(scan.ranges), scan.angle_min, scan.angle_increment))
    ranges, record = scan.ranges[:beams].copy(), chosen.as_record()[0]
    scratch = allocate_scratch(beams)
    begin_sweep(beams, sensor_of(scan), record, scratch)
    filter_ranges(ranges, record, scratch)
    return scratch.filtered[:beams]


def with_ranges(scan: Scan, ranges: FloatArray) -> Scan:
    return replace(scan, ranges=ranges)


def mouth(sigma: float = 0.0, seed: int = 0) -> Scan:
    """A wall at 2 m that ends, and another at 4 m behind it."""
    segments = np.concatenate(
        (polyline((2.0, -2.0), (2.0, 0.0)), polyline((4.0, -0.5), (4.0, 3.0)))
    )
    rng = np.random.default_rng(seed)
    return scan_of(segments, (0.0, 0.0, 0.0), sigma=sigma, rng=rng)


def edge_of(scan: Scan) -> int:
    """The last beam that meets the near wall."""
    return int(np.flatnonzero(np.isfinite(scan.ranges) & (scan.ranges < 3.0))[-1])


@given(awkward_scans())
def test_without_being_asked_no_range_is_changed(scan: Scan) -> None:
    assert filtered_ranges(scan, PLAIN) == pytest.approx(
        scan.ranges[: len(filtered_ranges(scan, PLAIN))], abs=0.0, nan_ok=True
    )


@settings(max_examples=150, deadline=None)
@given(awkward_scans(), filters)
def test_the_kernel_agrees_with_the_reference(scan: Scan, chosen: ExtractorSettings) -> None:
    found = filtered_ranges(scan, chosen)
    turn = count_beams_per_turn(len(found), scan.angle_increment, chosen.dropout_beams)
    sweep = Sweep.of(scan, chosen)
    expected = filtered(sweep, turn, chosen)
    seen = sweep.returned
    assert found[seen] == pytest.approx(expected.ranges[seen], nan_ok=True)
    assert np.isnan(found[seen]).tolist() == (~expected.returned[seen]).tolist()


@settings(max_examples=60, deadline=None)
@given(st.lists(st.floats(0.15, 0.85), min_size=1, max_size=2), seeds)
def test_only_mixed_pixels_are_removed(shares: list[float], seed: int) -> None:
    scan = mouth(0.01, seed)
    edge = edge_of(scan)
    ranges = scan.ranges.copy()
    near, far = ranges[edge], ranges[edge + len(shares) + 1]
    veil = [near + share * (far - near) for share in sorted(shares)]
    if len(veil) == 2 and veil[1] - veil[0] < 0.3:
        veil[0], veil[1] = near + 0.3, near + 1.2
    ranges[edge + 1 : edge + 1 + len(veil)] = veil
    clear = filtered_ranges(with_ranges(scan, ranges), UNVEILED)
    expected = ranges.copy()
    expected[edge + 1 : edge + 1 + len(veil)] = math.nan
    assert clear == pytest.approx(expected, abs=0.0, nan_ok=True)


@settings(max_examples=30, deadline=None)
@given(openings(0.5, 2.5), st.floats(math.radians(1.0), math.radians(15.0)), st.integers(61, 811))
def test_taking_veils_away_takes_no_point_of_a_clean_wall(
    opening: Opening, angle: float, beams: int
) -> None:
    scan = scan_of(opening.segments, opening.pose, beams)
    chosen = ExtractorSettings(veil_angle=angle)
    kept = ~np.isnan(filtered_ranges(scan, chosen)) | ~np.isfinite(scan.ranges)
    bearings = scan.angles[~kept]
    for wall in extract(scan).walls:
        start, end = (math.atan2(y, x) for x, y in (wall.start, wall.end))
        within = (bearings > start + 1e-6) & (bearings < end - 1e-6)
        assert not within.any()
    assert_walls_stay(extract(scan), extract(scan, chosen), scan)


@settings(max_examples=40, deadline=None)
@given(st.one_of(rooms(), openings(0.5, 2.5)), halves)
def test_medians_move_no_clean_wall(place: Room | Opening, half: int) -> None:
    scan = scan_of(place.segments, place.pose)
    chosen = ExtractorSettings(median_beams=half)
    assert_walls_stay(extract(scan), extract(scan, chosen), scan)


def assert_walls_stay(scene: Scene, filtered_scene: Scene, scan: Scan) -> None:
    """Every wall is still there, its ends within two centimetres and three beams."""
    for wall in scene.walls:
        assert any(
            all(
                math.dist(a, b) < 0.02 + 3.0 * _spacing(wall.start, wall.end, a, scan)
                for a, b in ((wall.start, other.start), (wall.end, other.end))
            )
            for other in filtered_scene.walls
        )


def _spacing(
    start: tuple[float, float],
    end: tuple[float, float],
    place: tuple[float, float],
    scan: Scan,
) -> float:
    distance = abs(start[0] * end[1] - start[1] * end[0]) / math.dist(start, end)
    return scan.angle_increment * math.hypot(*place) ** 2 / distance


@settings(max_examples=60, deadline=None)
@given(seeds, halves, st.floats(0.5, 9.0), st.data())
def test_outliers_in_a_wall_are_brought_back_to_it(
    seed: int, half: int, wrong: float, data: st.DataObject
) -> None:
    rng = np.random.default_rng(seed)
    scan = scan_of(polyline((2.0, -3.0), (2.0, 3.0)), (0.0, 0.0, 0.0), sigma=0.005, rng=rng)
    seen = np.flatnonzero(np.isfinite(scan.ranges))
    first = data.draw(st.integers(int(seen[0]) + 2 * half, int(seen[-1]) - 3 * half))
    ranges = scan.ranges.copy()
    ranges[first : first + half] = wrong
    assume(np.abs(scan.ranges[first - half : first + 2 * half] - wrong).min() > 0.3)
    smooth = filtered_ranges(with_ranges(scan, ranges), ExtractorSettings(median_beams=half))
    for i in range(first, first + half):
        window = scan.ranges[i - half : i + half + 1]
        assert window.min() <= smooth[i] <= window.max()


def test_medians_calm_the_noise_of_a_wall() -> None:
    rng = np.random.default_rng(2)
    exact = scan_of(polyline((2.0, -2.0), (2.0, 2.0)), (0.0, 0.0, 0.0))
    noisy = with_ranges(exact, exact.ranges + rng.normal(0.0, 0.02, len(exact.ranges)))
    inside = np.flatnonzero(np.isfinite(exact.ranges))[5:-5]
    spread = [
        np.std(filtered_ranges(noisy, chosen)[inside] - exact.ranges[inside])
        for chosen in (PLAIN, ExtractorSettings(median_beams=1), ExtractorSettings(median_beams=4))
    ]
    assert spread[0] > 1.3 * spread[1] > 1.6 * spread[2]


def test_an_edge_stays_where_it_is_under_medians() -> None:
    scan = mouth()
    for half in range(1, 5):
        smooth = filtered_ranges(scan, ExtractorSettings(median_beams=half))
        edge = edge_of(scan)
        assert smooth[edge - 9 : edge + 10] == pytest.approx(
            scan.ranges[edge - 9 : edge + 10], abs=1e-3
        )


@settings(max_examples=60, deadline=None)
@given(rooms(), seeds, filters, st.integers(0, 359))
def test_the_start_of_a_full_circle_does_not_matter(
    room: Room, seed: int, chosen: ExtractorSettings, first: int
) -> None:
    field = 2.0 * math.pi * 359 / 360
    rng = np.random.default_rng(seed)
    scan = scan_of(room.segments, room.pose, 360, field, sigma=0.02, rng=rng)
    turned = with_ranges(scan, np.roll(scan.ranges, -first))
    assert np.roll(filtered_ranges(scan, chosen), -first) == pytest.approx(
        filtered_ranges(turned, chosen), nan_ok=True
    )


@settings(max_examples=80, deadline=None)
@given(awkward_scans(), filters)
def test_any_filtered_scan_gives_a_finite_scene(scan: Scan, chosen: ExtractorSettings) -> None:
    scene = extract(scan, chosen, explain=True)
    assert all(map(math.isfinite, (x for w in scene.walls for x in (*w.start, *w.end))))
