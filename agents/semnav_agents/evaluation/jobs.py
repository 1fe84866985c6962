"""What a suite runs: a trial with a seed, or a frozen episode."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from semnav_agents.evaluation.conclusion import NO_EXTRAS, Extras, conclude
from semnav_agents.evaluation.drive import Drive
from semnav_agents.evaluation.results import LeftOut, Result
from semnav_agents.evaluation.suites import Trial
from semnav_env.env import SemNavEnv
from semnav_env.judge.episodes import Episode, Expected
from semnav_env.rescue.environment import MAX_SEARCH_SECONDS
from semnav_env.robots import RobotSpec
from semnav_env.world.dynamics.victims import with_victims
from semnav_env.world.maps import FloorPlan
from semnav_env.world.maps.placement import MAX_DRAWS, has_room, placement_error
from semnav_features.frames import Pose

FINDING_SECONDS = 900.0
"""Time limit of a trial in which people are found as told, simulated seconds."""

TRIAL_SECONDS, EPISODE_SECONDS = 120.0, 300.0
"""Time limits of a trial and of a frozen episode, whose routes are longer; simulated seconds."""


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
