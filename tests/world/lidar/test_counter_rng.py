from __future__ import annotations

import math

import numpy as np
import pytest
from numba import njit
from scipy import stats

from semnav_env.world.lidar.counter_rng import QUANTILES, bits, normal, stream, uniform
from semnav_features.frames import FloatArray

N = 400_000


@njit
def _normals(seed: int, episode: int, step: int, out: FloatArray) -> None:
    words = stream(seed, episode, step)
    for i in range(len(out)):
        out[i] = normal(bits(words, i))


@njit
def _uniforms(seed: int, episode: int, step: int, out: FloatArray) -> None:
    words = stream(seed, episode, step)
    for i in range(len(out)):
        out[i] = uniform(bits(words, i))


def normals(key: tuple[int, int, int], count: int = N) -> FloatArray:
    out = np.empty(count)
    _normals(*key, out)
    return out


def uniforms(key: tuple[int, int, int], count: int = N) -> FloatArray:
    out = np.empty(count)
    _uniforms(*key, out)
    return out


def assert_independent(a: FloatArray, b: FloatArray) -> None:
    """Neither values nor magnitudes are correlated, to five standard errors."""
    for x, y in ((a, b), (np.abs(a), np.abs(b))):
        assert abs(np.corrcoef(x, y)[0, 1]) < 5 / math.sqrt(len(a))


def test_bits_are_the_published_splitmix64_sequence() -> None:
    """The values that the reference implementation gives for the seed 1234567."""
    start = np.uint64(1234567)
    assert [int(bits(start, i)) for i in range(3)] == [
        6457827717110365317,
        3203168211198807973,
        9817491932198370423,
    ]


def test_normal_has_the_moments_of_a_normal_distribution() -> None:
    z = normals((1, 2, 3))
    error = 1 / math.sqrt(N)
    assert abs(z.mean()) < 4 * error
    assert abs(z.var() - 1) < 4 * math.sqrt(2) * error
    assert abs(stats.skew(z)) < 4 * math.sqrt(6) * error
    assert abs(stats.kurtosis(z)) < 4 * math.sqrt(24) * error


def test_normal_numbers_have_the_normal_distribution() -> None:
    assert stats.kstest(normals((4, 5, 6)), "norm").pvalue > 0.01


@pytest.mark.parametrize("limit", [1.0, 2.0, 3.0, 3.5])
def test_tails_hold_as_much_as_they_should(limit: float) -> None:
    share = 2 * stats.norm.sf(limit)
    found = (np.abs(normals((7, 8, 9))) > limit).mean()
    assert abs(found - share) < 4 * math.sqrt(share / N) + 2e-5


def test_the_table_is_symmetric_and_its_variance_is_one() -> None:
    np.testing.assert_allclose(QUANTILES, -QUANTILES[::-1], atol=1e-12)
    a, b = QUANTILES[:-1], QUANTILES[1:]
    assert ((a * a + a * b + b * b) / 3).mean() == pytest.approx(1.0, abs=1e-12)
    assert 3.7 < QUANTILES[-1] < 3.9


def test_uniform_is_uniform_and_independent_of_normal() -> None:
    u = uniforms((1, 2, 3))
    assert u.min() >= 0.0
    assert u.max() < 1.0
    assert stats.kstest(u, "uniform").pvalue > 0.01
    assert_independent(u, normals((1, 2, 3)))


@pytest.mark.parametrize("lag", [1, 2, 3, 10, 811])
def test_neighbouring_beams_are_independent(lag: int) -> None:
    z = normals((1, 2, 3))
    assert_independent(z[lag:], z[:-lag])


@pytest.mark.parametrize("other", [(1, 0, 1), (0, 1, 1), (0, 0, 2), (1, 0, 0), (2**62, 0, 1)])
def test_keys_that_differ_in_one_number_are_independent(other: tuple[int, int, int]) -> None:
    assert_independent(normals((0, 0, 1)), normals(other))


def test_noise_is_independent_between_steps_and_episodes() -> None:
    by_step = np.array([normals((0, 0, step), 1)[0] for step in range(20_000)])
    by_episode = np.array([normals((0, episode, 0), 1)[0] for episode in range(20_000)])
    for z in (by_step, by_episode):
        assert stats.kstest(z, "norm").pvalue > 0.01
        assert_independent(z[1:], z[:-1])


def test_no_two_small_keys_share_a_stream() -> None:
    small = range(24)
    streams = {int(stream(a, b, c)) for a in small for b in small for c in small}
    assert len(streams) == 24**3
