"""Settings are constructed or refused, and what was constructed stays in its spaces.

A body that physics cannot carry is refused before Chipmunk ends the process.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from semnav_env.env import SemNavEnv
from semnav_env.judge.tasks import RewardWeights
from semnav_env.robots import SPOT, WHEELCHAIR, RobotSpec
from semnav_env.world.dynamics import Dynamics
from semnav_env.world.lidar import TIM561
from semnav_env.world.simulator import OdometrySettings
from tests.support.episodes import START

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


@pytest.mark.parametrize("value", [math.nan, math.inf, 1e308, 10**400, "1", None, True, [1]])
@pytest.mark.parametrize("name", ["time", "progress", "failure"])
def test_a_reward_of_no_number_is_refused(name: str, value: Any) -> None:
    with pytest.raises(ValueError, match=f"{name} is .*; it must be a number from"):
        RewardWeights(**{name: value})


@pytest.mark.parametrize("value", [math.nan, -0.1, 1e6, 10**400, "1", None])
@pytest.mark.parametrize("name", ["distance_bias", "turn_noise"])
def test_odometry_of_no_number_is_refused(name: str, value: Any) -> None:
    with pytest.raises(ValueError, match=f"{name} is .*; it must be a number from 0"):
        OdometrySettings(**{name: value})


@pytest.mark.parametrize(
    "change",
    [{"beams": 10.5}, {"beams": "9"}, {"beams": 10**9}, {"sigma": None}, {"rate_hz": "15"}],
)
def test_a_lidar_of_another_kind_is_refused(change: dict[str, Any]) -> None:
    with pytest.raises(ValueError, match=f"{next(iter(change))} is .*; it must be a"):
        replace(TIM561, **change)


@pytest.mark.parametrize("seconds", [1e308, 10**400, math.inf, 0.0, 1e-9, True])
def test_an_episode_of_no_possible_length_is_refused(seconds: float) -> None:
    with pytest.raises(ValueError, match=r"max_seconds is .*; it must be a number from"):
        SemNavEnv(max_seconds=seconds)


def test_a_hundred_boxes_are_placed_in_a_small_floor() -> None:
    env = SemNavEnv(floor_plan="office_cross", dynamics=Dynamics(added_boxes=100))
    before = len(env.floor_plan.surfaces)
    env.reset(seed=0)
    assert len(env.floor_plan.surfaces) > before + 30


@pytest.mark.parametrize("pose", [(1e6, -1e9, 0.3), (3e38, 1.0, -3.0)])
def test_an_observation_stays_in_its_space_however_odometry_errs(
    pose: tuple[float, float, float],
) -> None:
    env = SemNavEnv(observation="all", lidar=replace(TIM561, range_max=500.0, systematic=400.0))
    env.reset(seed=0, options=START)
    env.simulator.odometry.record["pose"] = pose
    for _ in range(3):
        observation = env.step(np.ones(2))[0]
        assert env.observation_space.contains(observation)
