"""The environments of a preset, as stable-baselines3 takes them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from gymnasium.spaces import Box
from numpy.typing import NDArray
from stable_baselines3.common.vec_env import VecEnv, VecEnvWrapper
from stable_baselines3.common.vec_env.base_vec_env import VecEnvStepReturn

from semnav_agents.evaluation.jobs import scattered
from semnav_agents.evaluation.suites import Trial
from semnav_agents.learning.compact import COMPACT_SIZE, CompactObserver
from semnav_agents.learning.joined_vec_env import JoinedVecEnv
from semnav_agents.learning.presets import Preset
from semnav_agents.learning.sb3_vec_env import as_sb3_vec_env
from semnav_env.judge.episodes import Episode, load_episodes
from semnav_env.judge.tasks import EpisodeRequest
from semnav_env.robots import RobotSpec, robot_spec
from semnav_env.world.maps import load_floor_plan

Array = NDArray[np.float32]


@dataclass(frozen=True)
class TrialTask:
    """Draws one of several trials, and a start pose around its own.

    Attributes:
        trials: trials to draw from.
        robot: the body that must be free at the start.
    """

    trials: tuple[Trial, ...]
    robot: RobotSpec

    def request(self, rng: np.random.Generator) -> EpisodeRequest:
        """The command, the floor plan and the start of a trial."""
        trial = self.trials[rng.integers(len(self.trials))]
        pose = scattered(trial, load_floor_plan(trial.floor_plan), self.robot, rng)
        return EpisodeRequest(trial.command, floor_plan=trial.floor_plan, pose=pose)


class CompactVecEnv(VecEnvWrapper):
    """Environments whose observations are compact.

    Args:
        venv: environments with `observation="all"`.
    """

    def __init__(self, venv: VecEnv) -> None:
        super().__init__(venv, Box(-1.0, 1.0, (COMPACT_SIZE,), np.float32))
        [lidar] = set(venv.get_attr("lidar_spec"))
        self._observer = CompactObserver(venv.get_attr("robot"), lidar)

    def reset(self) -> Array:
        """Begin episodes."""
        self._observer.forget(np.ones(self.num_envs, bool))
        return self._observer.observe(self.venv.reset())  # type: ignore[arg-type]

    def step_wait(self) -> VecEnvStepReturn:
        """Wait for the step."""
        observations, rewards, over, infos = self.venv.step_wait()
        for k in np.flatnonzero(over).tolist():
            last = {name: entry[None] for name, entry in infos[k]["terminal_observation"].items()}
            infos[k]["terminal_observation"] = self._observer.observe(last, [k])[0]
        self._observer.forget(over)
        return self._observer.observe(observations), rewards, over, infos  # type: ignore[arg-type]


def preset_envs(preset: Preset, **options: Any) -> VecEnv:
    """The environments of a preset: compact observations, repeated actions, its episodes.

    Args:
        preset: the preset of the training.
        options: further options of `as_sb3_vec_env`.
    """
    parts = [_envs_of_body(preset, robot_spec(robot), options) for robot in preset.robots]
    return parts[0] if len(parts) == 1 else JoinedVecEnv(parts)


def _envs_of_body(preset: Preset, robot: RobotSpec, options: dict[str, Any]) -> CompactVecEnv:
    envs = as_sb3_vec_env(preset.envs, **options_of_body(preset, robot, preset.envs), **options)
    return CompactVecEnv(envs)


def options_of_body(preset: Preset, robot: RobotSpec, count: int) -> dict[str, Any]:
    """The arguments of `SemNavVectorEnv` for some robots of a preset, all with one body."""
    return {
        "robot": robot,
        "observation": "all",
        "rewards": preset.rewards,
        "max_seconds": preset.max_seconds,
        "repeat": preset.repeat,
        "each": _where(preset, robot, count),
    }


def _where(preset: Preset, robot: RobotSpec, count: int) -> list[dict[str, Any]]:
    """The floor plan and the task or the episodes of each environment."""
    if preset.episodes:
        return [{"episodes": each} for each in dealt(load_episodes(preset.episodes), count)]
    task = TrialTask(preset.trials, robot) if preset.trials else None
    return [{"floor_plan": preset.floor_plan, "task": task}] * count


def dealt(episodes: Sequence[Episode], count: int) -> list[list[Episode]]:
    """Distribute episodes over environments by floor plan.

    An environment that stays on one plan need not be set up again for each episode.

    Raises:
        ValueError: fewer floor plans than environments.
    """
    by_plan: dict[str, list[Episode]] = {}
    for episode in episodes:
        by_plan.setdefault(episode.floor_plan, []).append(episode)
    if len(by_plan) < count:
        raise ValueError(f"{len(by_plan)} floor plans are too few for {count} environments")
    plans = list(by_plan.values())
    return [[each for plan in plans[k::count] for each in plan] for k in range(count)]
