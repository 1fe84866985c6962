"""Drives many episodes at once, in a vector environment."""

from __future__ import annotations

from collections.abc import Generator, Iterable, Iterator
from contextlib import AbstractContextManager
from typing import Any, NamedTuple, Protocol

import numpy as np

from semnav_agents.evaluation.drive import Drive, ended
from semnav_agents.team import AgentTeam
from semnav_env.env import SemNavEnv
from semnav_env.judge.metrics import Recorder
from semnav_env.mind.grounding import GroundingError
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


class CannotBegin(NamedTuple):
    """Why an episode cannot begin: where doors and furniture have changed, its command is void."""

    why: str


class _Running(NamedTuple):
    number: int
    job: Job
    recorder: Recorder


def drive_together(
    envs: SemNavVectorEnv, team: AgentTeam, jobs: Iterable[Job]
) -> Iterator[tuple[int, Drive | CannotBegin]]:
    """Drive episodes, as many at once as there are robots; each is as if it was driven alone.

    Args:
        envs: with `autoreset_mode="Disabled"` and the `observation=` of the team.
        team: the drivers.
        jobs: the episodes, at least as many as there are robots.

    Yields:
        The number of a job and its drive, as they end, or why it cannot begin. The state of its
        environment is that of the end until the next one is asked for.
    """
    waiting, running = enumerate(jobs), dict[int, _Running]()
    for k in range(envs.num_envs):
        yield from _begin(envs, team, k, waiting, running)
    for k in running.keys() ^ set(range(envs.num_envs)):
        _stand_in(envs, k, running)
    if not running:
        return
    observations = envs.observe()
    while running:
        actions = team.act(observations, running)
        observations, _, terminated, truncated, _ = envs.step(actions)
        for each in running.values():
            each.recorder.note()
        over = [k for k in np.flatnonzero(terminated | truncated).tolist() if k in running]
        for k in over:
            number, _, recorder = running.pop(k)
            yield number, ended(envs.envs[k], recorder, team.own_goal(k))
            refused = yield from _begin(envs, team, k, waiting, running)
            if refused and k not in running:
                _stand_in(envs, k, running)
        if over and running:
            observations = envs.observe()


def _begin(
    envs: SemNavVectorEnv,
    team: AgentTeam,
    index: int,
    waiting: Iterator[tuple[int, Job]],
    running: dict[int, _Running],
) -> Generator[tuple[int, CannotBegin], None, bool]:
    """Let a robot begin the next job that can begin; it rests if none is left.

    Yields:
        The jobs before, which cannot.

    Returns:
        Whether there were such jobs.
    """
    env, refused = envs.envs[index], False
    for number, job in waiting:
        try:
            with job.named_in_errors():
                info = envs.begin(index, job.seed, job.options(env))
        except GroundingError as error:
            if not env.plan_source.dynamics.changes_plan:
                raise
            refused = True
            yield number, CannotBegin(str(error).splitlines()[0])
            continue
        team.reset(index, info, env.floor_plan)
        running[index] = _Running(number, job, Recorder(env.world))
        return refused
    envs.rest(index)
    return refused


def _stand_in(envs: SemNavVectorEnv, index: int, running: dict[int, _Running]) -> None:
    """Let a robot whose last episode could not begin rest in that of another robot, if any drives.

    Robots are driven together, so each of them must be in some episode.
    """
    other = next(iter(running.values()), None)
    if other is not None:
        envs.begin(index, other.job.seed, other.job.options(envs.envs[index]))
        envs.rest(index)
