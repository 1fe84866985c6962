"""`semnav demonstrate`: write what an agent sees and does as a dataset to learn from."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import gymnasium as gym
from tyro.conf import Positional

from semnav_agents.demonstration_file import DemonstrationFile
from semnav_agents.demonstrations import Demonstration, demonstrate
from semnav_agents.expert import Expert
from semnav_agents.registry import make_agent
from semnav_env.env import SemNavEnv
from semnav_env.judge.episodes import Expected, evenly, load_episodes
from semnav_scripts.progress import tracked


@dataclass(frozen=True)
class Arguments:
    """Write an agent's observations, actions and rewards in frozen episodes as a Minari dataset.

    Each episode is written as soon as it has been driven, so an interruption loses none.

    Attributes:
        split: a split (`semnav episodes list`), or a file of episodes.
        out: name of the dataset, such as semnav/train-scripted-v0, or a new folder.
        agent: scripted, oracle, blind, random, drive, listener, listener_drives (trained), the
            folder of a trained agent, or package.module:Class.
        observation: the recorded observation: semantic, raw, truth, all or command; the agent's own
            if not given.
        rounds: round observations to a millimetre, which takes much less space.
        labels: also record the action of the oracle in every state, as DAgger needs it.
        robot: wheelchair or spot.
        episodes: number of episodes, evenly spaced; all if not given.
        failures: keep failed episodes as well.
        max_seconds: time limit of an episode, simulated seconds.
        json: print JSON.
    """

    split: Positional[str]
    out: str
    agent: str = "scripted"
    observation: str | None = None
    rounds: bool = False
    labels: bool = False
    robot: str = "wheelchair"
    episodes: int | None = None
    failures: bool = False
    max_seconds: float = 300.0
    json: bool = False

    def run(self) -> int:
        """Drive, write, and check that everything is on disk."""
        if self.episodes is not None and self.episodes < 1:
            raise ValueError(f"--episodes is {self.episodes}; it must be at least 1")
        episodes = load_episodes(self.split)
        if any(episode.expected is not Expected.FEASIBLE for episode in episodes):
            raise ValueError(f"{self.split} has commands that cannot be carried out; give another")
        chosen = episodes if self.episodes is None else evenly(episodes, self.episodes)
        agent = make_agent(self.agent)
        seen = agent.observation
        env = self._env(seen)
        shown = env if self.observation in (None, seen) else self._env(self.observation)
        kept: list[bool] = []
        others = None if shown is env else shown, Expert() if self.labels else None
        demonstrations: Iterator[Demonstration] = (
            demonstrate(env, agent, each, *others) for each in chosen
        )
        with DemonstrationFile(self.out, shown, self.agent, self.rounds) as file:
            for each in tracked(
                demonstrations, lambda n: f"{n} episodes", lambda: len(kept) / len(chosen)
            ):
                kept.append(each.success or self.failures)
                if kept[-1]:
                    file.add(each)
        count = sum(kept)
        if file.count != count:
            raise OSError(f"{file.folder}: {count} episodes were written, {file.count} are there")
        if self.json:
            print(json.dumps({"folder": str(file.folder), "driven": len(kept), "kept": count}))
        else:
            print(f"drove {len(kept)} episodes, kept {count} in {file.folder}")
        return 0

    def _env(self, observation: Any) -> SemNavEnv:
        """An environment with a specification of how it was made, for the dataset."""
        made = gym.make(
            "semnav_env:SemNav-v0",
            robot=self.robot,
            observation=observation,
            episodes=self.split,
            max_seconds=self.max_seconds,
        ).unwrapped
        assert isinstance(made, SemNavEnv)
        return made
