"""The steps of Mes 2021, each against its definition."""

import itertools
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from semnav_features.clouds import (
    CropBox,
    crop,
    euclidean_clusters,
    pair_apart,
    plane_inliers,
    remove_outliers,
    upright_line,
    voxel_grid,
)
from semnav_features.clouds.upright_line import UprightLine
from tests.support.door_clouds import DOOR, turned, turned_door

COORDINATES = st.integers(-200, 200).map(lambda value: value / 100)


def clouds(most=40):
    return st.integers(0, most).flatmap(lambda n: arrays(np.float64, (n, 3), elements=COORDINATES))


@given(clouds(), st.integers(1, 60), st.floats(-1.0, 2.0))
def test_outliers_are_those_of_the_definition(points, neighbours, alpha):
    kept = remove_outliers(points, neighbours, alpha)
    k = min(neighbours, len(points) - 1)
    if k < 1:
        assert np.array_equal(kept, points)
        return
    gaps = np.linalg.norm(points[:, None] - points[None], axis=2)
    mean = np.sort(gaps, axis=1)[:, 1 : k + 1].mean(axis=1)
    limit = mean.mean() + alpha * mean.std()
    sure = np.abs(mean - limit) > 1e-9
    chosen = {tuple(point) for point in kept}
    assert {tuple(p) for p in points[sure & (mean <= limit)]} <= chosen
    assert len(kept) >= (sure & (mean <= limit)).sum()
    assert len(kept) <= len(points) - (sure & (mean > limit)).sum()


@given(clouds(), st.floats(0.02, 1.0))
def test_a_voxel_grid_keeps_the_centroid_of_each_voxel(points, leaf):
    voxels = voxel_grid(points, leaf)
    if len(points) == 0:
        assert len(voxels) == 0
        return
    cells = np.floor((points - points.min(axis=0)) / leaf)
    unique, inverse = np.unique(cells, axis=0, return_inverse=True)
    expected = [points[inverse.ravel() == k].mean(axis=0) for k in range(len(unique))]
    assert np.allclose(sorted(voxels.tolist()), sorted(np.array(expected).tolist()))


@given(clouds(), st.floats(0.05, 2.0))
def test_clusters_hang_together_and_lie_apart(points, tolerance):
    clusters = euclidean_clusters(points, tolerance, smallest=1, largest=1000)
    assert sum(map(len, clusters)) == len(points)
    for one, other in itertools.combinations(clusters, 2):
        assert np.linalg.norm(one[:, None] - other[None], axis=2).min() > tolerance
    for cluster in clusters:
        reached, left = [cluster[0]], list(cluster[1:])
        while left:
            gaps = [min(np.linalg.norm(p - q) for q in reached) for p in left]
            assert min(gaps) <= tolerance
            reached.append(left.pop(int(np.argmin(gaps))))


def test_clusters_that_are_too_small_or_too_large_are_left_out():
    line = np.column_stack((np.arange(50) * 0.05, np.zeros(50), np.zeros(50)))
    groups = np.concatenate([np.add(line[:n], (0, y, 0)) for n, y in ((4, 0), (20, 5), (50, 10))])
    assert [len(c) for c in euclidean_clusters(groups, smallest=5, largest=30)] == [20]


@given(st.floats(-3.0, 3.0), st.integers(0, 2**32 - 1))
def test_the_plane_with_the_most_points_is_found(turn, seed):
    rng = np.random.default_rng(seed)
    wall = np.column_stack((np.full(300, 2.0), rng.uniform(-1, 1, 300), rng.uniform(0, 2, 300)))
    clutter = rng.uniform((-3, -3, 0), (-1, 3, 2), (80, 3))
    points = turned(np.concatenate((wall, clutter)), turn)
    inliers = plane_inliers(points, rng)
    assert inliers[:300].all()
    assert inliers[300:].mean() < 0.7


@given(st.integers(0, 10), st.integers(0, 2**32 - 1))
def test_points_on_one_line_make_no_plane(count, seed):
    points = np.outer(np.arange(count), (0.1, 0.2, 0.3))
    assert not plane_inliers(points, np.random.default_rng(seed)).any()


def test_the_upright_line_is_found_among_points_of_a_floor():
    rng = np.random.default_rng(3)
    post = np.column_stack((np.full(40, 1.0), np.full(40, 2.0), rng.uniform(0, 1, 40)))
    floor = np.column_stack((rng.uniform(0, 2, (30, 2)), np.zeros(30)))
    line = upright_line(np.concatenate((post, floor)), rng)
    assert line is not None
    assert math.dist(line.point, (1.0, 2.0)) < 0.05
    assert line.high - line.low > 0.8
    assert upright_line(floor, rng) is None


@given(st.lists(st.tuples(st.floats(-2, 2), st.floats(-2, 2)), max_size=8))
def test_the_pair_is_the_one_nearest_to_the_width(places):
    lines = [UprightLine(place, 0.0, 1.0, 10) for place in places]
    pair = pair_apart(lines)
    gaps = [abs(math.dist(p, q) - 0.90) for p, q in itertools.combinations(places, 2)]
    if pair is None:
        assert all(gap > 0.15 for gap in gaps)
    else:
        assert abs(math.dist(pair[0].point, pair[1].point) - 0.90) == min(gaps) <= 0.15


@given(st.floats(-3.0, 3.0), st.floats(-5.0, 5.0))
def test_the_crop_turns_and_moves_with_the_door(turn, shift):
    points = np.random.default_rng(0).uniform((1, -1, 0), (3, 1, 2.5), (400, 3))
    here = crop(points, DOOR, 0.05)
    there = crop(turned(points, turn, (shift, 1.0)), turned_door(DOOR, turn, (shift, 1.0)), 0.05)
    assert np.allclose(turned(here, turn, (shift, 1.0)), there)
    assert 0 < len(here) < 400


def test_the_crop_grows_with_the_uncertainty():
    points = np.random.default_rng(0).uniform((1, -1, 0), (3, 1, 2.5), (400, 3))
    sizes = [len(crop(points, DOOR, sigma)) for sigma in (0.0, 0.1, 0.3)]
    assert sizes == sorted(sizes)
    assert len(crop(points, DOOR, 1e6)) == ((points[:, 2] >= 0.1) & (points[:, 2] <= 1.9)).sum()
    assert len(crop(points, DOOR, 0.1, CropBox(low=3.0, high=4.0))) == 0


def test_bad_arguments_of_the_steps_are_named():
    points = np.zeros((5, 3))
    with pytest.raises(ValueError, match="leaf is 0"):
        voxel_grid(points, 0.0)
    with pytest.raises(ValueError, match="neighbours is 0"):
        remove_outliers(points, 0)
    with pytest.raises(ValueError, match="sigma is nan"):
        crop(points, DOOR, math.nan)
