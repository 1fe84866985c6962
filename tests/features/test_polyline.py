import itertools
import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from semnav_features import Scan, polylines
from semnav_features.kernels.polyline_refinement import refine_vertices
from semnav_features.kernels.polyline_vertices import choose_vertices

STEP = 0.05
MISSED = 0.4


def beams(count):
    angles = STEP * np.arange(count)
    return np.stack((np.cos(angles), np.sin(angles)), axis=1)


def line_ranges(directions, start, end):
    """Where beams meet the line through two points."""
    along = end - start
    slope = directions[:, 0] * along[1] - directions[:, 1] * along[0]
    with np.errstate(divide="ignore"):
        return (start[0] * end[1] - start[1] * end[0]) / slope


def cost_of(directions, ranges, vertices, chosen, starts):
    """The objective, written down as its definition says."""
    cost = np.full(len(ranges), MISSED**2)
    for k in range(1, len(chosen)):
        if starts[k]:
            continue
        inside = slice(chosen[k - 1], chosen[k] + 1)
        hit = line_ranges(directions[inside], vertices[k - 1], vertices[k])
        if not (hit > 0).all():
            return math.inf
        cost[inside] = (hit - ranges[inside]) ** 2
    return cost.sum()


def every_choice(points, vertices, groups):
    """Every set of polylines with at most so many vertices: their points, and where they start."""
    group = np.repeat(np.arange(len(groups) - 1), np.diff(groups))
    for count in range(vertices + 1):
        for chosen in itertools.combinations(range(points), count):
            for starts in itertools.product((True, False), repeat=count):
                links = [(chosen[k - 1], chosen[k]) for k in range(1, count) if not starts[k]]
                ends = [k + 1 == count or starts[k + 1] for k in range(count)]
                alone = any(s and e for s, e in zip(starts, ends, strict=True))
                joins = any(group[a] != group[b] for a, b in links)
                if (count and not starts[0]) or alone or joins:
                    continue
                yield np.array(chosen, int), np.array(starts, bool)


small_scans = arrays(np.float64, st.integers(2, 7), elements=st.floats(0.5, 3.0))
long_scans = arrays(np.float64, st.integers(10, 40), elements=st.floats(1.0, 1.5))


@settings(max_examples=40, deadline=None)
@given(small_scans, st.integers(2, 5), st.integers(1, 6))
def test_no_choice_of_vertices_is_better_than_the_chosen_one(ranges, vertices, cut):
    points = len(ranges)
    directions = beams(points)
    groups = np.unique(np.clip([0, cut, points], 0, points))
    hits = directions * ranges[:, None]
    best = min(
        cost_of(directions, ranges, hits[chosen], chosen, starts)
        for chosen, starts in every_choice(points, vertices, groups)
    )
    chosen, starts = choose_vertices(directions, ranges, groups, vertices, MISSED)
    assert len(chosen) <= vertices
    assert cost_of(directions, ranges, hits[chosen], chosen, starts) == pytest.approx(best)


@settings(max_examples=30, deadline=None)
@given(long_scans)
def test_more_vertices_never_cost_more(ranges):
    directions = beams(len(ranges))
    groups = np.array([0, len(ranges)])
    costs = []
    for vertices in range(2, 10):
        chosen, starts = choose_vertices(directions, ranges, groups, vertices, MISSED)
        hits = directions[chosen] * ranges[chosen, None]
        costs.append(cost_of(directions, ranges, hits, chosen, starts))
    assert all(b <= a + 1e-9 for a, b in itertools.pairwise(costs))


@settings(max_examples=30, deadline=None)
@given(long_scans, st.integers(3, 9))
def test_refining_never_raises_the_squared_residuals(ranges, vertices):
    directions = beams(len(ranges))
    groups = np.array([0, len(ranges)])
    chosen, starts = choose_vertices(directions, ranges, groups, vertices, MISSED)
    raw = directions[chosen] * ranges[chosen, None]
    refined = refine_vertices(directions, ranges, chosen, starts)
    assert squared(directions, ranges, refined, starts) <= (
        squared(directions, ranges, raw, starts) + 1e-9
    )


def squared(directions, ranges, vertices, starts):
    """Squared residuals of the beams that meet a line, whichever line they meet."""
    angles = np.arctan2(directions[:, 1], directions[:, 0])
    corners = np.arctan2(vertices[:, 1], vertices[:, 0])
    total = 0.0
    for k in range(1, len(vertices)):
        if not starts[k]:
            last = k + 1 == len(vertices) or starts[k + 1]
            inside = (angles >= corners[k - 1] - 1e-9) & (
                (angles <= corners[k] + 1e-9) if last else (angles < corners[k])
            )
            hit = line_ranges(directions[inside], vertices[k - 1], vertices[k])
            total += ((hit - ranges[inside]) ** 2).sum()
    return total


def corner_of_a_room(noise=None):
    """The scan of two walls, from (2, -1) to the corner (2, 1.5) and on to (-1, 1.5)."""
    angles = np.arange(-0.4, 2.4, 0.01)
    directions = np.stack((np.cos(angles), np.sin(angles)), axis=1)
    first = line_ranges(directions, np.array([2.0, -1.0]), np.array([2.0, 1.5]))
    second = line_ranges(directions, np.array([2.0, 1.5]), np.array([-1.0, 1.5]))
    ranges = np.where(angles < math.atan2(1.5, 2.0), first, second)
    if noise is not None:
        ranges = ranges + 0.01 * noise.standard_normal(len(ranges))
    return Scan(ranges, angles[0], 0.01)


def test_three_vertices_find_a_corner_between_two_beams():
    (line,) = polylines(corner_of_a_room(), 3)
    assert line[1] == pytest.approx((2.0, 1.5), abs=2e-3)


@pytest.mark.parametrize("seed", range(5))
def test_noise_moves_a_corner_by_less_than_itself(seed):
    scan = corner_of_a_room(np.random.default_rng(seed))
    (line,) = polylines(scan, 3)
    assert line[1] == pytest.approx((2.0, 1.5), abs=0.01)


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 10_000), st.integers(2, 8))
def test_mirroring_the_scan_mirrors_the_polylines(seed, vertices):
    rng = np.random.default_rng(seed)
    ranges = 2.0 + 0.1 * np.cumsum(rng.standard_normal(30)).clip(-9, 9)
    forth = polylines(Scan(ranges, -14.5 * STEP, STEP), vertices, refine=False)
    back = polylines(Scan(ranges[::-1], -14.5 * STEP, STEP), vertices, refine=False)
    assume(sum(map(len, forth)) == sum(map(len, back)) == vertices)
    mirrored = [line[::-1] * (1, -1) for line in reversed(back)]
    assert np.concatenate(forth) == pytest.approx(np.concatenate(mirrored))


@pytest.mark.parametrize("gap", [{"missing": 1}, {"behind": 1.2}])
def test_no_line_crosses_an_open_door(gap):
    angles = np.arange(-0.6, 0.6, 0.02)
    ranges = 3.0 / np.cos(angles)
    door = abs(angles) < 0.16
    ranges[door] = np.nan if "missing" in gap else ranges[door] + gap["behind"]
    for line in polylines(Scan(ranges, -0.6, 0.02), 12):
        sides = np.arctan2(line[:, 1], line[:, 0])
        assert (sides <= -0.15).all() or (sides >= 0.15).all() or (line[:, 0] > 3.5).all()


@pytest.mark.parametrize("ranges", [[math.nan] * 5, [0.0, 2.0, 0.0], [1.0, 5.0, 1.0, 5.0]])
def test_a_scan_without_neighbours_has_no_polylines(ranges):
    assert polylines(Scan(ranges, 0.0, 0.1)) == ()


@pytest.mark.parametrize("bad", [{"vertices": 1}, {"missed": 0.0}, {"link": math.inf}])
def test_a_limit_out_of_range_is_named(bad):
    with pytest.raises(ValueError, match=next(iter(bad))):
        polylines(corner_of_a_room(), **bad)
