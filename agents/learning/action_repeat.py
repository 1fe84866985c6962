"""The environment of a learner: compact observations, repeated actions, the trials of a preset."""

from __future__ import annotations

from typing import Any

import gymnasium as gym
import numpy as np
from gymnasium.spaces import Box
from numpy.typing import NDArray

from semnav_env.agents.evaluation.runner import scattered
from semnav_env.agents.learning.compact import COMPACT_SIZE, compact
from semnav_env.agents.learning.presets import Preset
from semnav_env.env import SemNavEnv
from semnav_env.maps import load_floor_plan

Array = NDArray[np.float32]


class ActionRepeat(gym.Env[Array, Array]):
    """An environment with the episodes of a preset.

    Observations are `compact`. An action holds for `preset.repeat` steps, whose rewards are
    summed. `reset` draws one of the preset's trials and a start pose around its own, unless
    `options` say otherwise.

    Args:
        preset: what to learn.
    """

    def __init__(self, preset: Preset) -> None:
        plan = preset.trials[0].floor_plan if preset.trials else preset.floor_plan
        self.env = SemNavEnv(
            preset.robot,
            plan,
            observation="all",
            rewards=preset.rewards,
            max_seconds=preset.max_seconds,
        )
        self.preset = preset
        self.action_space = self.env.action_space
        self.observation_space = Box(-1.0, 1.0, (COMPACT_SIZE,), np.float32)

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Array, dict[str, Any]]:
        """Begin an episode."""
        super().reset(seed=seed)
        inner = None if seed is None else int(self.np_random.integers(2**31))
        observation, info = self.env.reset(seed=inner, options=options or self._draw())
        return compact(observation), info

    def step(self, action: Array) -> tuple[Array, float, bool, bool, dict[str, Any]]:
        """Hold an action for some steps, or until the episode ends."""
        observation, total, terminated, truncated, info = self.env.step(action)
        for _ in range(1, self.preset.repeat):
            if terminated or truncated:
                break
            observation, reward, terminated, truncated, info = self.env.step(action)
            total += reward
        return compact(observation), total, terminated, truncated, info

    def close(self) -> None:
        """Close the environment."""
        self.env.close()

    def _draw(self) -> dict[str, Any]:
        trials = self.preset.trials
        if not trials:
            return {}
        trial = trials[self.np_random.integers(len(trials))]
        floor_plan = load_floor_plan(trial.floor_plan)
        pose = scattered(trial, floor_plan, self.env.robot, self.np_random)
        return {"command": trial.command, "floor_plan": trial.floor_plan, "pose": pose}
