import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from semnav_features import ExtractorSettings, Scan, extract
from semnav_features.frames import points_to_parent
from semnav_features.kernels.optimal_partition import PIECE_PRICE, partition
from semnav_features.kernels.scratch import allocate_scratch
from tests.numpy_oracle import extract_reference
from tests.support.raycaster import heidelberg, scan_of
from tests.support.strategies import Room, awkward_scans, rooms

DYNAMIC = ExtractorSettings(segmentation="dynamic")
PRICE = 9.0


def scatter(points):
    """Squared distances from the total least squares line."""
    return np.linalg.svd(points - points.mean(axis=0), compute_uv=False)[1:].sum() ** 2


def cost(points, borders, variance):
    pieces = itertools.pairwise((0, *borders, len(points)))
    return sum(scatter(points[a:b]) / variance for a, b in pieces) + PRICE * len(borders)


def cut(points, variance, price=PRICE):
    scratch = allocate_scratch(len(points))
    xs, ys = np.ascontiguousarray(points.T)
    count = partition(xs, ys, 0, len(points) - 1, variance, price, scratch)
    first, *borders, last = scratch.vertices[:count].tolist()
    assert (first, last) == (0, len(points) - 1)
    return tuple(borders)


clouds = arrays(np.float64, st.tuples(st.integers(2, 9), st.just(2)), elements=st.floats(-3, 3))


@settings(max_examples=60, deadline=None)
@given(clouds, st.sampled_from([0.01, 0.3, 2.0]))
def test_no_partition_is_cheaper_than_the_chosen_one(points, variance):
    inner = range(1, len(points))
    every = (c for k in range(len(points)) for c in itertools.combinations(inner, k))
    best = min(cost(points, borders, variance) for borders in every)
    assert cost(points, cut(points, variance), variance) == pytest.approx(best, abs=1e-6)


@settings(max_examples=30, deadline=None)
@given(clouds)
def test_more_noise_never_needs_more_pieces(points):
    counts = [len(cut(points, variance)) for variance in (0.001, 0.01, 0.1, 1.0, 10.0)]
    assert counts == sorted(counts, reverse=True)


@pytest.mark.parametrize("seed", range(5))
def test_a_corner_in_noise_is_cut_within_two_points(seed):
    rng = np.random.default_rng(seed)
    along = np.arange(40) * 0.05
    points = np.array([(x, 0.0) for x in along] + [(along[-1], y + 0.05) for y in along])
    noisy = points + 0.01 * rng.standard_normal(points.shape)
    (border,) = cut(noisy, 0.01**2, PIECE_PRICE)
    assert abs(border - 40) <= 2


def test_straight_points_are_never_cut():
    points = np.stack((np.linspace(-1, 4, 200), np.linspace(2, 3, 200)), axis=1)
    assert cut(points, 1e-6) == ()


@settings(max_examples=20, deadline=None)
@given(rooms(), st.integers(0, 2**32 - 1))
def test_every_wall_of_a_room_is_found_exactly_once(room: Room, seed: int):
    scan = scan_of(room.segments, room.pose, sigma=0.01, rng=np.random.default_rng(seed))
    walls = extract(scan, ExtractorSettings(sigma=0.01, segmentation="dynamic")).walls
    assert 3 <= len(walls) <= 5
    for wall in walls:
        ends = points_to_parent(room.pose, np.array((wall.start, wall.end)))
        sides = np.concatenate((ends, (room.width, room.height) - ends), axis=1)
        assert np.abs(sides).max(axis=0).min() < 0.05


@pytest.mark.parametrize("seed", range(3))
def test_both_segmentations_find_the_same_doors_of_the_hallway(seed):
    segments, _ = heidelberg()
    scan = scan_of(segments, (-2.5, -0.6, 0.25), sigma=0.01, rng=np.random.default_rng(seed))
    plain, best = (extract(scan, chosen).doors for chosen in (ExtractorSettings(), DYNAMIC))
    assert len(plain) == len(best) > 0
    for one, other in zip(plain, best, strict=True):
        assert math.dist(one.midpoint, other.midpoint) < 0.05


@settings(max_examples=20, deadline=None)
@given(rooms(), st.integers(0, 2**32 - 1))
def test_the_kernel_agrees_with_the_reference(room: Room, seed: int):
    scan = scan_of(room.segments, room.pose, sigma=0.02, rng=np.random.default_rng(seed))
    chosen = ExtractorSettings(sigma=0.015, arcs=False, segmentation="dynamic")
    ends, expected = (
        [(*wall.start, *wall.end) for wall in look(scan, chosen).walls]
        for look in (extract, extract_reference)
    )
    assert np.shape(ends) == np.shape(expected)
    assert np.allclose(ends, expected, atol=1e-7)


@settings(max_examples=50, deadline=None)
@given(awkward_scans())
def test_any_scan_gives_a_scene(scan: Scan):
    for wall in extract(scan, DYNAMIC).walls:
        assert all(map(math.isfinite, (*wall.start, *wall.end, wall.residual)))
