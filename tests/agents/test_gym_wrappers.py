"""Gymnasium's own wrappers make an observation or an action that a learner wants."""

from __future__ import annotations

import gymnasium as gym
import numpy as np
from gymnasium.spaces import Box, Discrete, flatdim
from gymnasium.wrappers import (
    FilterObservation,
    FlattenObservation,
    FrameStackObservation,
    TransformAction,
    TransformObservation,
)

ID = "semnav_env:SemNav-v0"

TWISTS = np.array([(1.0, 0.0), (0.5, 0.5), (0.5, -0.5), (0.0, 0.5), (0.0, -0.5)], np.float32)
"""Actions to choose from: ahead, two arcs, two turns on the spot."""


def test_actions_can_be_chosen_from_a_list() -> None:
    env = TransformAction(gym.make(ID), lambda k: TWISTS[k], Discrete(len(TWISTS)))
    env.reset(seed=0)
    *_, info = env.step(3)
    twin = gym.make(ID)
    twin.reset(seed=0)
    *_, same = twin.step(TWISTS[3])
    assert tuple(info["pose"]) == tuple(same["pose"])


def test_tokens_of_the_command_become_one_hot() -> None:
    env = FlattenObservation(FilterObservation(gym.make(ID, observation="command"), ["command"]))
    observation, _ = env.reset(seed=0)
    space = env.unwrapped.observation_space["command"]
    assert observation.shape == (flatdim(space),)
    assert set(np.unique(observation)) == {0.0, 1.0}
    assert observation.sum() == len(space.nvec)


def test_the_last_observations_can_be_stacked() -> None:
    env = FrameStackObservation(FilterObservation(gym.make(ID), ["odometry"]), 4)
    first, _ = env.reset(seed=0)
    assert first["odometry"].shape == (4, 7)
    seen, *_ = env.step(np.array([1.0, 0.0], np.float32))
    assert (seen["odometry"][:3] == first["odometry"][1:]).all()


def test_odometry_can_be_seen_from_the_step_before() -> None:
    """Two stacked rows give the increment in the frame of the first one."""

    def increment(rows: np.ndarray) -> np.ndarray:
        (x, y, c, s), (to_x, to_y, to_c, to_s) = rows[:, :4].astype(np.float64)
        dx, dy = to_x - x, to_y - y
        place = c * dx + s * dy, c * dy - s * dx
        return np.array([*place, c * to_c + s * to_s, c * to_s - s * to_c], np.float32)

    env = FrameStackObservation(FilterObservation(gym.make(ID), ["odometry"]), 2)
    relative = TransformObservation(
        env, lambda seen: increment(seen["odometry"]), Box(-1.0, 1.0, (4,), np.float32)
    )
    relative.reset(seed=0)
    for _ in range(10):
        seen, *_ = relative.step(np.array([1.0, 0.0], np.float32))
    assert 0.0 < seen[0] < 0.11
    assert abs(seen[1]) < 0.01
    assert seen[2] > 0.99
