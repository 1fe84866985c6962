"""An observation of somebody's own that is not in its space is an error that names it."""

from __future__ import annotations

from typing import Any

import gymnasium as gym
import numpy as np
import pytest
from gymnasium.spaces import Box

from semnav_env.env import SemNavEnv
from semnav_env.mind.observations import EntryObservation, Moment
from semnav_env.robots import RobotSpec
from semnav_env.vector import SemNavVectorEnv

SPACE = Box(0.0, 10.0, (2,), np.float32)
WRONG = [
    (np.array([1.0, np.nan], np.float32), r"is nan at \[1\]; its space allows 0.0 to 10.0"),
    (np.array([11.0, 1.0], np.float32), r"is 11.0 at \[0\]; its space allows 0.0 to 10.0"),
    (np.array([1.0, 1.0]), "is float64; its space is float32"),
    (np.ones(3, np.float32), r"has shape \(3,\); its space has \(2,\)"),
    ([1.0, 1.0], "is of type list; it must be a NumPy array"),
    (None, "is of type NoneType; it must be a NumPy array"),
]


class Given:
    """Observes what it was given, from some call on."""

    name = "given"

    def __init__(self, value: Any, good: int = 0, space: gym.Space[Any] = SPACE) -> None:
        self.value, self.good, self._space = value, good, space

    def space(self, robot: RobotSpec, lidar: Any) -> gym.Space[Any]:
        return self._space

    def observe(self, moment: Moment) -> Any:
        self.good -= 1
        return self.value if self.good < 0 else np.ones(2, np.float32)


@pytest.mark.parametrize(("value", "problem"), WRONG)
def test_a_wrong_observation_is_named_at_reset(value: Any, problem: str) -> None:
    with pytest.raises(ValueError, match=f"^the observation {problem}$"):
        SemNavEnv(observation=Given(value)).reset(seed=0)


@pytest.mark.parametrize(("value", "problem"), WRONG)
def test_a_wrong_entry_is_named_in_any_step(value: Any, problem: str) -> None:
    env = SemNavEnv(observation=EntryObservation("raw", [Given(value, 5)]))
    env.reset(seed=0)
    for _ in range(4):
        env.step(np.zeros(2))
    with pytest.raises(ValueError, match=f"^observation entry 'given' {problem}$"):
        env.step(np.zeros(2))


def test_a_vector_says_whose_observation_is_wrong() -> None:
    each = [{"observation": Given(WRONG[0][0], good)} for good in (9, 2)]
    envs = SemNavVectorEnv(2, each=each)
    envs.reset(seed=0)
    with pytest.raises(ValueError, match=r"^robot 1: the observation is nan"):
        envs.step(np.zeros((2, 2), np.float32))


def test_a_wrong_key_is_named() -> None:
    space = gym.spaces.Dict({"a": SPACE})
    for value, problem in (
        ({"b": WRONG[0][0]}, r"has \['b'\]; its space has \['a'\]"),
        (np.ones(2, np.float32), r"has ndarray; its space has \['a'\]"),
        ({"a": WRONG[0][0]}, r"\['a'\] is nan at"),
    ):
        with pytest.raises(ValueError, match=rf"the observation ?{problem}"):
            SemNavEnv(observation=Given(value, space=space)).reset(seed=0)


def test_after_a_wrong_observation_nothing_can_be_stepped() -> None:
    env = SemNavEnv(observation=Given(None))
    with pytest.raises(ValueError, match="the observation"):
        env.reset(seed=0)
    with pytest.raises(RuntimeError, match=r"call reset\(\)"):
        env.step(np.zeros(2))
