from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from semnav_env.world.lidar.noise import corrupt
from semnav_features.frames import FloatArray
from semnav_features.lidar_spec import LidarSpec
from semnav_features.lidars import TIM561

WIDE = LidarSpec("wide", 1, 0.0, 0.1, range_min=0.0, range_max=1e6)
KEY = (11, 22, 33)


def measured(ranges: FloatArray, spec: LidarSpec, key: tuple[int, int, int] = KEY) -> FloatArray:
    out = np.array(ranges, dtype=np.float64)
    corrupt(out, spec.sensor, *key)
    return out


@given(
    st.lists(st.floats(0.0, 12.0) | st.just(math.inf), min_size=1, max_size=50),
    st.floats(0, 100),
    st.floats(0, 1),
    st.integers(0, 2**63 - 1),
)
@settings(deadline=None)
def test_measured_ranges_are_valid_or_infinite_and_never_nan(
    ranges: list[float], sigma: float, dropout: float, seed: int
) -> None:
    spec = replace(TIM561, sigma=sigma, dropout=dropout, systematic=sigma)
    found = measured(np.array(ranges), spec, (seed, 0, 0))
    assert not np.isnan(found).any()
    finite = found[np.isfinite(found)]
    assert ((finite >= spec.range_min) & (finite < spec.range_max)).all()


def test_without_errors_the_ranges_stay_as_they_are() -> None:
    exact = np.array([0.05, 1.0, 9.999, math.inf])
    np.testing.assert_array_equal(measured(exact, replace(TIM561, sigma=0.0, dropout=0.0)), exact)


def test_ranges_beyond_the_limits_are_infinite() -> None:
    exact = np.array([0.0, 0.049, 10.0, 11.0])
    found = measured(exact, replace(TIM561, sigma=0.0, dropout=0.0))
    np.testing.assert_array_equal(found, [-math.inf, -math.inf, math.inf, math.inf])


def test_sigma_is_the_standard_deviation_of_the_error() -> None:
    error = measured(np.full(100_000, 5.0), replace(WIDE, sigma=0.02)) - 5.0
    assert abs(error.mean()) < 4 * 0.02 / math.sqrt(100_000)
    assert abs(error.std() / 0.02 - 1.0) < 0.01


def test_dropout_is_the_share_of_beams_without_return() -> None:
    found = measured(np.full(100_000, 5.0), replace(WIDE, dropout=0.03))
    assert abs(np.isinf(found).mean() - 0.03) < 4 * math.sqrt(0.03 / 100_000)
    assert np.isinf(measured(np.full(100, 5.0), replace(WIDE, dropout=1.0))).all()


def test_dropouts_fall_on_errors_of_every_size() -> None:
    noisy = measured(np.full(100_000, 5.0), replace(WIDE, sigma=1.0))
    dropped = np.isinf(measured(np.full(100_000, 5.0), replace(WIDE, sigma=1.0, dropout=0.5)))
    assert abs((noisy[dropped] - 5.0).mean()) < 0.02
    assert abs(noisy[dropped].std() - 1.0) < 0.02


def test_the_systematic_error_is_one_offset_per_episode() -> None:
    spec = replace(WIDE, systematic=0.06)
    offsets = []
    for episode in range(2000):
        error = measured(np.full(5, 5.0), spec, (1, episode, 0)) - 5.0
        later = measured(np.full(5, 5.0), spec, (1, episode, 77)) - 5.0
        assert np.ptp(np.concatenate((error, later))) == 0.0
        offsets.append(error[0])
    assert np.abs(offsets).max() <= 0.06 + 1e-9
    assert abs(np.mean(offsets)) < 0.005
    assert abs(np.std(offsets) - 0.06 / math.sqrt(3)) < 0.002


def test_a_beams_error_does_not_depend_on_the_other_beams() -> None:
    ranges = np.linspace(0.1, 9.0, 811)
    np.testing.assert_array_equal(measured(ranges, TIM561)[:100], measured(ranges[:100], TIM561))


def test_errors_do_not_depend_on_the_order_of_sweeps() -> None:
    ranges = np.linspace(0.1, 9.0, 811)
    forwards = [measured(ranges, TIM561, (1, 2, step)) for step in range(5)]
    backwards = [measured(ranges, TIM561, (1, 2, step)) for step in reversed(range(5))]
    np.testing.assert_array_equal(forwards, backwards[::-1])
    assert not np.array_equal(forwards[0], forwards[1])
