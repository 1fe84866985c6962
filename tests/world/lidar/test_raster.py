from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from semnav_env.bench.brute_force import brute_force_ranges
from semnav_env.world.lidar.culling import CELL_SIZE, MAX_CULLING_CELLS, Culling, cell_of
from semnav_env.world.lidar.raster import cast
from semnav_env.world.maps import FloorPlan, bundled_names, load_floor_plan
from semnav_features.frames import FloatArray, Pose
from semnav_features.lidar_spec import LidarSpec
from semnav_features.lidars import BARBRET, TIM561
from tests.support.small_plans import closed, empty_hall, furnished_hall, plan_of

AROUND = LidarSpec("around", 360, -math.pi, math.tau / 360)
ROUNDABOUT = LidarSpec("first beam twice", 361, -math.pi, math.tau / 360)
headings = st.floats(-math.pi, math.pi)


def ranges_of(segments: FloatArray, pose: Pose, spec: LidarSpec = TIM561) -> FloatArray:
    culling = Culling.of(segments, spec.range_max)
    out = np.full(spec.beams, np.nan)
    x, y, heading = (float(value) for value in pose)
    tables = (culling.grid, culling.starts, culling.ends, spec.cosines_sines, spec.sensor)
    cast(x, y, heading, *tables, out)
    return out


def within(ranges: FloatArray, range_max: float) -> FloatArray:
    return np.where(ranges < range_max, ranges, np.inf)


def shapely_ranges(segments: FloatArray, pose: Pose, spec: LidarSpec) -> FloatArray:
    walls = shapely.multilinestrings(shapely.linestrings(segments.reshape(-1, 2, 2)))
    angles = spec.angles + pose[2]
    away = np.stack((np.cos(angles), np.sin(angles)), axis=1) * spec.range_max
    start = np.broadcast_to(np.array(pose[:2]), away.shape)
    beams = shapely.linestrings(np.stack((start, start + away), axis=1))
    hits = shapely.intersection(beams, walls)
    distances = shapely.distance(shapely.Point(pose[:2]), hits)
    return np.where(np.isnan(distances), np.inf, distances)


def random_poses(plan: FloorPlan, count: int) -> list[Pose]:
    rng = np.random.default_rng(7)
    x1, y1, x2, y2 = plan.boundary.bounds
    low, high = (x1 - 1, y1 - 1, -math.pi), (x2 + 1, y2 + 1, math.pi)
    return [tuple(pose) for pose in rng.uniform(low, high, (count, 3)).tolist()]


def test_ranges_agree_with_shapely_in_the_small_plan() -> None:
    plan = furnished_hall()
    for pose in random_poses(plan, 20):
        found = ranges_of(plan.opaque_segments, pose)
        expected = shapely_ranges(plan.opaque_segments, pose, TIM561)
        np.testing.assert_allclose(found, expected, rtol=0, atol=1e-9)


@pytest.mark.parametrize("name", bundled_names())
@pytest.mark.parametrize("spec", [TIM561, BARBRET], ids=lambda spec: spec.name)
def test_ranges_agree_with_shapely_in_every_bundled_plan(name: str, spec: LidarSpec) -> None:
    plan = load_floor_plan(name)
    for pose in random_poses(plan, 8):
        found = ranges_of(plan.opaque_segments, pose, spec)
        expected = shapely_ranges(plan.opaque_segments, pose, spec)
        np.testing.assert_allclose(found, expected, rtol=0, atol=1e-9)


@given(st.integers(0, 2**32), headings)
@settings(max_examples=40, deadline=None)
def test_ranges_agree_with_brute_force_among_random_segments(seed: int, heading: float) -> None:
    rng = np.random.default_rng(seed)
    segments = rng.uniform(-30, 30, (200, 2)).repeat(2, 0).reshape(200, 4)
    segments[:, 2:] += rng.uniform(-3, 3, (200, 2))
    pose = (*rng.uniform(-35, 35, 2).tolist(), heading)
    expected = within(brute_force_ranges(pose, segments, AROUND.angles), AROUND.range_max)
    np.testing.assert_allclose(ranges_of(segments, pose, AROUND), expected, rtol=0, atol=1e-9)


@pytest.mark.parametrize("spec", [TIM561, AROUND, ROUNDABOUT], ids=lambda spec: spec.name)
@given(st.integers(0, 2**32), headings)
@settings(max_examples=25, deadline=None)
def test_what_many_segments_hide_changes_no_range(
    spec: LidarSpec, seed: int, heading: float
) -> None:
    """Several hundred segments around the lidar, of which it sees some dozens."""
    rng = np.random.default_rng(seed)
    segments = rng.uniform(-9, 9, (400, 2)).repeat(2, 0).reshape(400, 4)
    segments[:, 2:] += rng.normal(0, rng.uniform(0.1, 3), (400, 2))
    expected = within(brute_force_ranges((0, 0, heading), segments, spec.angles), spec.range_max)
    found = ranges_of(segments, (0, 0, heading), spec)
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-9)


@given(st.lists(st.floats(0.1, 9.9), min_size=360, max_size=360), headings)
@settings(max_examples=25, deadline=None)
def test_no_beam_slips_between_walls_that_share_a_corner(
    radii: list[float], heading: float
) -> None:
    """Every corner of the polygon lies on a beam."""
    angles = AROUND.angles + heading
    corners = np.stack((np.cos(angles), np.sin(angles)), axis=1) * np.array(radii)[:, None]
    segments = np.hstack((corners, np.roll(corners, -1, axis=0)))
    np.testing.assert_allclose(ranges_of(segments, (0, 0, heading), AROUND), radii, atol=1e-9)


@given(st.floats(-9, 0), headings, st.floats(-4, 4))
@settings(deadline=None)
def test_a_wall_is_seen_exactly_however_near_it_is(
    exponent: float, heading: float, x: float
) -> None:
    height = 10.0**exponent
    wall = np.array([[-100.0, 0.0, 100.0, 0.0]])
    down = -np.sin(AROUND.angles + heading)
    seen = down * AROUND.range_max > height * (1 + 1e-6)
    unseen = down * AROUND.range_max < height * (1 - 1e-6)
    found = ranges_of(wall, (x, height, heading), AROUND)
    assert np.isinf(found[unseen]).all()
    # A beam that grazes the wall magnifies the rounding of its direction.
    tolerance = 1e-9 + 1e-15 * found[seen] / down[seen]
    assert (np.abs(found[seen] - height / down[seen]) <= tolerance).all()


@given(st.integers(-400, 400), headings)
@settings(deadline=None)
def test_turning_by_whole_beams_shifts_the_ranges(beams: int, heading: float) -> None:
    segments = furnished_hall().opaque_segments
    turned = ranges_of(segments, (4.5, 3.3, heading + beams * AROUND.angle_increment), AROUND)
    expected = np.roll(ranges_of(segments, (4.5, 3.3, heading), AROUND), -beams)
    np.testing.assert_allclose(turned, expected, atol=1e-9)


@pytest.mark.parametrize("angle_min", [-math.pi, -2.0, 0.0, 1e-5, 3.0, math.pi])
@given(headings)
@settings(max_examples=15, deadline=None)
def test_beams_may_begin_in_any_direction(angle_min: float, heading: float) -> None:
    spec = replace(ROUNDABOUT, angle_min=angle_min)
    segments, pose = empty_hall().segments, (3.1, 2.2, heading)
    found = ranges_of(segments, pose, spec)
    np.testing.assert_allclose(
        found, brute_force_ranges(pose, segments, spec.angles), rtol=0, atol=1e-9
    )
    assert found[0] == pytest.approx(found[-1], abs=1e-9)


def test_very_fine_and_very_few_beams_are_exact() -> None:
    segments, pose = furnished_hall().opaque_segments, (4.5, 3.3, 0.4)
    for beams in (1, 2, 40_001):
        spec = LidarSpec("fine", beams, -1.5, 3.0 / max(beams - 1, 1))
        expected = within(brute_force_ranges(pose, segments, spec.angles), spec.range_max)
        np.testing.assert_allclose(ranges_of(segments, pose, spec), expected, atol=1e-9)


@given(st.integers(0, 2**32))
@settings(deadline=None)
def test_neither_order_nor_direction_of_segments_matters(seed: int) -> None:
    rng = np.random.default_rng(seed)
    segments = furnished_hall().opaque_segments
    shuffled = rng.permutation(segments)
    flipped = rng.random(len(segments)) < 0.5
    shuffled[flipped] = shuffled[flipped][:, [2, 3, 0, 1]]
    pose = (4.5, 3.3, float(rng.uniform(-4, 4)))
    np.testing.assert_array_equal(ranges_of(shuffled, pose), ranges_of(segments, pose))


@given(headings)
@settings(deadline=None)
def test_mirroring_the_plan_mirrors_the_ranges(heading: float) -> None:
    spec = replace(TIM561, angle_min=-405 * TIM561.angle_increment)
    segments = furnished_hall().opaque_segments
    mirrored = ranges_of(segments * [1, -1, 1, -1], (4.5, -3.3, -heading), spec)
    np.testing.assert_allclose(mirrored[::-1], ranges_of(segments, (4.5, 3.3, heading), spec))


def test_nothing_is_seen_at_or_beyond_the_largest_range() -> None:
    ahead = LidarSpec("ahead", 1, 0.0, 0.1, range_max=4.0)
    wall = np.array([[4.0, -1.0, 4.0, 1.0]])
    assert ranges_of(wall, (0.0, 0.0, 0.0), ahead) == math.inf
    assert ranges_of(wall, (1e-9, 0.0, 0.0), ahead) == pytest.approx(4.0)


def test_what_lies_behind_a_narrow_field_of_view_is_not_seen() -> None:
    narrow = LidarSpec("narrow", 101, -0.5, 0.01)
    assert np.isinf(ranges_of(np.array([[-2.0, -1.0, -2.0, 1.0]]), (0, 0, 0), narrow)).all()


def test_a_plan_without_segments_is_empty_everywhere() -> None:
    assert np.isinf(ranges_of(np.empty((0, 4)), (3.0, 4.0, 5.0))).all()


@pytest.mark.parametrize("pose", [(2, 0, 0), (0, 0, 0), (1, 1e-300, 0), (3, 0, 0), (5, 0, math.pi)])
def test_a_lidar_on_the_line_of_a_wall_reads_no_nan(pose: Pose) -> None:
    wall_and_point = np.array([[0.0, 0.0, 4.0, 0.0], [3.0, 0.0, 3.0, 0.0]])
    assert not np.isnan(ranges_of(wall_and_point, pose, AROUND)).any()


def test_a_pose_that_is_not_finite_sees_nothing() -> None:
    for pose in ((math.nan, 0.0, 0.0), (math.inf, 0.0, 0.0), (1.0, 1.0, math.nan)):
        assert np.isinf(ranges_of(empty_hall().segments, pose)).all()


def test_every_list_holds_whatever_its_cell_can_reach() -> None:
    rng = np.random.default_rng(3)
    segments = rng.uniform(0, 60, (300, 2)).repeat(2, 0).reshape(300, 4)
    segments[:, 2:] += rng.uniform(-2, 2, (300, 2))
    culling = Culling.of(segments, 5.0)
    lines = shapely.linestrings(segments.reshape(-1, 2, 2))
    for x, y in rng.uniform(1, 59, (100, 2)):
        cell = cell_of(culling.grid, x, y)
        listed = culling.ends[:, culling.starts[cell] : culling.starts[cell + 1]].T
        reachable = segments[shapely.distance(lines, shapely.Point(x, y)) <= 5.0]
        assert {tuple(row) for row in reachable} <= {tuple(row) for row in listed}
        assert len(listed) < len(segments) / 4


def test_cells_grow_instead_of_becoming_too_many() -> None:
    assert Culling.of(empty_hall().segments, 10.0).grid[0]["cell"] == CELL_SIZE
    vast = plan_of(closed((0, 0), (5e4, 0), (5e4, 3e4), (0, 3e4)))
    assert len(Culling.of(vast.segments, 10.0).starts) < 1.1 * MAX_CULLING_CELLS
    assert ranges_of(vast.segments, (5e4 - 3.0, 9.0, 0.0), AROUND)[180] == pytest.approx(3.0)


@pytest.mark.parametrize("segments", [np.zeros((3, 2)), np.zeros(4), np.full((1, 4), np.nan)])
def test_malformed_segments_are_refused(segments: FloatArray) -> None:
    with pytest.raises(ValueError, match="finite and of shape"):
        Culling.of(segments, 10.0)
