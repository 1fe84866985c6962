"""The measures of episodes, on cases worked by hand and against their definitions."""

from __future__ import annotations

import math
from dataclasses import asdict, replace
from functools import cache

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from semnav_env.commands import parse
from semnav_env.features.frames import FloatArray, path_length, points_to_parent
from semnav_env.maps import load_floor_plan
from semnav_env.maps.geodesic import Geodesic
from semnav_env.metrics import (
    COLUMNS,
    HIGH_IS_BAD,
    Metrics,
    Recording,
    clearances,
    cls,
    collisions_per_100m,
    cvar,
    dtw,
    means,
    measure,
    ndtw,
    resampled,
    rms_jerk,
    sdtw,
    soft_spl,
    spl,
    worst,
)
from semnav_env.robots import SPOT
from semnav_env.verifier import Verifier
from tests.erring import ghost
from tests.small_plans import empty_hall, plan_of

ROUTE = np.array([(0.0, 0.0), (1.0, 0.0), (2.0, 1.0), (3.0, 2.0)])
STRAIGHT = np.array([(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (3.0, 0.0)])
TOL = 1e-9


def warped(path: FloatArray, route: FloatArray) -> float:
    """DTW as it is defined: the least sum over all alignments, by recursion on the first pairs."""

    @cache
    def least(i: int, j: int) -> float:
        apart = math.dist(route[i], path[j])
        last = i == len(route) - 1, j == len(path) - 1
        if all(last):
            return apart
        onward = [] if last[0] else [least(i + 1, j)]
        onward += [] if last[1] else [least(i, j + 1)]
        onward += [] if any(last) else [least(i + 1, j + 1)]
        return apart + min(onward)

    return least(0, 0)


decimetres = hnp.arrays(
    np.int64, st.tuples(st.integers(1, 12), st.just(2)), elements=st.integers(-200, 200)
)
paths = decimetres.map(lambda array: array / 10.0)
transforms = st.tuples(st.floats(-9, 9), st.floats(-9, 9), st.floats(-3, 3))


def test_the_published_example_of_ndtw() -> None:
    """Of the code of Ilharco et al. 2019: DTW 3, nDTW exp(-1/4), for these four nodes each."""
    assert dtw(STRAIGHT, ROUTE) == pytest.approx(3.0)
    assert ndtw(STRAIGHT, ROUTE) == pytest.approx(0.77880078307140488)
    assert sdtw(True, STRAIGHT, ROUTE) == pytest.approx(0.77880078307140488)
    assert sdtw(False, STRAIGHT, ROUTE) == 0.0


def test_dtw_of_a_detour_worked_by_hand() -> None:
    """(0,0) and (2,0) match exactly; (1,1) goes to either end, sqrt(2) away."""
    detour = np.array([(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)])
    ends = np.array([(0.0, 0.0), (2.0, 0.0)])
    assert dtw(detour, ends) == pytest.approx(math.sqrt(2.0))
    assert ndtw(detour, ends, threshold=2.0) == pytest.approx(math.exp(-math.sqrt(2.0) / 4.0))


@given(paths, paths, st.floats(0.5, 5.0))
def test_ndtw_is_its_definition(path: FloatArray, route: FloatArray, threshold: float) -> None:
    expected = math.exp(-warped(path, route) / (len(route) * threshold))
    assert dtw(path, route) == pytest.approx(warped(path, route))
    assert ndtw(path, route, threshold) == pytest.approx(expected, abs=TOL)
    assert sdtw(True, path, route, threshold) == pytest.approx(expected, abs=TOL)


@given(paths, paths)
def test_ndtw_lies_between_zero_and_one_and_is_one_only_for_the_same_path(
    path: FloatArray, route: FloatArray
) -> None:
    value = ndtw(path, route)
    assert 0.0 <= value <= 1.0
    apart = dtw(path, route)
    assert (apart == 0.0) == (_distinct(path) == _distinct(route))
    assert (value == 1.0) == (apart == 0.0)


def _distinct(path: FloatArray) -> list[tuple[float, ...]]:
    """The points of a path without repetitions in a row."""
    rows = [tuple(row) for row in path.tolist()]
    return [row for i, row in enumerate(rows) if i == 0 or row != rows[i - 1]]


@given(paths, st.lists(st.integers(0, 11), max_size=5))
def test_to_linger_on_the_route_costs_nothing(path: FloatArray, stays: list[int]) -> None:
    rows = sorted([*range(len(path)), *(stay % len(path) for stay in stays)])
    assert ndtw(path[rows], path) == 1.0


@given(paths, paths, transforms)
def test_ndtw_and_cls_do_not_depend_on_the_frame(
    path: FloatArray, route: FloatArray, frame: tuple[float, float, float]
) -> None:
    moved = points_to_parent(frame, path), points_to_parent(frame, route)
    for score in (ndtw, cls):
        assert score(*moved) == pytest.approx(score(path, route), abs=1e-6)


@given(paths, paths)
def test_driven_and_meant_backwards_the_two_are_as_much_alike(
    path: FloatArray, route: FloatArray
) -> None:
    assert dtw(path[::-1], route[::-1]) == pytest.approx(dtw(path, route))
    assert dtw(route, path) == pytest.approx(dtw(path, route))


def test_cls_worked_by_hand() -> None:
    """All of the route is within 1 m: coverage (1 + 1/e^(1/3)) / 2; the path is 3 m of 3 m."""
    route = np.array([(0.0, 0.0), (3.0, 0.0)])
    path = np.array([(0.0, 0.0), (3.0, 1.0)])
    coverage = (1.0 + math.exp(-1.0 / 3.0)) / 2.0
    expected = coverage * 3.0
    score = expected / (expected + abs(expected - math.sqrt(10.0)))
    assert cls(path, route) == pytest.approx(coverage * score)


@given(paths, paths)
def test_cls_lies_between_zero_and_one_and_is_one_on_the_route(
    path: FloatArray, route: FloatArray
) -> None:
    assert 0.0 <= cls(path, route) <= 1.0
    assert cls(route, route) == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("success", "path", "route", "expected"),
    [(True, 10.0, 5.0, 0.5), (True, 4.0, 5.0, 1.0), (False, 5.0, 5.0, 0.0), (True, 0.0, 0.0, 1.0)],
)
def test_spl_is_success_weighted_by_path_length(
    success: bool, path: float, route: float, expected: float
) -> None:
    assert spl(success, path, route) == expected


@pytest.mark.parametrize(
    ("remaining", "initial", "path", "route", "expected"),
    [
        (0.0, 10.0, 10.0, 10.0, 1.0),
        (5.0, 10.0, 10.0, 10.0, 0.5),
        (5.0, 10.0, 20.0, 10.0, 0.25),
        (12.0, 10.0, 10.0, 10.0, 0.0),
        (0.0, 0.0, 0.0, 0.0, 1.0),
        (1.0, 0.0, 1.0, 0.0, 0.0),
    ],
)
def test_soft_spl_is_progress_weighted_by_path_length(
    remaining: float, initial: float, path: float, route: float, expected: float
) -> None:
    assert soft_spl(remaining, initial, path, route) == expected


@given(paths, st.floats(0.1, 2.0))
def test_resampling_keeps_the_ends_and_spaces_evenly(path: FloatArray, spacing: float) -> None:
    points = resampled(path, spacing)
    gaps = np.hypot(*np.diff(points, axis=0).T)
    assert points[0] == pytest.approx(path[0])
    assert points[-1] == pytest.approx(path[-1])
    assert (gaps <= spacing + TOL).all()
    assert path_length(points) <= path_length(path) + TOL


def test_jerk_worked_by_hand() -> None:
    times = np.arange(20) * 0.1
    cubic = np.column_stack((3.0 * times**3, np.zeros(20)))
    assert rms_jerk(cubic, 0.1) == pytest.approx(18.0)
    assert rms_jerk(np.column_stack((times**2, -times)), 0.1) == pytest.approx(0.0, abs=1e-6)
    assert rms_jerk(cubic[:3], 0.1) == 0.0


def test_clearance_is_that_of_the_body_worked_by_hand() -> None:
    """SPOT is 1.1 x 0.5 m, the hall 10 x 6 m."""
    poses = np.array([(5.0, 3.0, 0.0), (5.0, 1.0, 0.0), (5.0, 1.0, math.pi / 2), (0.4, 3.0, 0.0)])
    found = clearances(poses, SPOT, empty_hall(10.0, 6.0))
    assert found == pytest.approx([2.75, 0.75, 0.45, 0.0])


def test_clearance_is_bounded_where_nothing_is_solid() -> None:
    assert clearances(np.zeros((2, 3)), SPOT, plan_of()) == pytest.approx([10.0, 10.0])


def test_collisions_are_per_hundred_metres() -> None:
    assert collisions_per_100m(2, 50.0) == 4.0
    assert collisions_per_100m(2, 0.0) == 200.0


@pytest.mark.parametrize(
    ("share", "high_is_bad", "expected"),
    [
        (1.0, False, 5.5),
        (0.1, False, 1.0),
        (0.1, True, 10.0),
        (0.2, False, 1.5),
        (0.25, False, (1.0 + 2.0 + 0.5 * 3.0) / 2.5),
        (0.01, False, 1.0),
    ],
)
def test_cvar_of_one_to_ten_worked_by_hand(
    share: float, high_is_bad: bool, expected: float
) -> None:
    values = np.random.default_rng(0).permutation(np.arange(1.0, 11.0))
    assert cvar(values, share, high_is_bad) == pytest.approx(expected)


def test_a_mean_of_98_percent_hides_a_worst_percent_that_never_succeeds() -> None:
    successes = [True] * 98 + [False] * 2
    assert np.mean(successes) == 0.98
    assert cvar(successes, 0.01) == 0.0
    assert cvar(successes, 0.05) == pytest.approx(0.6)


@given(hnp.arrays(np.float64, st.integers(1, 40), elements=st.floats(-5, 5)), st.floats(0.001, 1.0))
def test_cvar_is_no_better_than_the_mean_and_no_worse_than_the_worst(
    values: FloatArray, share: float
) -> None:
    assert values.min() - TOL <= cvar(values, share) <= values.mean() + TOL
    assert cvar(-values, share, high_is_bad=True) == pytest.approx(-cvar(values, share))


def test_cvar_of_nothing_and_of_an_odd_share_are_errors() -> None:
    with pytest.raises(ValueError, match="at least one"):
        cvar([], 0.1)
    with pytest.raises(ValueError, match="share is 0"):
        cvar([1.0], 0.0)


PLAN = load_floor_plan("office_cross")
GEODESIC = Geodesic(PLAN)
START = (1.3, 9.1, 0.0)


def glided(command: str, *points: tuple[float, float]) -> tuple[Verifier, Metrics]:
    judge = Verifier(PLAN, GEODESIC, parse(command), START)
    recording = ghost(judge, list(points), np.random.default_rng(0))
    return judge, measure(recording, judge, SPOT)


def test_the_neighbouring_door_is_near_and_yet_no_success() -> None:
    """What success within 3 m would hide: 3.4 and 5.8 m along the corridor are two doors."""
    judge, found = glided("go through the second door on the right", (3.4, 8.6), (3.4, 7.0))
    assert judge.crossed == ["west_south_1"]
    assert not found.success
    assert not found.oracle_success
    assert found.spl == found.sdtw == found.clauses == 0.0
    assert 0.0 < found.goal_distance < 5.0
    assert found.soft_spl > 0.0
    assert 0.0 < found.ndtw < 1.0


def test_to_pass_the_goal_is_success_only_for_the_oracle() -> None:
    """A wrong room first: the episode has failed when the right door is crossed."""
    judge = Verifier(PLAN, GEODESIC, parse("go through the first door on the right"), START)
    path = [START[:2], (3.4, 9.0), (3.4, 7.0)]
    poses = np.array([(x, y, -math.pi / 2) for x, y in path])
    rows = len(poses)
    recording = Recording(poses, np.ones((rows, 3)), np.zeros(rows, int), np.zeros(rows), 1 / 15)
    found = measure(recording, judge, SPOT)  # of a verifier that was told of no step
    assert not found.success
    assert found.oracle_success
    assert found.oracle_within_1m
    assert found.oracle_within_3m
    assert found.within_3m


def test_a_robot_that_never_leaves_its_start_has_waited_nowhere_else() -> None:
    command = "go through the second door on the left and wait for 2 seconds"
    judge = Verifier(PLAN, GEODESIC, parse(command), START)
    there = judge.planned_goals[-1].pose
    rows = 31  # two seconds
    for place, met in ((START, False), (there, True)):
        still = np.zeros((rows, 3))
        poses = np.tile(np.array(place), (rows, 1))
        recording = Recording(poses, still, np.zeros(rows, int), np.zeros(rows), 1 / 15)
        assert measure(recording, judge, SPOT).oracle_success is met


def test_the_shortest_way_scores_near_one_everywhere() -> None:
    judge = Verifier(PLAN, GEODESIC, parse("go through the fourth door on the left"), START)
    recording = ghost(judge, [judge.planned_goals[0].pose[:2]], np.random.default_rng(0))
    found = measure(recording, judge, SPOT)
    assert judge.success
    assert found.success
    assert found.clauses == 1.0
    assert found.within_1m
    assert found.contact_free
    assert min(found.spl, found.soft_spl, found.ndtw, found.sdtw, found.cls) > 0.95


def test_success_of_the_measures_is_the_verifiers() -> None:
    for x in (3.4, 6.0):
        judge, found = glided("go through the first door on the right", (x, 8.6), (x, 7.0))
        assert found.success == judge.success


def test_the_mean_of_all_is_the_mean_and_the_worst_are_worse() -> None:
    _, good = glided("go through the first door on the right", (3.4, 8.6), (3.4, 7.0))
    _, bad = glided("go through the second door on the right", (3.4, 8.6), (3.4, 7.0))
    average, tail = means([good, bad]), worst([good, bad], 0.5)
    assert set(average) == set(COLUMNS) == set(asdict(good))
    for name in COLUMNS:
        a, b = float(getattr(good, name)), float(getattr(bad, name))
        if name != "collisions_per_100m":
            assert average[name] == pytest.approx((a + b) / 2)
        assert tail[name] == pytest.approx(max(a, b) if name in HIGH_IS_BAD else min(a, b))


def test_mean_collisions_per_100m_are_those_of_the_whole_way() -> None:
    """One of 1 m with a collision, one of 99 m without: 1 per 100 m, not 50."""
    _, found = glided("go through the first door on the right", (3.4, 8.6), (3.4, 7.0))
    short = replace(found, collisions=1, path_length=1.0, collisions_per_100m=100.0)
    far = replace(found, collisions=0, path_length=99.0, collisions_per_100m=0.0)
    assert means([short, far])["collisions_per_100m"] == pytest.approx(1.0)


def test_a_recording_survives_a_file(tmp_path) -> None:  # type: ignore[no-untyped-def]
    judge = Verifier(PLAN, GEODESIC, parse("go through the first door on the right"), START)
    recording = ghost(judge, [(3.4, 7.0)], np.random.default_rng(0))
    recording.save(tmp_path / "a.npz")
    again = Recording.load(tmp_path / "a.npz")
    assert np.array_equal(again.poses, recording.poses)
    assert again.period == recording.period
    assert again.seconds == recording.seconds


def test_arrays_that_do_not_fit_are_named() -> None:
    with pytest.raises(ValueError, match="velocities of a recording has shape"):
        Recording(np.zeros((3, 3)), np.zeros((2, 3)), np.zeros(3, int), np.zeros(3), 0.1)
    with pytest.raises(ValueError, match="poses of a recording"):
        Recording(np.full((1, 3), np.nan), np.zeros((1, 3)), np.zeros(1, int), np.zeros(1), 0.1)
    with pytest.raises(ValueError, match="period"):
        Recording(np.zeros((1, 3)), np.zeros((1, 3)), np.zeros(1, int), np.zeros(1), 0.0)


@pytest.mark.parametrize(
    ("people", "leaves", "name"),
    [
        (np.zeros((2, 4)), None, "people"),
        (np.zeros((2, 4, 2)), None, "people"),
        (np.zeros((3, 4, 3)), None, "people"),
        (np.full((2, 1, 3), np.nan), None, "people"),
        (None, np.zeros((2, 2)), "leaves"),
        (None, np.full((1, 4), np.inf), "leaves"),
    ],
)
def test_people_and_leaves_that_do_not_fit_are_named(
    people: FloatArray | None, leaves: FloatArray | None, name: str
) -> None:
    two = np.zeros((2, 3)), np.zeros((2, 3)), np.zeros(2, int), np.zeros(2)
    Recording(*two, 0.1, np.zeros((2, 0, 3)), np.zeros((0, 4)))
    with pytest.raises(ValueError, match=f"{name} of a recording has shape"):
        Recording(*two, 0.1, people, leaves)
