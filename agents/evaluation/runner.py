"""Runs episodes, in several processes if asked."""

from __future__ import annotations

import multiprocessing
import re
import zlib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from semnav_env.agents.evaluation.drive import Drive, drive
from semnav_env.agents.evaluation.results import Result, failure_line
from semnav_env.agents.evaluation.suites import Trial
from semnav_env.agents.registry import make_agent
from semnav_env.dynamics import OFF, Dynamics
from semnav_env.env import CONTROL_HZ, SemNavEnv
from semnav_env.episodes import Episode, Expected
from semnav_env.features.frames import Pose
from semnav_env.maps import FloorPlan
from semnav_env.maps.placement import placement_error
from semnav_env.robots import RobotSpec


@dataclass(frozen=True)
class Extras:
    """What else to do with an episode.

    Attributes:
        recheck: ask for a second opinion.
        pictures: folder for a picture of each failure.
    """

    recheck: bool = False
    pictures: Path | None = None


NO_EXTRAS = Extras()

LONGEST = 300.0
"""Frozen episodes may take so long, simulated seconds."""

LONGEST_NAME = 90
"""Characters of a command in the name of a picture."""


@dataclass(frozen=True)
class Job:
    """One trial or frozen episode with one agent on one body, for some seeds."""

    trial: Trial | Episode
    agent: str
    robot: str
    seeds: tuple[int, ...]
    extras: Extras = NO_EXTRAS
    dynamics: Dynamics = OFF


def run_suite(
    trials: Sequence[Trial | Episode],
    agent: str,
    robot: str,
    seeds: Sequence[int] = (),
    workers: int = 1,
    extras: Extras = NO_EXTRAS,
    dynamics: Dynamics = OFF,
) -> Iterator[Result]:
    """The result of every trial with every seed, in their order.

    Args:
        trials: what to run; an episode has one seed, its number.
        agent: name of an agent, or the path of a trained one.
        robot: name of a body.
        seeds: each gives a trial's start pose, sensor noise and odometry drift.
        workers: processes; results do not depend on it.
        extras: what else to do with each episode.
        dynamics: what else moves.
    """
    jobs = [
        Job(trial, agent, robot, (seed,), extras, dynamics)
        for trial in trials
        for seed in ((trial.number,) if isinstance(trial, Episode) else seeds)
    ]
    if workers == 1:
        runner = Runner()
        yield from (result for job in jobs for result in runner.run(job))
        return
    with multiprocessing.get_context("spawn").Pool(workers, _start_worker) as pool:
        for results in pool.imap(_work, jobs, chunksize=4):
            yield from results


class Runner:
    """Runs jobs one after the other and keeps the environment from one to the next."""

    def __init__(self) -> None:
        self._envs: dict[tuple[str, str, Dynamics], tuple[SemNavEnv, Any]] = {}

    def run(self, job: Job) -> list[Result]:
        """The results of a job, one per seed."""
        key = (job.agent, job.robot, job.dynamics)
        if key not in self._envs:
            agent = make_agent(job.agent)
            env = SemNavEnv(job.robot, observation=agent.observation, dynamics=job.dynamics)
            self._envs[key] = env, agent
        env, agent = self._envs[key]
        if isinstance(job.trial, Episode):
            return [run_frozen(env, agent, job.trial, job.extras)]
        return [run_episode(env, agent, job.trial, seed, job.extras) for seed in job.seeds]


def run_episode(
    env: SemNavEnv, agent: Any, trial: Trial, seed: int, extras: Extras = NO_EXTRAS
) -> Result:
    """One episode from a start pose that the seed scatters."""
    drawn = env.plan_source.plan({"floor_plan": trial.floor_plan})  # furniture keeps off the pose
    pose = scattered(trial, drawn, env.robot, np.random.default_rng(seed))
    options = {"command": trial.command, "floor_plan": trial.floor_plan, "pose": pose}
    driven = drive(env, agent, seed, options)
    return conclude(driven, trial.command, seed, extras, group=trial.group)


def run_frozen(env: SemNavEnv, agent: Any, episode: Episode, extras: Extras = NO_EXTRAS) -> Result:
    """An episode that was written down, with its number as the seed and time for long ways."""
    usual, env.max_steps = env.max_steps, round(LONGEST * CONTROL_HZ)
    try:
        with episode.named_in_errors():
            driven = drive(env, agent, episode.number, {"episode": episode})
    finally:
        env.max_steps = usual
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
    """What came of a driven episode; asks for a second opinion and draws a failure if wanted.

    Args:
        driven: the episode.
        command: as the results name it.
        seed: of the episode.
        extras: what else to do.
        episode: the id of one that was written down.
        group: under which it is counted; the command if empty.
    """
    result = Result(
        command=command,
        seed=seed,
        verdicts=tuple(str(verdict) for verdict in driven.verifier.verdicts),
        metrics=driven.metrics,
        cause=driven.cause,
        rechecked=driven.rechecked() if extras.recheck else "",
        social=driven.social,
        episode=episode,
        group=group or command,
        kind=driven.kind,
        floor_plan=driven.verifier.floor_plan.name,
    )
    if extras.pictures is not None and not result.success:
        name = picture_name(driven, episode or command, seed)
        said = failure_line(result)
        driven.save_picture(extras.pictures / name, said if episode else f"{command}: {said}")
    return result


def picture_name(driven: Drive, command: str, seed: int) -> str:
    """The file name of the picture of an episode; long commands are cut and told by a checksum."""
    words = re.sub("[^a-z0-9]+", "_", command.lower()).strip("_")
    if len(words) > LONGEST_NAME:
        words = f"{words[:LONGEST_NAME]}_{zlib.crc32(command.encode()):08x}"
    return f"{driven.verifier.floor_plan.name}-{words}-{driven.robot.name}-seed{seed}.png"


def scattered(
    trial: Trial, floor_plan: FloorPlan, robot: RobotSpec, rng: np.random.Generator
) -> Pose:
    """A free pose around the trial's, each part within its scatter."""
    while True:
        x, y, heading = (
            p + rng.uniform(-s, s) for p, s in zip(trial.pose, trial.scatter, strict=True)
        )
        if placement_error(floor_plan, robot, (x, y, heading)) is None:
            return x, y, heading


_RUNNER: list[Runner] = []


def _start_worker() -> None:
    _RUNNER.append(Runner())


def _work(job: Job) -> list[Result]:
    return _RUNNER[0].run(job)
