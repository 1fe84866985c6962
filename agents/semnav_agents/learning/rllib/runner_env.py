"""The environments of one runner: the native vector environment with compact observations."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from gymnasium.spaces import Box
from gymnasium.vector import VectorWrapper
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

from semnav_agents.learning.compact import COMPACT_SIZE, CompactObserver
from semnav_agents.learning.preset_envs import options_of_body
from semnav_agents.learning.presets import Preset
from semnav_agents.learning.training import LOGGED_KEYS
from semnav_env.robots import robot_spec
from semnav_env.vector import SemNavVectorEnv

Array = NDArray[Any]


class RunnerVectorEnv(VectorWrapper):
    """Vector environment with compact observations and with infos of ended episodes only.

    Observations have shape (n, COMPACT_SIZE). RLlib keeps every info and sends it to the learner,
    so infos that are not logged are left out.

    Args:
        envs: environments with `observation="all"` that reset in the step after an episode's end.
    """

    def __init__(self, envs: SemNavVectorEnv) -> None:
        super().__init__(envs)
        self._envs = envs
        first = envs.envs[0]
        self._observer = CompactObserver([first.robot] * envs.num_envs, first.lidar_spec)
        self._over = np.ones(envs.num_envs, bool)
        self.single_observation_space = Box(-1.0, 1.0, (COMPACT_SIZE,), np.float32)
        self.observation_space = batch_space(self.single_observation_space, envs.num_envs)

    def reset(
        self,
        *,
        seed: int | Sequence[int | None] | None = None,
        options: dict[str, Any] | None = None,
    ) -> tuple[Array, dict[str, Any]]:
        """Begin episodes.

        Args:
            seed: from a whole number each robot draws one of its own. RLlib numbers its runners
                SEED + 1, SEED + 2 and so on; counting on from these, as Gymnasium does, would let
                robots of two runners drive the same episodes.
            options: of `SemNavVectorEnv.reset`.
        """
        if isinstance(seed, int):
            seed = np.random.SeedSequence(seed).generate_state(self.num_envs).tolist()
        observations, _ = self._envs.reset(seed=seed, options=options)
        self._over = np.ones(self.num_envs, bool)
        seen = self._compact(observations)
        self._over = np.zeros(self.num_envs, bool)
        return seen, {}

    def step(self, actions: Array) -> tuple[Array, Array, Array, Array, dict[str, Any]]:
        """Drive all robots for one decision."""
        observations, rewards, terminated, truncated, infos = self._envs.step(actions)
        seen = self._compact(observations)
        self._over = over = terminated | truncated
        ended = {name: infos[name] for name in LOGGED_KEYS} if over.any() else {}
        masks = {f"_{name}": over for name in ended}
        return seen, rewards, terminated, truncated, ended | masks

    def _compact(self, observations: dict[str, Array]) -> Array:
        """Compact observations; robots whose episode ended in the last step start a new episode."""
        self._observer.forget(self._over)
        return self._observer.observe(observations)


def runner_envs(preset: Preset, num_envs: int, threads: int = 1) -> RunnerVectorEnv:
    """The environments of a preset with one body for one runner."""
    [robot] = preset.robots
    options = options_of_body(preset, robot_spec(robot), num_envs)
    return RunnerVectorEnv(SemNavVectorEnv(num_envs, threads=threads, **options))
