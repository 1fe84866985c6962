"""Cutting where the curvature function with adaptive arms peaks."""

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from semnav_features import CornerKind, ExtractorSettings, Scan, extract
from semnav_features.frames import points_to_parent
from semnav_features.kernels.curvature import MIN_TURN, cut_where_it_turns
from semnav_features.kernels.scratch import allocate_scratch
from tests.numpy_oracle import extract_reference
from tests.support.raycaster import polyline, scan_of
from tests.support.strategies import Opening, Room, awkward_scans, openings, rooms

CURVATURE = ExtractorSettings(segmentation="curvature")
SIGMA = CURVATURE.sigma
seeds = st.integers(0, 2**32 - 1)


def cuts_of(points, chosen=CURVATURE):
    """The points at which a group is cut, without its ends."""
    scratch = allocate_scratch(len(points))
    xs, ys = np.ascontiguousarray(points.T)
    count = cut_where_it_turns(xs, ys, 0, len(points) - 1, chosen.as_record()[0], scratch)
    first, *cuts, last = scratch.vertices[:count].tolist()
    assert (first, last) == (0, len(points) - 1)
    assert cuts == sorted(set(cuts))
    return cuts


def bent(turn, spacing=0.02, length=1.0):
    """Points along two lines of equal length, and the index of the point where they meet."""
    along = np.arange(spacing, length, spacing)
    second = along[:, None] * (math.cos(turn), math.sin(turn))
    first = np.stack((-along[::-1], np.zeros_like(along)), axis=1)
    return np.concatenate((first, [(0.0, 0.0)], second)), len(along)


@settings(max_examples=60, deadline=None)
@given(st.floats(-2.5, 2.5), st.floats(0.005, 0.05), st.floats(-math.pi, math.pi))
def test_a_bend_is_cut_where_it_is_if_it_turns_enough(turn, spacing, heading):
    points, corner = bent(turn, spacing)
    c, s = math.cos(heading), math.sin(heading)
    cuts = cuts_of(points @ ((c, s), (-s, c)), ExtractorSettings(split_distance=0.3, sigma=0.001))
    if abs(turn) > 1.05 * MIN_TURN:
        assert cuts == [corner]
    elif abs(turn) < 0.95 * MIN_TURN:
        assert cuts == []


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("turn", [0.7, -1.57])
def test_in_noise_a_corner_is_cut_once_and_near_its_place(seed, turn):
    points, corner = bent(turn)
    noisy = points + 0.5 * SIGMA * np.random.default_rng(seed).standard_normal(points.shape)
    cuts = cuts_of(noisy)
    assert min(abs(cut - corner) for cut in cuts) <= 4
    assert len(cuts) <= 2


def test_a_straight_line_is_never_cut_however_finely_it_is_seen():
    for spacing in (0.002, 0.02, 0.2):
        assert cuts_of(bent(0.0, spacing, 3.0)[0]) == []


def test_a_curve_is_cut_into_chords_that_stay_near_it():
    angles = np.linspace(0.0, math.pi, 200)
    points = np.stack((np.cos(angles), np.sin(angles)), axis=1)
    borders = [0, *cuts_of(points), len(points) - 1]
    for a, b in itertools.pairwise(borders):
        sagitta = 1.0 - math.cos(0.5 * (angles[b] - angles[a]))
        assert sagitta <= CURVATURE.split_distance + 1e-3


@settings(max_examples=40, deadline=None)
@given(st.integers(3, 60), seeds)
def test_points_in_reverse_are_cut_at_the_same_places(count, seed):
    rng = np.random.default_rng(seed)
    points = np.cumsum(rng.normal((0.05, 0.0), 0.1, (count, 2)), axis=0)
    back = [count - 1 - cut for cut in cuts_of(points[::-1])[::-1]]
    assert back == cuts_of(points)


@settings(max_examples=30, deadline=None)
@given(rooms(), seeds)
def test_every_wall_of_a_room_is_found_once(room: Room, seed: int):
    scan = scan_of(room.segments, room.pose, sigma=0.01, rng=np.random.default_rng(seed))
    walls = extract(scan, ExtractorSettings(sigma=0.01, segmentation="curvature")).walls
    assert 3 <= len(walls) <= 5
    for wall in walls:
        ends = points_to_parent(room.pose, np.array((wall.start, wall.end)))
        sides = np.concatenate((ends, (room.width, room.height) - ends), axis=1)
        assert np.abs(sides).max(axis=0).min() < 0.05


@settings(max_examples=30, deadline=None)
@given(openings(0.5, 2.5), seeds)
def test_the_kernel_agrees_with_the_reference(opening: Opening, seed: int):
    rng = np.random.default_rng(seed)
    scan = scan_of(opening.segments, opening.pose, 271, sigma=0.01, rng=rng)
    chosen = ExtractorSettings(sigma=0.015, arcs=False, segmentation="curvature")
    ends, expected = (
        [(*wall.start, *wall.end) for wall in look(scan, chosen).walls]
        for look in (extract, extract_reference)
    )
    assert np.shape(ends) == np.shape(expected)
    assert np.allclose(ends, expected, atol=1e-7)


def test_a_bend_too_flat_for_end_point_fit_is_a_corner():
    """Thirty degrees over two short walls: the chord is nowhere off by the split distance."""
    segments = polyline((2.0, -0.27), (2.0, 0.0), (1.865, 0.234))
    scan = scan_of(segments, (0.0, 0.0, 0.0))
    told = {"sigma": 0.002, "merge_offset": 0.0, "arcs": False, "corner_angle": math.radians(25.0)}
    plain, curved = (
        extract(scan, ExtractorSettings(segmentation=name, **told))
        for name in ("end_point_fit", "curvature")
    )
    assert len(plain.walls) == 1
    assert [corner.kind for corner in curved.corners].count(CornerKind.OUTER) == 1


@settings(max_examples=60, deadline=None)
@given(awkward_scans())
def test_any_scan_gives_a_scene(scan: Scan):
    for wall in extract(scan, CURVATURE).walls:
        assert all(map(math.isfinite, (*wall.start, *wall.end, wall.residual)))
