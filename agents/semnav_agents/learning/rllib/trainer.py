"""Training by RLlib's PPO on the machines of a Ray cluster."""

from __future__ import annotations

import os
import time
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

import numpy as np
import ray
import torch
from ray.rllib.core import DEFAULT_MODULE_ID
from torch.utils.tensorboard import SummaryWriter

from semnav_agents.learning.files import CURVES_FOLDER, save_agent
from semnav_agents.learning.policy import PolicySettings
from semnav_agents.learning.presets import Preset
from semnav_agents.learning.reports import Preparation, TrainingReport
from semnav_agents.learning.rllib.algorithm import MEASURES, build_algorithm
from semnav_agents.learning.rllib.options import RayOptions
from semnav_agents.learning.rllib.weights import (
    RLLIB_FILE,
    Moments,
    RLlibState,
    Weights,
    beginning,
    policy_from,
)
from semnav_env.networks.card import Card
from semnav_env.networks.weights import Tensors, save_tensors

SAMPLED = "num_env_steps_sampled_lifetime"
"""RLlib's name for the number of decisions of all runners."""


class RayTrainer:
    """One training on RLlib, kept in one folder; Ray must run, see `start_training`.

    Args:
        preset: what to learn.
        folder: for the agent and, in `tensorboard`, the curves; made if it does not exist.
        seed: of weights, trials, noise and exploration.
        options: in how many processes robots are driven.
        steps: number of decisions that were trained before; 0 for a new training.
    """

    def __init__(
        self, preset: Preset, folder: Path, seed: int, options: RayOptions, steps: int = 0
    ) -> None:
        folder.mkdir(parents=True, exist_ok=True)
        torch.set_num_threads(1)  # a small network is slower with more
        self.preset, self.folder, self.seed = preset, folder, seed
        self.steps: int
        self._first: int
        drawn = np.random.SeedSequence((seed, steps)).generate_state(1)[0]
        self.algorithm = build_algorithm(preset, int(drawn) // 2, options)
        self._curves = SummaryWriter(str(folder / CURVES_FOLDER))
        self._put(RLlibState(beginning(self._weights(), preset.ppo.log_std), {}, steps))

    @classmethod
    def resume(
        cls,
        preset: Preset,
        folder: Path,
        options: RayOptions,
        card: Card[PolicySettings],
        tensors: Tensors,
    ) -> RayTrainer:
        """Continue a training.

        Weights, the optimizer's state, the number of decisions and the seed are restored.
        Unfinished episodes and the states of the random generators are not restored.

        Args:
            preset: what to learn.
            folder: of the training.
            options: in how many processes robots are driven.
            card: of the agent in the folder.
            tensors: of the file `RLLIB_FILE` in the folder.

        Raises:
            ValueError: the tensors do not fit the preset.
        """
        trainer = cls(preset, folder, card.seed, options, card.settings.steps)
        try:
            trainer._put(RLlibState.from_tensors(tensors, trainer._weights()))
        except ValueError as error:
            trainer.close()
            raise ValueError(f"{folder / RLLIB_FILE}: {error}") from None
        return trainer

    is_resumable = True
    """Whether a checkpoint can be made."""

    def prepare(self) -> Iterator[Preparation]:
        """Do nothing: RLlib needs no preparation before the first rollout."""
        return iter(())

    def advance(self) -> TrainingReport:
        """Let all runners drive one rollout, and learn from it."""
        start, before = time.perf_counter(), self.steps
        result = self.algorithm.train()["env_runners"]
        self.steps = self._first + int(result.get(SAMPLED, before - self._first))
        seconds = time.perf_counter() - start
        shares = {name: float(result.get(name, np.nan)) for name in MEASURES}
        reward = float(result.get("episode_return_mean", np.nan))
        for name, value in (shares | {"ep_rew_mean": reward}).items():
            self._curves.add_scalar(f"rollout/{name}", value, self.steps)
        return TrainingReport(self.steps, (self.steps - before) / seconds, **shares, reward=reward)

    def save(self) -> None:
        """Write the files of the folder, each in one move."""
        weights = self._weights()
        policy = policy_from(weights, len(self.preset.ppo.hidden))
        state = RLlibState(weights, self._moments(), self.steps)
        save_tensors(self.folder / RLLIB_FILE, state.tensors())
        save_agent(self.folder, policy, self.preset, self.seed, self.steps)

    def close(self) -> None:
        """Finish the curves, and end the runners and, if it was started here, Ray."""
        self._curves.close()
        self.algorithm.stop()
        with suppress(OSError):
            os.rmdir(self.algorithm.logdir)  # RLlib makes one, which stays empty
        ray.shutdown()

    def _weights(self) -> Weights:
        state = self.algorithm.learner_group.get_state(components="learner/rl_module")
        return dict(state["learner"]["rl_module"][DEFAULT_MODULE_ID])

    def _moments(self) -> Moments:
        """The moments of Adam by parameter."""
        state = self.algorithm.learner_group.get_state(components="learner/optimizer")
        (adam,) = state["learner"]["optimizer"].values()
        moments: Moments = adam["state"]["state"]
        return moments

    def _put(self, begun: RLlibState) -> None:
        """Set the weights, here and in all runners, the state of Adam and the count."""
        group = self.algorithm.learner_group
        state = group.get_state(components="learner/optimizer")["learner"]
        for adam in state["optimizer"].values():
            adam["state"] = adam["state"] | {"state": begun.adam}
        weights = {"rl_module": {DEFAULT_MODULE_ID: begun.weights}}
        group.set_state({"learner": state | weights})
        # RLlib's own sync_weights drops these while those of a new algorithm are on their way.
        self.algorithm.env_runner_group.foreach_env_runner(
            "set_state", kwargs={"state": weights}, local_env_runner=False
        )
        self._first = self.steps = begun.steps
