"""What holds of every scene, whatever the strategy, and of every array that becomes a scan."""

from __future__ import annotations

import math
from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import DTypeLike

from semnav_features import CornerKind, ExtractorSettings, Scan, Scene, extract
from semnav_features.frames import FloatArray
from semnav_features.strategies import BreakpointRule, Segmentation, strategy_names
from studies.features.overlap import Overlap
from tests.support.raycaster import FIELD_OF_VIEW, cast, scan_of
from tests.support.strategies import Opening, Room, awkward_scans, openings, rooms

places = st.one_of(rooms(), openings(0.5, 2.5))
seeds = st.integers(0, 2**32 - 1)

STRATEGIES = [
    ExtractorSettings(breakpoint_rule=rule, segmentation=segmentation)
    for rule, segmentation in product(strategy_names(BreakpointRule), strategy_names(Segmentation))
]
chosen_settings = st.sampled_from(STRATEGIES)

ROOM = Room(4.0, 3.0, (1.7, 1.2, 0.4))
TURN = 2.0 * math.pi


def beams_at(place: Room | Opening, angle_min: float, increment: float, beams: int) -> Scan:
    """A scan without errors."""
    angles = angle_min + increment * np.arange(beams)
    return Scan(cast(place.segments, place.pose, angles), angle_min, increment)


def assert_kept(before: Scene, after: Scene) -> None:
    """Every wall is covered by one wall of the other scene, but for a beam at its ends."""
    overlap = Overlap(before.walls, after.walls)
    assert (overlap.longest >= 0.9 * overlap.lengths - 0.05).all()


@settings(max_examples=60)
@given(places, st.integers(150, 811), st.integers(2, 4))
def test_beams_between_the_others_remove_no_wall(
    place: Room | Opening, beams: int, times: int
) -> None:
    increment = FIELD_OF_VIEW / (beams - 1)
    coarse = beams_at(place, -FIELD_OF_VIEW / 2, increment, beams)
    fine = beams_at(place, -FIELD_OF_VIEW / 2, increment / times, (beams - 1) * times + 1)
    assert fine.ranges[::times] == pytest.approx(coarse.ranges)
    assert_kept(extract(coarse), extract(fine))


@settings(max_examples=60)
@given(places, st.integers(0, 300), st.integers(0, 300))
def test_beams_at_the_ends_of_a_scan_remove_no_wall(
    place: Room | Opening, before: int, after: int
) -> None:
    increment, beams = math.radians(0.3), 500
    narrow = beams_at(place, -1.3, increment, beams)
    wide = beams_at(place, -1.3 - before * increment, increment, before + beams + after)
    assert_kept(extract(narrow), extract(wide))


@settings(max_examples=60)
@given(places, seeds, chosen_settings)
def test_the_free_side_of_every_wall_is_on_its_left(
    place: Room | Opening, seed: int, chosen: ExtractorSettings
) -> None:
    scan = scan_of(place.segments, place.pose, sigma=0.02, rng=np.random.default_rng(seed))
    for wall in extract(scan, chosen).walls:
        assert wall.start[0] * wall.end[1] - wall.start[1] * wall.end[0] > 0.0


def turned(scan: Scan, angle: float) -> Scan:
    return Scan(scan.ranges, scan.angle_min + angle, scan.angle_increment)


@settings(max_examples=60)
@given(places, seeds, chosen_settings, st.floats(-10.0, 10.0))
def test_rotating_the_robot_rotates_the_scene(
    place: Room | Opening, seed: int, chosen: ExtractorSettings, angle: float
) -> None:
    scan = scan_of(place.segments, place.pose, sigma=0.02, rng=np.random.default_rng(seed))
    expected = ends_of(extract(scan, chosen).placed((0.0, 0.0, angle)))
    assert ends_of(extract(turned(scan, angle), chosen)) == pytest.approx(expected, abs=1e-6)


def ends_of(scene: Scene) -> FloatArray:
    return np.array([(*wall.start, *wall.end) for wall in scene.walls]).reshape(-1, 4)


MIRRORED = [
    chosen
    for chosen in STRATEGIES
    if chosen.breakpoint_rule != "borges_aldon" and chosen.segmentation != "dynamic"
]
"""That rule asks which of two points came first, and a cut of that partition is the first point
of the later piece."""


@settings(max_examples=60)
@given(places, seeds, st.sampled_from(MIRRORED))
def test_mirroring_swaps_left_and_right_with_every_strategy(
    place: Room | Opening, seed: int, chosen: ExtractorSettings
) -> None:
    scan = scan_of(place.segments, place.pose, sigma=0.005, rng=np.random.default_rng(seed))
    mirrored = Scan(scan.ranges[::-1], scan.angle_min, scan.angle_increment)
    walls = ends_of(extract(scan, chosen))[::-1]
    flipped = walls[:, [2, 3, 0, 1]] * (1.0, -1.0, 1.0, -1.0)
    assert ends_of(extract(mirrored, chosen)) == pytest.approx(flipped, abs=1e-6)


@settings(max_examples=150)
@given(awkward_scans(), chosen_settings)
def test_any_scan_gives_a_finite_scene_with_every_strategy(
    scan: Scan, chosen: ExtractorSettings
) -> None:
    scene = extract(scan, chosen)
    assert np.isfinite(ends_of(scene)).all()
    assert all(map(math.isfinite, (x for c in scene.corners for x in c.point)))


def circle_of(beams: int, increment: float = TURN / 1080) -> Scan:
    return beams_at(ROOM, -math.pi, increment, beams)


def is_the_room(scene: Scene) -> bool:
    kinds = [corner.kind for corner in scene.corners]
    return len(scene.walls) == 4 and kinds == [CornerKind.OUTER] * 4 and not scene.doors


@pytest.mark.parametrize("beams", [1079, 1080, 1081])
def test_a_circle_may_lack_a_beam_or_repeat_one(beams: int) -> None:
    assert is_the_room(extract(circle_of(beams)))


def test_a_circle_in_descending_order_is_the_same_room() -> None:
    scan = circle_of(1081)
    again = Scan(scan.ranges[::-1], float(scan.angles[-1]), -scan.angle_increment)
    assert ends_of(extract(again)) == pytest.approx(ends_of(extract(scan)), abs=1e-9)


@pytest.mark.parametrize("dtype", [np.float16, np.float32, ">f8", "<f8", np.longdouble])
def test_numbers_of_any_precision_give_the_room(dtype: DTypeLike) -> None:
    scan = circle_of(1080)
    scene = extract(Scan(scan.ranges.astype(dtype), scan.angle_min, scan.angle_increment))
    assert is_the_room(scene)
    assert ends_of(scene) == pytest.approx(ends_of(extract(scan)), abs=0.02)


def test_however_the_array_lies_in_memory_the_scene_is_the_same() -> None:
    scan = circle_of(1080)
    read_only = scan.ranges.copy()
    read_only.setflags(write=False)
    spread = np.repeat(scan.ranges, 3)[1::3]
    column = np.asfortranarray(np.stack((scan.ranges, scan.ranges), axis=1))[:, 0]
    expected = extract(scan)
    for ranges in (read_only, spread, column, scan.ranges.tolist(), tuple(scan.ranges.tolist())):
        assert extract(Scan(ranges, scan.angle_min, scan.angle_increment)) == expected  # type: ignore[arg-type]


@pytest.mark.parametrize("gone", [math.nan, math.inf, 0.0, -1.0, 30.0])
def test_missing_returns_are_the_same_whatever_stands_for_them(gone: float) -> None:
    scan = circle_of(1080)
    ranges = scan.ranges.copy()
    ranges[200:260] = gone
    expected = scan.ranges.copy()
    expected[200:260] = math.nan
    scenes = [extract(Scan(r, scan.angle_min, scan.angle_increment)) for r in (ranges, expected)]
    assert scenes[0] == scenes[1]
