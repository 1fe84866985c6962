"""How much a path driven is like the path meant: cases worked by hand, and the definitions."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from semnav_env.judge.metrics import cls, dtw, ndtw, resampled, sdtw, soft_spl, spl
from semnav_features.frames import FloatArray, path_length, points_to_parent

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
def test_ndtw_is_one_only_for_the_same_path(path: FloatArray, route: FloatArray) -> None:
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
    [
        (True, 10.0, 5.0, 0.5),
        (True, 4.0, 5.0, 1.0),
        (False, 5.0, 5.0, 0.0),
        (True, 0.0, 0.0, 1.0),
        (True, 0.8, 0.0, 1.0),
        (False, 0.8, 0.0, 0.0),
    ],
)
def test_spl_is_success_weighted_by_path_length(
    success: bool, path: float, route: float, expected: float
) -> None:
    assert spl(success, path, route) == expected


@pytest.mark.parametrize(
    ("success", "remaining", "initial", "path", "route", "expected"),
    [
        (True, 0.0, 10.0, 10.0, 10.0, 1.0),
        (False, 5.0, 10.0, 10.0, 10.0, 0.5),
        (False, 5.0, 10.0, 20.0, 10.0, 0.25),
        (False, 12.0, 10.0, 10.0, 10.0, 0.0),
        (True, 0.1, 0.0, 0.1, 0.0, 1.0),
        (False, 1.0, 0.0, 1.0, 0.0, 0.0),
        (True, 0.1, 0.0, 20.0, 10.0, 0.5),
    ],
)
def test_soft_spl_is_progress_weighted_by_path_length(
    success: bool, remaining: float, initial: float, path: float, route: float, expected: float
) -> None:
    """The last one leads there and back."""
    assert soft_spl(success, remaining, initial, path, route) == expected


@given(paths, st.floats(0.1, 2.0))
def test_resampling_keeps_the_ends_and_spaces_evenly(path: FloatArray, spacing: float) -> None:
    points = resampled(path, spacing)
    gaps = np.hypot(*np.diff(points, axis=0).T)
    assert points[0] == pytest.approx(path[0])
    assert points[-1] == pytest.approx(path[-1])
    assert (gaps <= spacing + TOL).all()
    assert path_length(points) <= path_length(path) + TOL
