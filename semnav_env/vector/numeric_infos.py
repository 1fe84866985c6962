"""Infos for wrappers that make tensors of everything, such as Gymnasium's `NumpyToTorch`."""

from __future__ import annotations

from typing import Any

import numpy as np
from gymnasium.vector import VectorWrapper


class NumericInfos(VectorWrapper):
    """Leaves out what is text in the infos of a vector environment, and keeps the numbers.

        envs = NumpyToTorch(NumericInfos(gym.make_vec("semnav_env:SemNav-v0", num_envs=8)))

    Args:
        env: the vector environment.
    """

    def reset(self, **options: Any) -> tuple[Any, dict[str, Any]]:
        """Begin episodes; see the environment."""
        observations, infos = self.env.reset(**options)
        return observations, numbers_of(infos)

    def step(self, actions: Any) -> tuple[Any, Any, Any, Any, dict[str, Any]]:
        """Drive all robots; see the environment."""
        observations, rewards, terminated, truncated, infos = self.env.step(actions)
        return observations, rewards, terminated, truncated, numbers_of(infos)


def numbers_of(infos: dict[str, Any]) -> dict[str, Any]:
    """The entries that are arrays of numbers, also within dictionaries, and their masks."""
    parts = {
        name: numbers_of(value) if isinstance(value, dict) else value
        for name, value in infos.items()
    }
    kept = {name for name, value in parts.items() if _is_numeric(value)}
    return {name: value for name, value in parts.items() if name.removeprefix("_") in kept}


def _is_numeric(value: Any) -> bool:
    if isinstance(value, dict):
        return bool(value)
    return isinstance(value, np.ndarray) and value.dtype.kind in "biuf"
