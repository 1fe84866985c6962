"""Runs the episodes of a suite in one or several processes."""

from __future__ import annotations

import multiprocessing
import pickle
import re
import zlib
from collections.abc import Iterator, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, replace
from itertools import groupby
from pathlib import Path
from typing import Any

import numpy as np

from semnav_agents.evaluation.drive import Drive, drive
from semnav_agents.evaluation.results import LeftOut, Result, failure_line
from semnav_agents.evaluation.suites import Trial
from semnav_agents.evaluation.together import CannotBegin, drive_together
from semnav_agents.registry import AgentSource, make_agent, make_team
from semnav_agents.team import AgentTeam
from semnav_env.env import SemNavEnv
from semnav_env.judge.episodes import Episode, Expected
from semnav_env.mind.observations import ObservationType
from semnav_env.rendering.film import Film
from semnav_env.rescue.environment import (
    MAX_SEARCH_SECONDS,
    VICTIMS,
    search_and_rescue,
    search_and_rescue_vector,
)
from semnav_env.robots import RobotSpec
from semnav_env.vector import SemNavVectorEnv
from semnav_env.world.dynamics import NO_DYNAMICS, Dynamics
from semnav_env.world.dynamics.victims import with_victims
from semnav_env.world.maps import FloorPlan
from semnav_env.world.maps.placement import MAX_DRAWS, has_room, placement_error
from semnav_features.frames import Pose
from semnav_features.interruption import for_this_process_alone
from semnav_features.lidar_spec import LidarSpec


@dataclass(frozen=True)
class Extras:
    """Further outputs of a driven episode.

    Attributes:
        recheck: judge it a second time, by other code.
        pictures: folder for a picture of each failure.
        films: folder for a film of each failure, for which it is driven a second time.
        keep: keep the drive of each failure, `Result.kept`.
    """

    recheck: bool = False
    pictures: Path | None = None
    films: Path | None = None
    keep: bool = False


NO_EXTRAS = Extras()
"""No further outputs: only drive and measure."""

FINDING_SECONDS = 900.0
"""Time limit of a trial in which people are found as told, simulated seconds."""

TRIAL_SECONDS, EPISODE_SECONDS = 120.0, 300.0
"""Time limits of a trial and of a frozen episode, whose routes are longer; simulated seconds."""

MAX_TOGETHER = 16
"""The most episodes that a process drives at once."""

JOBS_OF_A_SHARE = 32
"""The most episodes that a process takes at a time."""

STEPS_PER_FILM_FRAME = 15
"""Steps between the frames of a failure's film, one second: it runs five times as fast as the
robot, and the longest has 300 frames of 2 MB in memory."""

MAX_NAME_LENGTH = 90
"""Characters of a command in the name of a picture; file names end at 255 bytes."""


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


@dataclass(frozen=True)
class SuiteJob:
    """A trial with a seed, or a frozen episode, whose seed is its number."""

    trial: Trial | Episode
    seed: int

    @property
    def is_search(self) -> bool:
        """Whether people are searched."""
        return isinstance(self.trial, Trial) and self.trial.is_search

    @property
    def person_in(self) -> str:
        """The room in which a person is to be found; empty for none."""
        return self.trial.person_in if isinstance(self.trial, Trial) else ""

    @property
    def max_seconds(self) -> float:
        """Time limit, simulated seconds."""
        if self.is_search:
            return FINDING_SECONDS if self.person_in else MAX_SEARCH_SECONDS
        return EPISODE_SECONDS if isinstance(self.trial, Episode) else TRIAL_SECONDS

    @property
    def name(self) -> str:
        """For the names of files: the command, or the id of the episode."""
        return self.trial.id if isinstance(self.trial, Episode) else self.trial.command

    def options(self, env: SemNavEnv) -> dict[str, Any]:
        """The options with which an environment begins it; the seed scatters a trial's start."""
        if isinstance(self.trial, Episode):
            return {"episode": self.trial}
        drawn = env.plan_source.plan(self.trial.floor_plan)  # furniture keeps off the pose
        rng = np.random.default_rng(self.seed)
        pose = scattered(self.trial, drawn, env.robot, rng)
        told: dict[str, Any] = {
            "command": self.trial.command,
            "floor_plan": self.trial.floor_plan,
        }
        if self.person_in:
            told["floor_plan"] = with_victims(drawn, 1, env.robot, rng, pose[:2], self.person_in)
        return {**told, "pose": pose}

    def named_in_errors(self) -> AbstractContextManager[None]:
        """Add the id of a frozen episode to errors."""
        if isinstance(self.trial, Episode):
            return self.trial.named_in_errors()
        return nullcontext()

    def left_out(self, why: str) -> LeftOut:
        """That it cannot begin."""
        episode = self.trial.id if isinstance(self.trial, Episode) else ""
        return LeftOut(self.trial.command, self.seed, why, episode)

    def result(self, driven: Drive, extras: Extras = NO_EXTRAS) -> Result:
        """The result of its drive."""
        if not isinstance(self.trial, Episode):
            return conclude(driven, self.trial.command, self.seed, extras, group=self.trial.group)
        episode = self.trial
        if episode.expected is Expected.INFEASIBLE:
            driven, extras = driven.as_infeasible(), replace(extras, recheck=False)
        told = episode.command, episode.number, extras
        return conclude(driven, *told, episode=episode.id, group=episode.group)


def suite_jobs(trials: Sequence[Trial | Episode], seeds: Sequence[int] = ()) -> list[SuiteJob]:
    """Every trial with every seed, and every episode, in the order in which they are driven."""
    return [
        SuiteJob(trial, seed)
        for trial in trials
        for seed in ((trial.number,) if isinstance(trial, Episode) else seeds)
    ]


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


def conclude(
    driven: Drive,
    command: str,
    seed: int,
    extras: Extras = NO_EXTRAS,
    *,
    episode: str = "",
    group: str = "",
) -> Result:
    """The result of a driven episode, with a second opinion and a picture of a failure if wanted.

    Args:
        driven: the episode.
        command: name of the command in the results.
        seed: of the episode.
        extras: what else to do.
        episode: id of a frozen episode; otherwise empty.
        group: name under which it is counted; the command if empty.
    """
    result = Result(
        command=command,
        seed=seed,
        verdicts=tuple(str(verdict) for verdict in driven.judge.verdicts),
        metrics=driven.metrics,
        cause=driven.cause,
        rechecked=driven.rechecked() if extras.recheck else "",
        social=driven.social,
        episode=episode,
        group=group or command,
        kind=driven.kind,
        floor_plan=driven.judge.mission.floor_plan.name,
        kept=driven.kept() if extras.keep and not driven.metrics.success else None,
    )
    if extras.pictures is not None and not result.success:
        name = file_stem(driven, episode or command, seed)
        said = failure_line(result)
        driven.save_picture(
            extras.pictures / f"{name}.png", said if episode else f"{command}: {said}"
        )
    return result


def file_stem(driven: Drive, command: str, seed: int) -> str:
    """The name of files about an episode; a long command is cut and gets a checksum."""
    words = re.sub("[^a-z0-9]+", "_", command.lower()).strip("_")
    if len(words) > MAX_NAME_LENGTH:
        words = f"{words[:MAX_NAME_LENGTH]}_{zlib.crc32(command.encode()):08x}"
    return f"{driven.judge.mission.floor_plan.name}-{words}-{driven.robot.name}-seed{seed}"


def scattered(
    trial: Trial, floor_plan: FloorPlan, robot: RobotSpec, rng: np.random.Generator
) -> Pose:
    """A random free pose around that of the trial, each part within its scatter.

    Raises:
        ValueError: none of `MAX_DRAWS` poses was free; says why the last was not.
    """
    x, y, heading = trial.pose
    for _ in range(MAX_DRAWS):
        x, y, heading = (
            p + rng.uniform(-s, s) for p, s in zip(trial.pose, trial.scatter, strict=True)
        )
        if has_room(floor_plan, robot, (x, y, heading)):
            return x, y, heading
    why = placement_error(floor_plan, robot, (x, y, heading))
    raise ValueError(f"{trial.group}: no free pose within {trial.scatter} of the start: {why}")


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
