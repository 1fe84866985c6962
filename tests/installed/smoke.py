"""What an installed semnav-env does without its checkout: run by the Python it is installed in."""

import sys
from pathlib import Path

import gymnasium

import semnav_env
from semnav_agents import make_agent
from semnav_env.judge.episodes import SPLITS, load_episodes
from semnav_env.world.maps import bundled_names, load_floor_plan

STEPS = 50
"""Control periods that each agent drives."""


def drive(name: str) -> None:
    """Let an agent drive in an environment that was made by its id."""
    agent = make_agent(name)
    env = gymnasium.make("semnav_env:SemNav-v0", observation=agent.observation)
    observation, info = env.reset(seed=0)
    agent.reset(info)
    for _ in range(STEPS):
        observation, _, terminated, truncated, info = env.step(agent.act(observation))
        if terminated or truncated:
            observation, info = env.reset()
            agent.reset(info)


if __name__ == "__main__":
    folder = Path(semnav_env.__file__).parent
    assert folder.is_relative_to(sys.prefix), f"{folder} is not what was installed"
    for plan in bundled_names():
        load_floor_plan(plan)
    for split in SPLITS:
        assert load_episodes(split), split
    for agent in ("scripted", "drive", "listener_drives"):
        drive(agent)
    assert "torch" not in sys.modules
