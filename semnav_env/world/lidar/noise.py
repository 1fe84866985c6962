"""Errors, dropouts and limits of a lidar, applied to exact ranges."""

from __future__ import annotations

import numpy as np

from semnav_env.world.lidar.counter_rng import bits, normal, stream, uniform
from semnav_features.frames import FloatArray
from semnav_features.kernels.compiling import kernel

_WHOLE_EPISODE = -1
"""Replaces the step in the key of values that stay the same throughout an episode."""


@kernel
def corrupt(ranges: FloatArray, sensor: np.ndarray, seed: int, episode: int, step: int) -> None:
    """Make measured ranges out of exact ones, in place.

    range + offset of the episode + N(0, sigma^2), then the limits of REP 117: -inf below
    range_min, +inf at or beyond range_max, and +inf for a dropout. A beam's error depends on the
    key and the beam's index alone. Never NaN for ranges that are not NaN.

    Args:
        ranges: exact ranges in metres, +inf for no return, shape (beams,).
        sensor: `LidarSpec.sensor`, shape (1,).
        seed: first integer of the key.
        episode: second integer of the key.
        step: third integer of the key, not negative.
    """
    lidar = sensor[0]
    common = uniform(stream(seed, episode, _WHOLE_EPISODE))
    offset = lidar.systematic * (2.0 * common - 1.0)
    sweep = stream(seed, episode, step)
    for i in range(np.uint64(ranges.shape[0])):
        word = bits(sweep, i)
        measured = ranges[i] + offset + lidar.sigma * normal(word)
        measured = np.inf if measured >= lidar.range_max else measured
        measured = -np.inf if measured < lidar.range_min else measured
        ranges[i] = np.inf if uniform(word) < lidar.dropout else measured
