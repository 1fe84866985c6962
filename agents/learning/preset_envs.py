"""The environments of a preset, as stable-baselines3 takes them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from gymnasium.spaces import Box
from numpy.typing import NDArray
from stable_baselines3.common.vec_env import VecEnv, VecEnvWrapper
from stable_baselines3.common.vec_env.base_vec_env import VecEnvStepReturn

from semnav_env.agents.evaluation.runner import scattered
from semnav_env.agents.evaluation.suites import Trial
from semnav_env.agents.learning.compact import COMPACT_SIZE, compact
from semnav_env.agents.learning.presets import Preset
from semnav_env.agents.learning.sb3_vec_env import as_sb3_vec_env
from semnav_env.maps import load_floor_plan
from semnav_env.robots import RobotSpec, robot_spec
from semnav_env.tasks import EpisodeRequest


@dataclass(frozen=True)
class TrialTask:
    """Draws one of several trials, and a start pose around its own.

    Attributes:
        trials: to draw from.
        robot: whose body must be free there.
    """

    trials: tuple[Trial, ...]
    robot: RobotSpec

    def request(self, rng: np.random.Generator) -> EpisodeRequest:
        """The command, the floor plan and the start of a trial."""
        trial = self.trials[rng.integers(len(self.trials))]
        pose = scattered(trial, load_floor_plan(trial.floor_plan), self.robot, rng)
        return EpisodeRequest(trial.command, floor_plan=trial.floor_plan, pose=pose)


class CompactVecEnv(VecEnvWrapper):
    """Environments whose observations are `compact`.

    Args:
        venv: environments with `observation="all"`.
    """

    def __init__(self, venv: VecEnv) -> None:
        super().__init__(venv, Box(-1.0, 1.0, (COMPACT_SIZE,), np.float32))

    def reset(self) -> NDArray[np.float32]:
        """Begin episodes."""
        return compact(self.venv.reset())  # type: ignore[arg-type]

    def step_wait(self) -> VecEnvStepReturn:
        """Wait for the step."""
        observations, rewards, over, infos = self.venv.step_wait()
        for k in np.flatnonzero(over).tolist():
            infos[k]["terminal_observation"] = compact(infos[k]["terminal_observation"])
        return compact(observations), rewards, over, infos  # type: ignore[arg-type]


def preset_envs(preset: Preset, **options: Any) -> CompactVecEnv:
    """The environments of a preset: compact observations, repeated actions, its trials.

    Args:
        preset: what to learn.
        options: more of `as_sb3_vec_env`.
    """
    return CompactVecEnv(as_sb3_vec_env(preset.envs, **preset_options(preset), **options))


def preset_options(preset: Preset) -> dict[str, Any]:
    """The arguments of `SemNavVectorEnv` for the environments of a preset."""
    robot, trials = robot_spec(preset.robot), preset.trials
    return {
        "robot": robot,
        "floor_plan": trials[0].floor_plan if trials else preset.floor_plan,
        "observation": "all",
        "rewards": preset.rewards,
        "task": TrialTask(trials, robot) if trials else None,
        "max_seconds": preset.max_seconds,
        "repeat": preset.repeat,
    }
