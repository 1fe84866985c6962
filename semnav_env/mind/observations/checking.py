"""Checks observations of a user's own type: a value outside its space is an error."""

from __future__ import annotations

from typing import Any

import gymnasium as gym
import numpy as np
from gymnasium.spaces import Box, Dict


def check_observation(value: Any, space: gym.Space[Any], name: str = "the observation") -> None:
    """Refuse an observation that is not in its space, which would silently mislead a learner.

    Args:
        value: the observation.
        space: the declared space.
        name: name of the value, for the message.

    Raises:
        ValueError: it is not in the space; says where and why.
    """
    if isinstance(space, Dict):
        _check_keys(value, space, name)
        for key, part in space.spaces.items():
            check_observation(value[key], part, f"{name}[{key!r}]")
    elif isinstance(space, Box) and isinstance(value, np.ndarray):
        if not space.contains(value):
            raise ValueError(f"{name} {_fault(value, space)}")
    elif isinstance(space, Box):
        raise ValueError(f"{name} is of type {type(value).__name__}; it must be a NumPy array")
    elif not space.contains(value):
        raise ValueError(f"{name} is {value!r:.80}; it must be in {space!r:.80}")


def _check_keys(value: Any, space: Dict, name: str) -> None:
    if not isinstance(value, dict) or value.keys() != space.spaces.keys():
        found = sorted(map(str, value)) if isinstance(value, dict) else type(value).__name__
        raise ValueError(f"{name} has {found!s:.80}; its space has {sorted(space.spaces)!s:.200}")


def _fault(value: np.ndarray, space: Box[Any]) -> str:
    """The reason why an array is not in its space."""
    if not np.can_cast(value.dtype, space.dtype):
        return f"is {value.dtype}; its space is {space.dtype}"
    if value.shape != space.shape:
        return f"has shape {value.shape}; its space has {space.shape}"
    outside = ~((value >= space.low) & (value <= space.high))  # NaN is neither
    where = tuple(int(i) for i in np.argwhere(outside)[0])
    low, high = space.low[where], space.high[where]
    return f"is {value[where]} at {list(where)}; its space allows {low} to {high}"
