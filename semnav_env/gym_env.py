"""Members of an environment for the tools of Gymnasium: its spec, its metadata and its keys."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import wraps
from inspect import signature
from itertools import product
from typing import Any, Generic, ParamSpec, TypeVar

import gymnasium as gym
import numpy as np
from gymnasium.envs.registration import EnvSpec
from numpy.typing import NDArray

from semnav_features.checked_fields import Seconds, checked
from semnav_features.one_thread import ThreadDoor

ObservationT = TypeVar("ObservationT")
P = ParamSpec("P")
R = TypeVar("R")

KEYS = {"w": (0, 1.0), "s": (0, -1.0), "q": (1, 1.0), "e": (1, -1.0), "a": (-1, 1.0)}
KEYS |= {"d": (-1, -1.0)}
"""Keys of the keyboard: which part of an action each sets, and to what. A robot that cannot move
sideways has no q and e."""

PLAYED_SPEED, PLAYED_YAW_RATE = 0.5, 0.4
"""Shares of the largest speeds that a key asks for: a person needs time to look."""


def takes_plain_settings(function: Callable[P, R]) -> Callable[P, R]:
    """Let a function take dictionaries of all fields for settings, see `plain_settings`.

    An unknown argument is a `TypeError` that names the most similar known one.
    """
    known = list(signature(function).parameters)[1:]

    @wraps(function)
    def taking(*args: P.args, **kwargs: P.kwargs) -> R:
        for name in kwargs.keys() - known:
            from semnav_env.plain_settings import no_argument

            raise no_argument(name, known)
        if any(isinstance(value, Mapping) for value in kwargs.values()):
            from semnav_env.plain_settings import SETTINGS, from_plain  # few environments need it

            plain = {
                name: from_plain(kwargs[name], SETTINGS[name]) for name in SETTINGS.keys() & kwargs
            }
            return function(*args, **{**kwargs, **plain})
        return function(*args, **kwargs)

    return taking


class GymnasiumEnv(gym.Env[ObservationT, NDArray[np.float32]], Generic[ObservationT]):
    """An environment with a time limit, render modes and keys.

    Args:
        control_hz: steps per second.
        max_seconds: duration of an episode.
        render_mode: one of `metadata["render_modes"]`, or None.

    Attributes:
        max_steps: number of steps after which an episode is truncated.
    """

    max_steps: int
    thread_door: ThreadDoor
    metadata = {"render_modes": ["rgb_array", "human"], "render_fps": 15}  # noqa: RUF012
    _started = False

    def __init__(self, control_hz: float, max_seconds: float, render_mode: str | None) -> None:
        if render_mode not in (None, *self.metadata["render_modes"]):
            raise ValueError(f"no render mode {render_mode!r}; there are: rgb_array, human")
        self.max_steps = round(checked("max_seconds", max_seconds, Seconds) * control_hz)
        self.render_mode = render_mode
        self.thread_door = ThreadDoor()
        self.metadata = self.metadata | {"render_fps": max(1, round(control_hz))}

    def _require_reset(self, name: str) -> None:
        if not self._started:
            raise RuntimeError(f"call reset() before {name}()")

    @property
    def spec(self) -> EnvSpec | None:
        """The spec from `gymnasium.make`, with the time limit, for `TimeAwareObservation`.

        An environment made from the spec has the same limit again, as a `TimeLimit`. To make an
        environment with another `max_seconds`, add `max_episode_steps=-1`.
        """
        return self._spec

    @spec.setter
    def spec(self, spec: EnvSpec | None) -> None:
        self._spec = None if spec is None else replace(spec, max_episode_steps=self.max_steps)

    _spec: EnvSpec | None = None

    def get_keys_to_action(self) -> dict[tuple[str, ...], NDArray[np.float32]]:
        """Keys for `gymnasium.utils.play`: w and s drive, a and d turn, q and e go sideways.

        `play(env, noop=np.zeros(2, np.float32))` drives the wheelchair; SPOT's actions have three
        parts.
        """
        size = self.action_space.shape[0] if self.action_space.shape else 0
        sideways = "qe" if size == 3 else ""
        groups = (("", *pair) for pair in ("ws", sideways, "ad"))
        pressed = [tuple(filter(None, keys)) for keys in product(*groups)]
        return {keys: self._action_of(keys, size) for keys in pressed if keys}

    @staticmethod
    def _action_of(keys: tuple[str, ...], size: int) -> NDArray[np.float32]:
        action: NDArray[Any] = np.zeros(size, np.float32)
        for key in keys:
            part, sign = KEYS[key]
            action[part] = sign * (PLAYED_YAW_RATE if part == -1 else PLAYED_SPEED)
        return action
