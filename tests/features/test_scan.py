from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given

from semnav_features import Scan
from semnav_features.scan import plain_codes
from tests.support.strategies import awkward_scans


@given(awkward_scans())
def test_a_valid_range_is_positive_and_within_the_limits(scan: Scan) -> None:
    for distance, valid in zip(scan.ranges, scan.valid, strict=True):
        assert valid == (distance > 0.0 and scan.range_min <= distance < scan.range_max)


def test_angles_run_counter_clockwise_from_angle_min() -> None:
    scan = Scan([1, 2, 3], angle_min=-0.5, angle_increment=0.25)
    assert scan.angles.tolist() == [-0.5, -0.25, 0.0]


def test_the_ranges_are_a_copy_that_cannot_be_written() -> None:
    given_ranges = np.array([1.0, 2.0])
    scan = Scan(given_ranges, 0.0, 0.1)
    given_ranges[0] = 9.0
    assert scan.ranges[0] == 1.0
    with pytest.raises(ValueError, match="read-only"):
        scan.ranges[0] = 5.0


@pytest.mark.parametrize("dtype", [np.float32, np.float16, np.int16, np.uint8])
def test_any_real_dtype_is_accepted(dtype: type) -> None:
    assert Scan(np.array([1, 2, 3], dtype), 0.0, 0.1).ranges.dtype == np.float64


@pytest.mark.parametrize(
    ("ranges", "message"),
    [
        ([], "at least one beam"),
        ([[1.0, 2.0]], "one-dimensional"),
        (1.0, "one-dimensional"),
        (["a"], "real numbers"),
        ([1j], "real numbers"),
        ([True, False], "real numbers"),
        ([1500.0, 2500.0, 3000.0], "millimetres"),
    ],
)
def test_bad_ranges_are_refused_with_the_reason(ranges: object, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        Scan(ranges, 0.0, 0.1)  # type: ignore[arg-type]


WALL_AHEAD = 2.0 / np.cos(np.radians(np.arange(-35, 36)))
"""Metres, as 71 beams see a wall 2 m ahead."""

CODES = [9.99e2, 9999.0, 65535.0, 1e9, float(np.finfo(np.float32).max), np.inf]
"""Numbers that drivers send for "no return"."""


@pytest.mark.parametrize("code", CODES)
@pytest.mark.parametrize("beams", [0, 10, 100, 1000])
def test_a_number_that_means_no_return_is_not_taken_for_millimetres(code, beams) -> None:
    scan = Scan(np.append(WALL_AHEAD, np.full(beams, code)), 0.0, 0.005)
    assert scan.valid.sum() == len(WALL_AHEAD)
    assert not Scan(np.full(100, code), 0.0, 0.01).valid.any()


@pytest.mark.parametrize("code", [0.0, *CODES])
@pytest.mark.parametrize("resolution", [1.0, 10.0])
def test_millimetres_are_refused_whatever_means_no_return(code, resolution) -> None:
    whole = np.round(1000.0 * WALL_AHEAD / resolution) * resolution
    for beams in (0, 10, 100, 1000):
        with pytest.raises(ValueError, match="look like millimetres"):
            Scan(np.append(whole, np.full(beams, code)), 0.0, 0.005)


@pytest.mark.parametrize(
    ("numbers", "message"),
    [
        ({"angle_increment": 0.0}, "angle between two beams"),
        ({"angle_min": -135.0}, "radians"),
        ({"angle_min": 90.0, "angle_increment": -0.5}, "radians"),
        ({"angle_increment": math.nan}, "finite"),
        ({"angle_min": math.inf}, "finite"),
        ({"range_min": -1.0}, "range_min"),
        ({"range_min": 10.0, "range_max": 10.0}, "range_max"),
        ({"range_max": 10000.0}, "millimetres"),
    ],
)
def test_bad_numbers_are_refused_with_the_reason(numbers: dict[str, float], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        Scan([1.0], **{"angle_min": 0.0, "angle_increment": 0.1, **numbers})  # type: ignore[arg-type]


@given(awkward_scans())
def test_a_clockwise_sweep_is_the_same_scan_turned_over(scan: Scan) -> None:
    again = Scan(scan.ranges[::-1], float(scan.angles[-1]), -scan.angle_increment)
    np.testing.assert_array_equal(again.ranges, scan.ranges)
    np.testing.assert_allclose(again.angles, scan.angles, atol=1e-9)
    assert again.angle_increment > 0


@pytest.mark.parametrize(("beams", "degrees"), [(1081, 0.25), (720, 0.5), (360, 1.0), (60, 4.5)])
def test_an_increment_in_degrees_is_refused(beams: int, degrees: float) -> None:
    with pytest.raises(ValueError, match="not degrees"):
        Scan(np.ones(beams), 0.0, degrees)


@pytest.mark.parametrize("beams", [720, 721, 725, 1079, 1080, 1081])
def test_a_full_circle_may_repeat_beams(beams: int) -> None:
    scan = Scan(np.ones(beams), -math.pi, 2.0 * math.pi / 720.0)
    assert len(scan.angles) == beams


def test_read_only_arrays_and_views_are_accepted() -> None:
    ranges = np.arange(1.0, 7.0)
    ranges.setflags(write=False)
    assert Scan(ranges[::-2], 0.0, 0.1).ranges.tolist() == [6.0, 4.0, 2.0]


def test_what_a_masked_array_hides_is_no_return() -> None:
    ranges = np.ma.masked_greater(np.array([1.0, 2.0, 5.0, 3.0]), 4.0)
    scan = Scan(ranges, 0.0, 0.1)
    np.testing.assert_array_equal(scan.valid, [True, True, False, True])


def test_zero_is_no_return_even_where_no_range_is_too_short() -> None:
    assert Scan([0.0, 1.0, 2.0], 0.0, 0.1, range_min=0.0).valid.tolist() == [False, True, True]


def test_plain_codes_tell_nothing_from_too_near() -> None:
    said = [1.0, np.nan, np.inf, 0.0, -1.0, 10.0, 81.83, -np.inf, 0.02, 9.99]
    plain = plain_codes(said, 0.05, 10.0)
    assert plain.tolist() == [1.0, *[np.inf] * 6, -np.inf, -np.inf, 9.99]
    assert plain_codes(plain, 0.05, 10.0).tolist() == plain.tolist()
