"""Drives many episodes at once, in a vector environment."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import AbstractContextManager
from typing import Any, NamedTuple, Protocol

import numpy as np

from semnav_agents.evaluation.drive import Drive, ended
from semnav_agents.team import AgentTeam
from semnav_env.env import SemNavEnv
from semnav_env.judge.metrics import Recorder
from semnav_env.vector import SemNavVectorEnv


class Job(Protocol):
    """An episode to drive."""

    @property
    def seed(self) -> int:
        """Of the episode."""
        ...

    def options(self, env: SemNavEnv) -> dict[str, Any]:
        """Options of `SemNavEnv.reset`."""
        ...

    def named_in_errors(self) -> AbstractContextManager[None]:
        """Adds to errors which episode it is."""
        ...


class _Running(NamedTuple):
    number: int
    recorder: Recorder


def drive_together(
    envs: SemNavVectorEnv, team: AgentTeam, jobs: Iterable[Job]
) -> Iterator[tuple[int, Drive]]:
    """Drive episodes, as many at once as there are robots; each is as if it was driven alone.

    Args:
        envs: with `autoreset_mode="Disabled"` and the `observation=` of the team.
        team: the drivers.
        jobs: the episodes, at least as many as there are robots.

    Yields:
        The number of a job and its drive, as they end. The state of its environment is that of the
        end until the next one is asked for.
    """
    waiting, running = enumerate(jobs), dict[int, _Running]()
    for k in range(envs.num_envs):
        _begin(envs, team, k, waiting, running)
    observations = envs.observe()
    while running:
        actions = team.act(observations, running)
        observations, _, terminated, truncated, _ = envs.step(actions)
        for each in running.values():
            each.recorder.note()
        over = [k for k in np.flatnonzero(terminated | truncated).tolist() if k in running]
        for k in over:
            number, recorder = running.pop(k)
            yield number, ended(envs.envs[k], recorder, team.own_goal(k))
            _begin(envs, team, k, waiting, running)
        if over and running:
            observations = envs.observe()


def _begin(
    envs: SemNavVectorEnv,
    team: AgentTeam,
    index: int,
    waiting: Iterator[tuple[int, Job]],
    running: dict[int, _Running],
) -> None:
    """Let a robot begin the next job; it rests if none is left."""
    number, job = next(waiting, (-1, None))
    if job is None:
        envs.rest(index)
        return
    env = envs.envs[index]
    with job.named_in_errors():
        info = envs.begin(index, job.seed, job.options(env))
    team.reset(index, info, env.floor_plan)
    running[index] = _Running(number, Recorder(env.world))
