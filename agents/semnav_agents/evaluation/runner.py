"""Runs the episodes of a suite in one or several processes."""

from __future__ import annotations

import multiprocessing
import pickle
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import groupby
from pathlib import Path
from typing import Any

from semnav_agents.evaluation.conclusion import NO_EXTRAS, Extras, file_stem
from semnav_agents.evaluation.drive import drive
from semnav_agents.evaluation.jobs import SuiteJob, suite_jobs
from semnav_agents.evaluation.results import LeftOut, Result
from semnav_agents.evaluation.suites import Trial
from semnav_agents.evaluation.together import CannotBegin, drive_together
from semnav_agents.registry import AgentSource, make_agent, make_team
from semnav_agents.team import AgentTeam
from semnav_env.env import SemNavEnv
from semnav_env.judge.episodes import Episode
from semnav_env.mind.observations import ObservationType
from semnav_env.rendering.film import Film
from semnav_env.rescue.environment import (
    VICTIMS,
    search_and_rescue,
    search_and_rescue_vector,
)
from semnav_env.robots import RobotSpec
from semnav_env.vector import SemNavVectorEnv
from semnav_env.world.dynamics import NO_DYNAMICS, Dynamics
from semnav_features.interruption import for_this_process_alone
from semnav_features.lidar_spec import LidarSpec

MAX_TOGETHER = 16
"""The most episodes that a process drives at once."""

JOBS_OF_A_SHARE = 32
"""The most episodes that a process takes at a time."""

STEPS_PER_FILM_FRAME = 15
"""Steps between the frames of a failure's film, one second: it runs five times as fast as the
robot, and the longest has 300 frames of 2 MB in memory."""


@dataclass(frozen=True)
class SuiteSetup:
    """Settings that all episodes of a suite share; see `run_suite`."""

    agent: AgentSource
    robot: str | RobotSpec
    extras: Extras = NO_EXTRAS
    dynamics: Dynamics = NO_DYNAMICS
    lidar: str | LidarSpec = "tim561"


def run_suite(
    trials: Sequence[Trial | Episode],
    agent: AgentSource,
    robot: str | RobotSpec,
    seeds: Sequence[int] = (),
    workers: int = 1,
    extras: Extras = NO_EXTRAS,
    dynamics: Dynamics = NO_DYNAMICS,
    lidar: str | LidarSpec = "tim561",
    left_out: list[LeftOut] | None = None,
    skip: int = 0,
) -> Iterator[Result]:
    """The result of every trial with every seed, in their order.

    Args:
        trials: what to run; an episode has one seed, its number.
        agent: as `make_agent` takes it: a name, a folder, "package.module:Class", or a class or
            function that makes an agent.
        robot: a body or its name.
        seeds: each gives a trial's start pose, sensor noise and odometry drift.
        workers: processes; results do not depend on it.
        extras: what else to do with each episode.
        dynamics: people, doors and furniture that move.
        lidar: a lidar or its name.
        left_out: takes the episodes whose command is void where `dynamics` has changed doors or
            furniture; without it such an episode is an error.
        skip: number of the first results that are not driven, because they are known.

    Raises:
        ValueError: there is no such agent, or with several workers one that other processes
            cannot import.
    """
    setup = SuiteSetup(agent, robot, extras, dynamics, lidar)
    jobs = suite_jobs(trials, seeds)[skip:]
    if not jobs:
        return
    for outcome in _outcomes(setup, jobs, workers):
        if isinstance(outcome, Result):
            yield outcome
        elif left_out is None:
            raise ValueError(f"{outcome.episode or outcome.command}: {outcome.why}")
        else:
            left_out.append(outcome)


def _outcomes(
    setup: SuiteSetup, jobs: Sequence[SuiteJob], workers: int
) -> Iterator[Result | LeftOut]:
    """What became of each job, in their order."""
    if workers == 1:
        yield from SuiteRunner(setup).run(jobs)
        return
    shares = [jobs[k : k + JOBS_OF_A_SHARE] for k in range(0, len(jobs), JOBS_OF_A_SHARE)]
    processes = multiprocessing.get_context("spawn")
    with for_this_process_alone():
        pool = processes.Pool(min(workers, len(shares)), _start_worker, (_pickled(setup),))
    with pool:
        for some in pool.imap(_work, shares):
            yield from some


class SuiteRunner:
    """Runs trials and frozen episodes, many at once, with one agent on one body."""

    def __init__(self, setup: SuiteSetup) -> None:
        self._setup = setup
        self._crews: dict[tuple[int, float], tuple[SemNavVectorEnv, AgentTeam]] = {}

    def run(self, jobs: Sequence[SuiteJob]) -> Iterator[Result | LeftOut]:
        """What became of jobs, in their order."""
        for _, some in groupby(jobs, lambda job: job.max_seconds):
            yield from self._run(list(some))

    def _run(self, jobs: Sequence[SuiteJob]) -> Iterator[Result | LeftOut]:
        """The same for jobs with one time limit."""
        extras = self._setup.extras
        crew = self._crew(min(MAX_TOGETHER, len(jobs)), jobs[0])
        found, done = dict[int, Result | LeftOut](), 0
        for number, driven in drive_together(*crew, jobs):
            if isinstance(driven, CannotBegin):
                found[number] = jobs[number].left_out(driven.why)
            else:
                found[number] = result = jobs[number].result(driven, extras)
                if extras.films is not None and not result.success:
                    self._film(jobs[number], extras.films)
            while done in found:
                yield found.pop(done)
                done += 1

    def _crew(self, robots: int, job: SuiteJob) -> tuple[SemNavVectorEnv, AgentTeam]:
        """An environment of some robots and the team that drives them, made once for each kind.

        Args:
            robots: number of them.
            job: one of those for which they are; searches have a time limit of their own.
        """
        crew = self._crews.get((robots, job.max_seconds))
        if crew is None:
            team = make_team(self._setup.agent, robots)
            make = search_and_rescue_vector if job.is_search else SemNavVectorEnv
            envs = make(
                robots,
                observation=team.observation,
                threads=1,
                autoreset_mode="Disabled",
                **_options(self._setup, job),
            )
            crew = self._crews[robots, job.max_seconds] = envs, team
        return crew

    def _film(self, job: SuiteJob, folder: Path) -> None:
        """Drive a failure once more, with the same result, and film it."""
        agent = make_agent(self._setup.agent)
        env = make_env(self._setup, job, agent.observation, "rgb_array")
        film = Film(env, STEPS_PER_FILM_FRAME)
        driven = drive(env, agent, job.seed, job.options(env), film.note)
        film.save(folder / f"{file_stem(driven, job.name, job.seed)}.gif")


def make_env(
    setup: SuiteSetup,
    job: SuiteJob,
    observation: str | ObservationType,
    render_mode: str | None = None,
) -> SemNavEnv:
    """An environment in which one episode of a suite goes as in the suite.

    Args:
        setup: settings of the suite.
        job: the episode.
        observation: that of its agent.
        render_mode: "rgb_array" or "human".
    """
    make = search_and_rescue if job.is_search else SemNavEnv
    return make(observation=observation, render_mode=render_mode, **_options(setup, job))


def _options(setup: SuiteSetup, job: SuiteJob) -> dict[str, Any]:
    """The options of an environment that the suite and the kind of a job decide."""
    dynamics = setup.dynamics
    if job.is_search:
        victims = 0 if job.person_in else dynamics.victims or VICTIMS
        dynamics = replace(dynamics, victims=victims)
    return {
        "robot": setup.robot,
        "lidar": setup.lidar,
        "dynamics": dynamics,
        "max_seconds": job.max_seconds,
    }


class _Worker:
    """Data that a process of the pool keeps between jobs."""

    pickled: bytes
    runner: SuiteRunner | None = None


def _pickled(setup: SuiteSetup) -> bytes:
    try:
        return pickle.dumps(setup)
    except (pickle.PicklingError, AttributeError, TypeError) as error:
        raise ValueError(f"{_NOT_SHARED}: {error}") from None


def _start_worker(pickled: bytes) -> None:
    _Worker.pickled = pickled


def _work(jobs: Sequence[SuiteJob]) -> list[Result | LeftOut]:
    """Run some jobs; the agent is unpickled here, where an error reaches the caller."""
    if _Worker.runner is None:
        try:
            setup = pickle.loads(_Worker.pickled)
        except (AttributeError, ImportError) as error:
            raise ValueError(f"{_NOT_SHARED}: {error}") from None
        _Worker.runner = SuiteRunner(setup)
    return list(_Worker.runner.run(jobs))


_NOT_SHARED = (
    "several workers need an agent that other processes can import: the class or function must "
    "stand at the top of a module, not in a notebook or inside a function"
)
