from __future__ import annotations

from itertools import product

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from semnav_agents.planning.free import points_around
from semnav_agents.planning.obstacles import (
    MemorySettings,
    ObstacleMemory,
    memory_arrays,
    points_of_segments,
)
from semnav_features.frames import compose
from tests.support.raycaster import polygon, scan_of

ROOM = polygon((-2.0, -2.0), (3.0, -2.0), (3.0, 2.0), (-2.0, 2.0))
places = st.integers(-900, 900).map(lambda n: n / 100)
HERE = (0.0, 0.0, 0.0)


def see(memory, segments, pose=HERE, odom=None, scans=1, sigma=0.0, seed=0):
    rng = np.random.default_rng(seed)
    for _ in range(scans):
        scan = scan_of(segments, pose, sigma=sigma, rng=rng)
        directions = np.stack((np.cos(scan.angles), np.sin(scan.angles)), axis=1)
        memory.update(odom or pose, scan.ranges, directions, scan.range_max)
    return memory.points()


def distance_to(segments, points):
    return shapely.distance(shapely.MultiLineString(list(segments)), shapely.points(points))


def test_noise_of_two_centimetres_averages_to_one():
    points = see(ObstacleMemory(), ROOM, scans=30, sigma=0.02)
    distance = distance_to(ROOM, points)
    assert np.sqrt(np.mean(distance**2)) < 0.0125
    assert distance.max() < 0.05


def test_a_wall_in_view_is_covered_without_holes():
    points = see(ObstacleMemory(), ROOM, scans=10, sigma=0.02)
    wall = np.stack((np.full(60, 3.0), np.linspace(-1.9, 1.9, 60)), axis=1)
    nearest = np.linalg.norm(wall[:, None] - points[None], axis=2).min(axis=1)
    assert nearest.max() < 0.07


def test_points_move_with_the_lidar():
    pose = (5.0, -3.0, 2.0)
    points = see(ObstacleMemory(), ROOM, odom=pose, scans=3)
    local = see(ObstacleMemory(), ROOM, scans=3)
    placed = np.array([compose(pose, (x, y, 0.0))[:2] for x, y in local])
    assert np.linalg.norm(points[:, None] - placed[None], axis=2).min(axis=1).max() < 0.05


def test_a_single_stray_hit_is_no_obstacle():
    memory = ObstacleMemory()
    scan = scan_of(ROOM, HERE)
    ranges = scan.ranges.copy()
    ranges[400] = 1.0
    directions = np.stack((np.cos(scan.angles), np.sin(scan.angles)), axis=1)
    memory.update(HERE, ranges, directions, scan.range_max)
    assert distance_to(ROOM, memory.points()).max() < 0.05


def test_what_has_gone_is_cleared_once_beams_pass_through():
    memory = ObstacleMemory()
    box = polygon((1.0, -0.2), (1.4, -0.2), (1.4, 0.2), (1.0, 0.2))
    with_box = see(memory, np.concatenate((ROOM, box)), scans=10)
    assert (distance_to(box, with_box) < 0.05).any()
    without = see(memory, ROOM, scans=10)
    assert distance_to(ROOM, without).max() < 0.05


def test_what_is_behind_is_kept_until_the_robot_has_driven_far():
    memory = ObstacleMemory()
    behind = polygon((-1.4, -0.2), (-1.0, -0.2), (-1.0, 0.2), (-1.4, 0.2))
    see(memory, np.concatenate((ROOM, behind)), pose=(-1.8, 0.0, 0.0), scans=5)
    assert (distance_to(behind, see(memory, ROOM, pose=(0.5, 0.0, 0.0))) < 0.05).any()
    for step in range(60):
        points = see(memory, ROOM, pose=(0.5 + 0.2 * (step % 2), 0.0, 0.0))
    assert not (distance_to(behind, points) < 0.05).any()


@pytest.mark.parametrize("reach", [0.4, 1.65, 2.5])
@pytest.mark.parametrize("pose", [(0.0, 0.0, 0.0), (1.2, -0.7, 2.0), (-2.9, 1.9, -1.0)])
def test_the_points_near_a_pose_are_those_of_all_points(pose, reach):
    memory = ObstacleMemory()
    for step in range(6):
        see(memory, ROOM, pose=(0.1 * step, 0.0, 0.1 * step), sigma=0.03, seed=step)
    expected = points_around(pose, memory.points(), reach)
    np.testing.assert_array_equal(memory.near(pose, reach), expected)
    assert len(expected) < len(memory.points())


def test_memories_that_share_a_table_remember_as_alone():
    settings = MemorySettings()
    state, centres, table = memory_arrays(2, settings)
    sharing = [
        ObstacleMemory(settings, (state[k : k + 1], centres[k : k + 1], table)) for k in range(2)
    ]
    alone = [ObstacleMemory(), ObstacleMemory()]
    for step, k in product(range(4), range(2)):
        pose = (0.2 * step * (1 - 2 * k), 0.1 * k, 0.0)
        found, expected = (
            see(memories[k], ROOM, pose=pose, sigma=0.02, seed=step)
            for memories in (sharing, alone)
        )
        np.testing.assert_array_equal(found, expected)
    assert (table == -1).all()


def test_forgetting_everything_leaves_nothing():
    memory = ObstacleMemory()
    assert len(see(memory, ROOM, scans=2)) > 0
    memory.reset()
    assert memory.points().shape == (0, 2)


@given(arrays(np.float64, 30, elements=st.floats(allow_nan=True, allow_infinity=True)))
def test_no_ranges_make_points_that_are_not_finite(ranges):
    memory = ObstacleMemory()
    angles = np.linspace(-2.0, 2.0, 30)
    directions = np.stack((np.cos(angles), np.sin(angles)), axis=1)
    for _ in range(2):
        memory.update(HERE, ranges, directions, 10.0)
    assert np.isfinite(memory.points()).all()


def test_bad_scans_are_named():
    memory = ObstacleMemory()
    with pytest.raises(ValueError, match=r"\(n,\) and \(n, 2\)"):
        memory.update(HERE, np.ones(5), np.ones((4, 2)), 10.0)
    with pytest.raises(ValueError, match="must be finite"):
        memory.update((np.nan, 0.0, 0.0), np.ones(4), np.ones((4, 2)), 10.0)


@given(
    arrays(np.float64, st.tuples(st.integers(0, 5), st.just(4)), elements=places),
    st.floats(0.01, 0.5),
)
def test_sampled_points_are_no_farther_apart_than_the_spacing(segments, spacing):
    points = points_of_segments(segments, spacing)
    assert points.shape[1] == 2
    for row in segments:
        ends = row.reshape(2, 2)
        own = points[shapely.distance(shapely.LineString(ends), shapely.points(points)) < 1e-9]
        along = np.sort(np.linalg.norm(own - ends[0], axis=1))
        assert along[0] < 1e-9
        assert along[-1] == pytest.approx(np.linalg.norm(ends[1] - ends[0]), abs=1e-9)
        assert np.diff(along).max(initial=0.0) <= spacing + 1e-9
