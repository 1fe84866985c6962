"""Floors of benchmarks, agents that do not hear the command."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from semnav_agents.base import steps
from semnav_agents.registry import make_agent
from semnav_env.env import SemNavEnv
from tests.support.episodes import START


def driven(name: str, robot: str, options: dict[str, Any], seconds: float = 20.0) -> SemNavEnv:
    agent = make_agent(name)
    env = SemNavEnv(robot, observation=agent.observation, max_seconds=seconds)
    observation, info = env.reset(seed=3, options=options)
    for step in steps(env, agent, observation, info):
        assert env.action_space.contains(step.action)
    return env


@pytest.mark.parametrize("robot", ["wheelchair", "spot"])
def test_the_blind_agent_goes_through_some_door(robot: str) -> None:
    options = START | {"pose": (-2.5, -0.4, 0.25)}
    env = driven("blind", robot, options, 60.0)
    assert env.judge.crossed == ["south_1"]  # not the second, for which it was asked


@pytest.mark.parametrize("name", ["blind", "random"])
def test_floors_do_the_same_whatever_they_are_told(name: str) -> None:
    """Up to the end, which comes with the first door that is not the one."""
    other = {"command": "go through the third door on the right", "pose": START["pose"]}
    paths = []
    for options in (START, other):
        agent = make_agent(name)
        env = SemNavEnv(observation=agent.observation, max_seconds=4.0)
        observation, info = env.reset(seed=3, options=options)
        paths.append([step.action for step in steps(env, agent, observation, info)])
    assert len(paths[0]) == 60
    np.testing.assert_array_equal(*paths)


def test_the_random_agent_draws_from_the_whole_action_space() -> None:
    agent = make_agent("random")
    env = SemNavEnv("spot", observation=agent.observation, max_seconds=30.0)
    observation, info = env.reset(seed=3, options=START)
    agent.reset(info)
    drawn = np.unique([agent.act(observation) for _ in range(15 * 200)], axis=0)
    assert len(drawn) == 200
    assert drawn.min() < -0.9
    assert drawn.max() > 0.9
