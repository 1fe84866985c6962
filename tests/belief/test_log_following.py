"""A command followed on a log: where the robot was, and with which lidar."""

from __future__ import annotations

import math

import numpy as np
import pytest

from semnav_env.belief.log_following import lidar_of
from semnav_env.features import Scan
from semnav_env.features.lidar_spec import LidarSpec


@pytest.mark.parametrize("beams", [8, 77, 360, 431, 720, 862, 1440, 3000])
@pytest.mark.parametrize("repeated", [0, 1, 3])
@pytest.mark.parametrize("rounded", [float, np.float32, np.float16])
def test_a_rounded_full_circle_has_a_lidar(beams: int, repeated: int, rounded: type) -> None:
    """Of repeated beams at most the first stays, whichever way the increment was rounded."""
    increment = float(rounded(math.tau / beams))
    spec = lidar_of(Scan(np.full(beams + repeated, 2.0), -math.pi, increment))
    assert (spec.beams - 1) * spec.angle_increment == pytest.approx(math.tau, rel=2.0 / beams)
    if rounded is not np.float16:
        assert spec.beams == beams + min(repeated, 1)


def test_a_lidar_sees_a_full_turn_at_most() -> None:
    assert LidarSpec("full", 721, 0.0, math.radians(0.5)).beams == 721
    with pytest.raises(ValueError, match="at most 2 pi"):
        LidarSpec("more", 722, 0.0, math.radians(0.5))
