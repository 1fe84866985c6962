"""Runs episodes, in several processes if asked."""

from __future__ import annotations

import multiprocessing
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from semnav_env.agents.evaluation.results import Result
from semnav_env.agents.evaluation.suites import Trial
from semnav_env.agents.registry import make_agent
from semnav_env.env import SemNavEnv
from semnav_env.features.frames import Pose
from semnav_env.maps import FloorPlan
from semnav_env.maps.placement import placement_error
from semnav_env.robots import RobotSpec


@dataclass(frozen=True)
class Job:
    """One trial with one agent on one body, for some seeds."""

    trial: Trial
    agent: str
    robot: str
    seeds: tuple[int, ...]


def run_suite(
    trials: Sequence[Trial], agent: str, robot: str, seeds: Sequence[int], workers: int = 1
) -> Iterator[Result]:
    """The result of every trial with every seed, as they come.

    Args:
        trials: what to run.
        agent: name of an agent, or the path of a trained one.
        robot: name of a body.
        seeds: each gives a start pose, sensor noise and odometry drift.
        workers: processes; results do not depend on it, but for their order.
    """
    jobs = [Job(trial, agent, robot, (seed,)) for trial in trials for seed in seeds]
    if workers == 1:
        runner = Runner()
        yield from (result for job in jobs for result in runner.run(job))
        return
    with multiprocessing.get_context("spawn").Pool(workers, _start_worker) as pool:
        for results in pool.imap_unordered(_work, jobs, chunksize=4):
            yield from results


class Runner:
    """Runs jobs one after the other and keeps the environment from one to the next."""

    def __init__(self) -> None:
        self._envs: dict[tuple[str, str], tuple[SemNavEnv, Any]] = {}

    def run(self, job: Job) -> list[Result]:
        """The results of a job, one per seed."""
        key = (job.agent, job.robot)
        if key not in self._envs:
            agent = make_agent(job.agent)
            self._envs[key] = SemNavEnv(job.robot, observation=agent.observation), agent
        env, agent = self._envs[key]
        return [run_episode(env, agent, job.trial, seed) for seed in job.seeds]


def run_episode(env: SemNavEnv, agent: Any, trial: Trial, seed: int) -> Result:
    """One episode from a start pose that the seed scatters."""
    options: dict[str, Any] = {"command": trial.command, "floor_plan": trial.floor_plan}
    env.reset(seed=seed, options={"floor_plan": trial.floor_plan})
    options["pose"] = scattered(trial, env.floor_plan, env.robot, np.random.default_rng(seed))
    observation, info = env.reset(seed=seed, options=options)
    agent.reset(info)
    over = False
    while not over:
        observation, _, terminated, truncated, info = env.step(agent.act(observation))
        over = terminated or truncated
    return Result(
        command=trial.command,
        seed=seed,
        success=info["is_success"],
        verdicts=tuple(str(verdict) for verdict in info["verdicts"]),
        collisions=info["collisions"],
        seconds=env.seconds,
        path_length=info["path_length"],
        route_length=info["route_length"],
        remark=info["impossible"] or "",
    )


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
