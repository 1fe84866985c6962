"""Counter-based random numbers: a function of their key, not of earlier draws.

A number is a hash of a key (seed, episode, step) and an index. Therefore it does not depend on the
order of calls, on how environments are batched or on how many threads compute them, and there
is no state to save.
"""

from __future__ import annotations

from math import sqrt
from statistics import NormalDist

import numpy as np

from semnav_features.frames import FloatArray
from semnav_features.kernels.compiling import kernel

_GAMMA = np.uint64(0x9E3779B97F4A7C15)
_MIX_1, _MIX_2 = np.uint64(0xBF58476D1CE4E5B9), np.uint64(0x94D049BB133111EB)
_S27, _S30, _S31, _S32, _S53 = (np.uint64(shift) for shift in (27, 30, 31, 32, 53))
_ONE, _LOW_21, _LOW_32 = np.uint64(1), np.uint64(2**21 - 1), np.uint64(2**32 - 1)
_CELLS = 2**11


def _normal_quantiles() -> FloatArray:
    """Borders of `_CELLS` equally likely cells of N(0, 1), shape (_CELLS + 1,).

    The outermost borders would be infinite; they are put where a distribution that is uniform
    within each cell has variance 1, which is 3.80 standard deviations.
    """
    inner = np.array([NormalDist().inv_cdf(i / _CELLS) for i in range(1, _CELLS)])
    a, b = inner[:-1], inner[1:]
    missing = _CELLS - float(((a * a + a * b + b * b) / 3.0).sum())
    edge = float(inner[-1])
    outer = (sqrt(6.0 * missing - 3.0 * edge * edge) - edge) / 2.0
    return np.concatenate(([-outer], inner, [outer]))


QUANTILES = _normal_quantiles()


@kernel(inline=True)
def _mix(state: np.uint64) -> np.uint64:
    """The output function of splitmix64 (Steele, Lea, Flood, OOPSLA 2014, figure 16)."""
    z = state
    z = (z ^ (z >> _S30)) * _MIX_1
    z = (z ^ (z >> _S27)) * _MIX_2
    return z ^ (z >> _S31)


@kernel
def stream(seed: int, episode: int, step: int) -> np.uint64:
    """The uint64 that names the stream of a key of three integers."""
    state = _mix(np.uint64(seed) + _GAMMA)
    state = _mix(state + (np.uint64(episode) + _ONE) * _GAMMA)
    return _mix(state + (np.uint64(step) + _ONE) * _GAMMA)


@kernel(inline=True)
def bits(stream: np.uint64, index: int) -> np.uint64:
    """64 random bits: number `index` of the splitmix64 sequence that starts at `stream`."""
    return _mix(stream + (np.uint64(index) + _ONE) * _GAMMA)


@kernel(inline=True)
def normal(word: np.uint64) -> np.float64:
    """A draw from N(0, 1) out of the upper 32 of 64 random bits.

    Eleven bits choose a cell of `QUANTILES`, 21 the place in it. Mean 0 and variance 1 hold to
    1e-6; the distribution function is within 1e-4 of the normal one; the largest value is 3.80.
    """
    cell = word >> _S53
    fraction = np.float64((word >> _S32) & _LOW_21) * 2.0**-21
    left, right = QUANTILES[cell], QUANTILES[cell + _ONE]
    return np.float64(left + fraction * (right - left))


@kernel(inline=True)
def uniform(word: np.uint64) -> np.float64:
    """A draw from [0, 1) out of the lower 32 of 64 random bits: independent of `normal`."""
    return np.float64(word & _LOW_32) * 2.0**-32
