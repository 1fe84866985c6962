"""The first command of the README, from its own start: doors that were passed count on."""

from __future__ import annotations

import pytest

from semnav_agents import make_agent
from semnav_agents.base import steps
from semnav_env.env import SemNavEnv


@pytest.mark.parametrize("seed", [4, 5, 7, 8])
def test_the_second_door_stays_the_second_while_it_is_passed(seed: int) -> None:
    agent = make_agent("scripted")
    env = SemNavEnv("wheelchair", "heidelberg_hallway", observation=agent.observation)
    options = {"command": "go through the second door on the right", "pose": (-2.5, -0.6, 0.25)}
    *_, last = steps(env, agent, *env.reset(seed=seed, options=options))
    assert [str(verdict) for verdict in last.info["verdicts"]] == ["done"]
