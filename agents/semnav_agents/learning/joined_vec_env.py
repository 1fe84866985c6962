"""Several environments with different bodies as one, for one policy."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import accumulate, pairwise
from typing import Any

import gymnasium as gym
import numpy as np
from gymnasium.spaces import Box
from numpy.typing import NDArray
from stable_baselines3.common.vec_env import VecEnv
from stable_baselines3.common.vec_env.base_vec_env import VecEnvIndices, VecEnvStepReturn

from semnav_agents.learning.actions import for_body

Array = NDArray[Any]


class JoinedVecEnv(VecEnv):
    """The robots of several vector environments, one after the other.

    Args:
        parts: vector environments with the same observation space. Their bodies may differ; actions
            are those of the body with the most degrees of freedom.
    """

    def __init__(self, parts: Sequence[VecEnv]) -> None:
        self._parts = list(parts)
        self._sizes = [_action_size(part) for part in parts]
        ends = list(accumulate((part.num_envs for part in parts), initial=0))
        self._slices = [slice(first, end) for first, end in pairwise(ends)]
        space = Box(-1.0, 1.0, (max(self._sizes),), np.float32)
        super().__init__(ends[-1], parts[0].observation_space, space)

    def seed(self, seed: int | None = None) -> list[int | None]:
        """Set the seeds of the next reset; they count up from the seed of the first robot."""
        seeds: list[int | None] = []
        for part in self._parts:
            seeds += part.seed(None if seed is None else seed + len(seeds))
        return seeds

    def reset(self) -> Array:
        """Begin episodes."""
        observations = np.concatenate([_array(part.reset()) for part in self._parts])
        self.reset_infos = [info for part in self._parts for info in part.reset_infos]
        return observations

    def step_async(self, actions: Array) -> None:
        """Store the actions for `step_wait`."""
        for part, rows, size in zip(self._parts, self._slices, self._sizes, strict=True):
            part.step_async(for_body(actions[rows], size))

    def step_wait(self) -> VecEnvStepReturn:
        """Drive all robots while the action holds."""
        stepped = [part.step_wait() for part in self._parts]
        observations, rewards, over = (
            np.concatenate([_array(each[i]) for each in stepped]) for i in range(3)
        )
        return observations, rewards, over, [info for each in stepped for info in each[3]]

    def close(self) -> None:
        """Close all parts."""
        for part in self._parts:
            part.close()

    def get_attr(self, attr_name: str, indices: VecEnvIndices = None) -> list[Any]:
        """The value of an attribute of single environments."""
        values = [value for part in self._parts for value in part.get_attr(attr_name)]
        return [values[k] for k in self._get_indices(indices)]

    def set_attr(self, attr_name: str, value: Any, indices: VecEnvIndices = None) -> None:
        """Set an attribute of single environments to a value."""
        for part, rows in self._chosen(indices):
            part.set_attr(attr_name, value, rows)

    def env_method(
        self, method_name: str, *arguments: Any, indices: VecEnvIndices = None, **options: Any
    ) -> list[Any]:
        """Call a method of the single environments; returns a result for each part."""
        return [
            result
            for part, rows in self._chosen(indices)
            for result in part.env_method(method_name, *arguments, indices=rows, **options)
        ]

    def env_is_wrapped(
        self, wrapper_class: type[gym.Wrapper[Any, Any, Any, Any]], indices: VecEnvIndices = None
    ) -> list[bool]:
        """Single environments are never wrapped."""
        return [False for _ in self._get_indices(indices)]

    def _chosen(self, indices: VecEnvIndices) -> list[tuple[VecEnv, list[int]]]:
        """The parts with the rows of each that are meant."""
        wanted = set(self._get_indices(indices))
        return [
            (part, [k - rows.start for k in range(rows.start, rows.stop) if k in wanted])
            for part, rows in zip(self._parts, self._slices, strict=True)
        ]


def _action_size(part: VecEnv) -> int:
    assert isinstance(part.action_space, Box)
    return part.action_space.shape[0]


def _array(value: Any) -> Array:
    return np.asarray(value)
