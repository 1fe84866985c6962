"""Proximal policy optimisation from nothing (Schulman et al. 2017), with stable-baselines3."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import torch
from numpy.typing import NDArray
from stable_baselines3 import PPO
from stable_baselines3.common.vec_env import VecEnv
from torch import nn

from studies.learning.command_envs import REPEAT, Array, training_envs
from studies.learning.demonstrations import GAMMA
from studies.learning.progress import Learned, points

ROBOTS, HORIZON = 32, 128
"""Robots that drive at once, and decisions of each between updates."""

LOG_STD, CLONED_LOG_STD = -1.0, -1.6
"""Logarithm of the standard deviation of actions at first, from nothing and after cloning."""

RATE, CLONED_RATE, MAX_KL = 3e-4, 1e-4, 0.03
"""Step sizes of Adam, and the divergence at which an update stops early."""

RESTING_FINGER = -1.0
"""Mean of the finger's action at first: a finger that moved at random would reach the last clause
before the robot had moved."""


def train(seed: int, steps: int, folder: Path) -> Iterator[Learned]:
    """Learn from random weights; gives the policy after each part of the steps."""
    model = new_model(training_envs(ROBOTS), seed, RATE, LOG_STD)
    rest_finger(model.policy.action_net)
    yield from reinforced(model, points(0, steps))


@torch.no_grad()
def rest_finger(action_net: nn.Module) -> None:
    """Let the mean of the finger's action begin at `RESTING_FINGER`."""
    assert isinstance(action_net, nn.Linear)
    action_net.bias[-1] = RESTING_FINGER


def new_model(envs: VecEnv, seed: int, rate: float, log_std: float) -> PPO:
    """The policy and its value function, two layers of 256 units each."""
    return PPO(
        "MlpPolicy",
        envs,
        learning_rate=rate,
        n_steps=HORIZON,
        batch_size=1024,
        n_epochs=6,
        gamma=GAMMA,
        target_kl=MAX_KL,
        policy_kwargs={"net_arch": [256, 256], "log_std_init": log_std},
        seed=seed,
        device="cpu",
    )


def reinforced(model: PPO, ends: list[int], before: int = 0) -> Iterator[Learned]:
    """Go on with PPO to each of some numbers of steps, of which some were made before."""
    for end in ends:
        decisions = (end - before) // REPEAT - model.num_timesteps
        model.learn(decisions, reset_num_timesteps=False)
        yield Learned(before + REPEAT * model.num_timesteps, lambda seen, _: act(model, seen))


def act(model: PPO, seen: Array) -> NDArray[Any]:
    """The mean action."""
    actions: NDArray[Any] = model.predict(seen, deterministic=True)[0]
    return actions
