"""Runs the episodes of a suite in one or several processes."""

from __future__ import annotations

import multiprocessing
import pickle
import re
import zlib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from semnav_agents.base import Agent
from semnav_agents.evaluation.drive import Drive, drive
from semnav_agents.evaluation.results import Result, failure_line
from semnav_agents.evaluation.suites import Trial
from semnav_agents.registry import AgentSource, make_agent
from semnav_env.env import SemNavEnv
from semnav_env.judge.episodes import Episode, Expected
from semnav_env.rendering.film import Film
from semnav_env.robots import RobotSpec
from semnav_env.world.dynamics import NO_DYNAMICS, Dynamics
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
    """

    recheck: bool = False
    pictures: Path | None = None
    films: Path | None = None


NO_EXTRAS = Extras()
"""No further outputs: only drive and measure."""

TRIAL_SECONDS, EPISODE_SECONDS = 120.0, 300.0
"""Time limits of a trial and of a frozen episode, whose routes are longer; simulated seconds."""

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

    Raises:
        ValueError: there is no such agent, or with several workers one that other processes
            cannot import.
    """
    setup = SuiteSetup(agent, robot, extras, dynamics, lidar)
    jobs = [
        (trial, seed)
        for trial in trials
        for seed in ((trial.number,) if isinstance(trial, Episode) else seeds)
    ]
    if workers == 1:
        runner = SuiteRunner(setup)
        yield from (runner.run(trial, seed) for trial, seed in jobs)
        return
    processes = multiprocessing.get_context("spawn")
    with for_this_process_alone():
        pool = processes.Pool(workers, _start_worker, (_pickled(setup),))
    with pool:
        yield from pool.imap(_work, jobs, chunksize=4)


class SuiteRunner:
    """Runs trials and frozen episodes one after the other, with one agent on one body."""

    def __init__(self, setup: SuiteSetup) -> None:
        self._setup = setup
        self._agent = make_agent(setup.agent)
        self._envs: dict[tuple[float, str | None], SemNavEnv] = {}

    def run(self, trial: Trial | Episode, seed: int) -> Result:
        """The result of a trial with that seed, or of a frozen episode."""
        limit = EPISODE_SECONDS if isinstance(trial, Episode) else TRIAL_SECONDS
        extras, env = self._setup.extras, self._env(limit)
        if isinstance(trial, Episode):
            result = run_frozen(env, self._agent, trial, extras)
        else:
            result = run_trial(env, self._agent, trial, seed, extras)
        if extras.films is not None and not result.success:
            self._film(trial, seed, self._env(limit, "rgb_array"), extras.films)
        return result

    def _film(self, trial: Trial | Episode, seed: int, env: SemNavEnv, folder: Path) -> None:
        """Drive a failure once more, with the same result, and film it."""
        film = Film(env, STEPS_PER_FILM_FRAME)
        driven = drive(env, self._agent, seed, reset_options(trial, seed, env), film)
        name = trial.id if isinstance(trial, Episode) else trial.command
        film.save(folder / f"{file_stem(driven, name, seed)}.gif")

    def _env(self, max_seconds: float, render_mode: str | None = None) -> SemNavEnv:
        """The environment with that limit, kept from one episode to the next."""
        kind = max_seconds, render_mode
        if kind not in self._envs:
            setup = self._setup
            self._envs[kind] = SemNavEnv(
                setup.robot,
                observation=self._agent.observation,
                lidar=setup.lidar,
                dynamics=setup.dynamics,
                max_seconds=max_seconds,
                render_mode=render_mode,
            )
        return self._envs[kind]


def reset_options(trial: Trial | Episode, seed: int, env: SemNavEnv) -> dict[str, Any]:
    """The options with which an environment begins a trial or a frozen episode.

    Args:
        trial: what is to be driven.
        seed: scatters the start of a trial.
        env: the environment.
    """
    if isinstance(trial, Episode):
        return {"episode": trial}
    drawn = env.plan_source.plan(trial.floor_plan)  # furniture keeps off the pose
    pose = scattered(trial, drawn, env.robot, np.random.default_rng(seed))
    return {"command": trial.command, "floor_plan": trial.floor_plan, "pose": pose}


def run_trial(
    env: SemNavEnv, agent: Agent, trial: Trial, seed: int, extras: Extras = NO_EXTRAS
) -> Result:
    """Drive a trial once; the seed scatters its start pose."""
    driven = drive(env, agent, seed, reset_options(trial, seed, env))
    return conclude(driven, trial.command, seed, extras, group=trial.group)


def run_frozen(
    env: SemNavEnv, agent: Agent, episode: Episode, extras: Extras = NO_EXTRAS
) -> Result:
    """Drive a frozen episode; its number is the seed."""
    with episode.named_in_errors():
        driven = drive(env, agent, episode.number, {"episode": episode})
    if episode.expected is Expected.INFEASIBLE:
        driven, extras = driven.as_infeasible(), replace(extras, recheck=False)
    told = episode.command, episode.number, extras
    return conclude(driven, *told, episode=episode.id, group=episode.group)


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


def _work(job: tuple[Trial | Episode, int]) -> Result:
    """Run a job; the agent is unpickled here, where an error reaches the caller."""
    if _Worker.runner is None:
        try:
            setup = pickle.loads(_Worker.pickled)
        except (AttributeError, ImportError) as error:
            raise ValueError(f"{_NOT_SHARED}: {error}") from None
        _Worker.runner = SuiteRunner(setup)
    return _Worker.runner.run(*job)


_NOT_SHARED = (
    "several workers need an agent that other processes can import: the class or function must "
    "stand at the top of a module, not in a notebook or inside a function"
)
