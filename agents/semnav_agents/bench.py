"""Parts of the benchmark for agents: how long the scripted agent takes to decide.

Processor time is measured, because other programs on the machine change it less than wall time.
"""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from itertools import cycle

import numpy as np

from semnav_agents.scripted import ScriptedTeam
from semnav_env.bench.brute_force import compiled_scan
from semnav_env.bench.timing import Part
from semnav_env.judge.episodes import Episode, evenly, load_episodes
from semnav_env.vector import SemNavVectorEnv

MAX_SECONDS = 300.0
"""Time limit of an episode, simulated seconds."""


def agent_parts(robot: str, episodes: str, robots: int, steps: int) -> list[Part]:
    """Decisions of the scripted agent and steps of its environment; a compiled scan first.

    Args:
        robot: name of the body.
        episodes: name of the split that is driven, or path of a file.
        robots: in the larger team.
        steps: decisions in a timing, about.
    """
    found = evenly(load_episodes(episodes), min(64, len(load_episodes(episodes))))
    parts = [compiled_scan(time.process_time)]
    for count in dict.fromkeys((1, robots)):
        parts += _Drives(robot, count, found).parts(max(1, steps // count))
    return parts


class _Drives:
    """Robots that the scripted agent drives through episodes, over and over."""

    def __init__(self, robot: str, robots: int, episodes: Sequence[Episode]) -> None:
        self._team, self._robots = ScriptedTeam(robots), robots
        self._envs = SemNavVectorEnv(
            robots,
            robot=robot,
            observation=self._team.observation,
            max_seconds=MAX_SECONDS,
            threads=1,
            autoreset_mode="Disabled",
        )
        self._episodes: Iterator[Episode] = cycle(episodes)
        for k in range(robots):
            self._begin(k)
        self._observations = self._envs.observe()
        self._step_seconds = 0.0

    def parts(self, steps: int) -> list[Part]:
        """The decisions, and the steps of the environment between them, without resets."""
        among = f"one of {self._robots} robots" if self._robots > 1 else "one robot"
        return [
            Part(f"decision of the scripted agent, {among}", lambda: self._decide(steps)),
            Part(f"step of its environment, {among}", lambda: self._step_seconds),
        ]

    def _decide(self, steps: int) -> float:
        """Drive, and return the seconds of a robot's decision; keeps those of its step."""
        decided = stepped = 0.0
        for _ in range(steps):
            begin = time.process_time()
            actions = self._team.act(self._observations)
            middle = time.process_time()
            self._observations, _, terminated, truncated, _ = self._envs.step(actions)
            decided, stepped = decided + middle - begin, stepped + time.process_time() - middle
            over = np.flatnonzero(terminated | truncated).tolist()
            for k in over:
                self._begin(k)
            if over:
                self._observations = self._envs.observe()
        self._step_seconds = stepped / steps / self._robots
        return decided / steps / self._robots

    def _begin(self, index: int) -> None:
        episode = next(self._episodes)
        info = self._envs.begin(index, episode.number, {"episode": episode})
        self._team.reset(index, info)
