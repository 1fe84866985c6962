"""Case 1: a body that physics cannot carry is refused, before Chipmunk ends the process."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import pytest

from semnav_env.robots import SPOT, WHEELCHAIR, RobotSpec

SIZES = ("length", "width", "mass", "max_speed", "max_turn_rate", "max_acceleration")
NO_NUMBERS = [math.nan, math.inf, -math.inf, -1, 0, 5e-324, 1e308, 10**400, "1", None, True, [1.0]]


@pytest.mark.parametrize("value", NO_NUMBERS, ids=lambda value: repr(value)[:20])
@pytest.mark.parametrize("name", SIZES)
def test_a_body_of_impossible_size_is_refused(name: str, value: Any) -> None:
    with pytest.raises(ValueError, match=f"{name} is .*; it must be a number from .* to"):
        replace(WHEELCHAIR, **{name: value})


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"axle": math.nan}, "axle is nan"),
        ({"axle": math.inf}, "axle is inf"),
        ({"axle": 0.6}, "axle is 0.6; it must be on the body"),
        ({"max_sideways_speed": -0.1}, "max_sideways_speed is -0.1"),
        ({"lidar_mount": (5.0, 0.0, 0.0)}, r"lidar_mount\[0\] is 5.0"),
        ({"lidar_mount": (0.0, 0.4, 0.0)}, "lidar_mount is .* on the body"),
        ({"lidar_mount": (0.0, 0.0)}, "lidar_mount is .* a tuple of 3"),
        ({"lidar_mount": (0.0, 0.0, math.nan)}, r"lidar_mount\[2\] is nan"),
        ({"lidar_mount": "abc"}, "lidar_mount is 'abc'"),
        ({"name": 7}, "name is 7; it must be text"),
    ],
)
def test_an_impossible_part_of_a_body_is_named(change: dict[str, Any], words: str) -> None:
    with pytest.raises(ValueError, match=words):
        replace(WHEELCHAIR, **change)


def test_a_body_that_went_through_json_is_the_same() -> None:
    listed = {n: list(v) if isinstance(v, tuple) else v for n, v in vars(SPOT).items()}
    assert RobotSpec(**listed) == SPOT
