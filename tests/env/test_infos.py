"""Infos hold small plain values: vector environments send them from process to process."""

from __future__ import annotations

import pickle
from typing import Any

import gymnasium as gym
import numpy as np
import pytest

from semnav_agents.oracle import OracleAgent
from semnav_env.env import SemNavEnv
from semnav_env.judge.tasks import RandomisedRobot
from semnav_env.robots import SPOT, RobotSpec
from semnav_features.lidar_spec import LidarSpec
from semnav_features.lidars import TIM561

MAX_PICKLED_BYTES = 2000
"""Largest size of an `info` as it is sent, bytes."""


def is_plain(value: Any) -> bool:
    """Whether a value is a number, text, nothing, or a tuple or dictionary of such."""
    if isinstance(value, dict):
        return all(isinstance(key, str) and is_plain(each) for key, each in value.items())
    if isinstance(value, tuple):
        return all(map(is_plain, value))
    return value is None or type(value) in (bool, int, float, str)  # an enum is text, not plain


@pytest.mark.parametrize("kind", [{"floor_plan": "office:large:1"}, {"episodes": "val_seen"}])
def test_infos_are_small_and_plain(kind: dict[str, Any]) -> None:
    env = SemNavEnv(max_seconds=0.2, **kind)
    infos = [env.reset(seed=0)[1], *(env.step(np.zeros(2))[4] for _ in range(3))]
    assert "is_success" in infos[-1]
    for info in infos:
        assert is_plain(info), info
        assert len(pickle.dumps(info)) < MAX_PICKLED_BYTES


def test_the_info_of_reset_tells_body_and_lidar() -> None:
    _, info = SemNavEnv(task=RandomisedRobot("turn around", robots=("wheelchair",))).reset(seed=0)
    assert RobotSpec(**info["robot"]).name == "wheelchair"
    _, info = SemNavEnv("spot").reset(seed=0)
    assert RobotSpec(**info["robot"]) == SPOT
    assert LidarSpec(**info["lidar"]) == TIM561


def test_a_vector_environment_stacks_infos() -> None:
    envs = gym.make_vec("semnav_env:SemNav-v0", num_envs=2, vectorization_mode="sync")
    _, info = envs.reset(seed=0)
    assert info["robot"]["length"].tolist() == [1.1, 1.1]
    assert info["floor_plan"].tolist() == ["heidelberg_hallway"] * 2
    info = envs.step(np.zeros((2, 2), np.float32))[4]
    assert info["path_length"].shape == (2,)
    envs.close()


def test_an_oracle_reads_the_plan_that_it_is_told() -> None:
    env = SemNavEnv(floor_plan="office_cross", observation="truth")
    observation, info = env.reset(seed=0)
    by_name, told = OracleAgent(), OracleAgent()
    by_name.reset(info)
    told.read_plan(env.floor_plan)
    told.reset(info | {"floor_plan": "a plan of my own"})
    assert np.array_equal(by_name.act(observation), told.act(observation))
