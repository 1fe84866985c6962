"""Case 2: settings are constructed or refused, and what was constructed stays in its spaces."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from semnav_env.env import SemNavEnv
from semnav_env.judge.tasks import RewardWeights
from semnav_env.world.dynamics import Dynamics
from semnav_env.world.lidar import TIM561
from semnav_env.world.simulator import OdometrySettings
from tests.support.episodes import START


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
