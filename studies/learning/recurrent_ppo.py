"""Recurrent PPO from nothing, with sb3-contrib: an LSTM may remember what the vector leaves out."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from sb3_contrib import RecurrentPPO

from studies.learning.command_envs import REPEAT, Array, training_envs
from studies.learning.demonstrations import GAMMA
from studies.learning.ppo import HORIZON, LOG_STD, MAX_KL, RATE, ROBOTS, rest_finger
from studies.learning.progress import Learned, points


def train(seed: int, steps: int, folder: Path) -> Iterator[Learned]:
    """Learn from random weights; gives the policy after each part of the steps."""
    model = RecurrentPPO(
        "MlpLstmPolicy",
        training_envs(ROBOTS),
        learning_rate=RATE,
        n_steps=HORIZON,
        batch_size=1024,
        n_epochs=4,
        gamma=GAMMA,
        target_kl=MAX_KL,
        policy_kwargs={
            "net_arch": [128],
            "lstm_hidden_size": 128,
            "shared_lstm": True,
            "enable_critic_lstm": False,
            "log_std_init": LOG_STD,
        },
        seed=seed,
        device="cpu",
    )
    rest_finger(model.policy.action_net)
    for end in points(0, steps):
        model.learn(end // REPEAT - model.num_timesteps, reset_num_timesteps=False)
        yield Learned(REPEAT * model.num_timesteps, _Remembering(model))


class _Remembering:
    """The mean action, and the memory of the LSTM from one decision to the next."""

    def __init__(self, model: RecurrentPPO) -> None:
        self._model = model
        self._memory: tuple[NDArray[Any], ...] | None = None

    def __call__(self, seen: Array, begun: NDArray[np.bool_]) -> Any:
        """Actions; robots that have begun an episode remember nothing."""
        actions, self._memory = self._model.predict(seen, self._memory, begun, deterministic=True)
        return actions
