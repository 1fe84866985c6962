"""Training by proximal policy optimisation."""

from __future__ import annotations

import time
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import torch
from stable_baselines3 import PPO
from stable_baselines3.common.logger import configure
from stable_baselines3.common.vec_env import VecMonitor

from semnav_agents.learning.cloning import EPOCHS, clone
from semnav_agents.learning.files import (
    CURVES_FOLDER,
    TRAINING_FILE,
    load_checkpoint,
    save_agent,
    save_checkpoint,
    save_curve,
)
from semnav_agents.learning.imitation import demonstrations, load_demonstrations
from semnav_agents.learning.policy import Policy, PolicySettings
from semnav_agents.learning.preset_envs import preset_envs
from semnav_agents.learning.presets import Preset
from semnav_agents.learning.reports import Preparation, TrainingReport
from semnav_agents.learning.state import read_state, write_state
from semnav_env.judge.metrics import spl
from semnav_env.networks.card import Card

LOGGED_KEYS = ("is_success", "collisions", "path_length", "route_length")
"""Keys of an episode's last `info` that are logged."""


class Trainer:
    """One training, kept in one folder.

    Args:
        preset: the settings of the training.
        folder: for the agent and, in `tensorboard`, the curves; made if it does not exist.
        seed: of weights, trials, noise and exploration.
    """

    def __init__(self, preset: Preset, folder: Path, seed: int) -> None:
        folder.mkdir(parents=True, exist_ok=True)
        torch.set_num_threads(1)  # a small network is slower with more
        self.preset, self.folder, self.seed = preset, folder, seed
        self._envs = VecMonitor(preset_envs(preset), info_keywords=LOGGED_KEYS)
        self.model = _model(preset, self._envs, _seed_from(seed, 0))
        if preset.ppo.anneal:
            self.model.lr_schedule = self._step_size
        self._imitated = 0
        self.model.set_logger(configure(str(folder / CURVES_FOLDER), ["tensorboard"]))

    @classmethod
    def resume(cls, preset: Preset, folder: Path) -> Trainer:
        """Continue the training in a folder from its last checkpoint.

        The result is, bit for bit, that of a training without an interruption.

        Raises:
            ValueError: the folder holds no training, a damaged one or one of another preset.
        """
        card = Card.read(folder, PolicySettings)
        _check_same(preset, card.preset, folder)
        tensors = load_checkpoint(folder)
        trainer = cls(preset, folder, card.seed)
        try:
            trainer._imitated = read_state(trainer.model, tensors)
        except ValueError as error:
            raise ValueError(f"{folder / TRAINING_FILE}: {error}") from None
        return trainer

    def prepare(self) -> Iterator[Preparation]:
        """Imitate the demonstrations of the preset, if it has any and nothing was learned yet.

        Yields:
            The progress after each demonstration and each pass; saves before the last one.
        """
        count = self.preset.demonstrations
        if not count or self.steps or self._imitated:
            return
        folder = self.folder / "demonstrations"
        for driven in demonstrations(self.preset, self.seed, folder):
            yield Preparation("demonstrations", driven, count)
        curve: list[float] = []
        for loss in clone(self.model, load_demonstrations(folder), self.seed):
            curve.append(loss)
            if len(curve) == EPOCHS:
                self._imitated = count
                save_curve(self.folder, curve)
                self.save()
            yield Preparation("cloning", len(curve), EPOCHS, loss)

    def advance(self) -> TrainingReport:
        """Drive one rollout and learn from it."""
        start, before = time.perf_counter(), self.steps
        if self.is_resumable:
            self._begin_stretch()
        size = self.model.n_steps * self.model.n_envs
        # log_interval=None: the curves are written below, together with measures that SB3 lacks
        self.model.learn(size, reset_num_timesteps=False, log_interval=None)  # type: ignore[arg-type]
        episodes = list(self.model.ep_info_buffer or ())
        report = TrainingReport(
            steps=self.steps,
            rate=(self.steps - before) / (time.perf_counter() - start),
            success=_mean(list(self.model.ep_success_buffer or ())),
            contact_free=_mean([episode["collisions"] == 0 for episode in episodes]),
            spl=_mean([_spl(episode) for episode in episodes]),
            reward=_mean([episode["r"] for episode in episodes]),
        )
        if episodes:
            self.model.logger.record("rollout/contact_free", report.contact_free)
            self.model.logger.record("rollout/spl", report.spl)
        self.model.dump_logs()
        return report

    def save(self) -> None:
        """Write the present agent and, if training can be resumed from here, a checkpoint."""
        policy = _actor(self.model)
        if self.is_resumable:
            save_checkpoint(self.folder, write_state(self.model, self._imitated))
        save_agent(self.folder, policy, self.preset, self.seed, self.steps, self._imitated)

    @property
    def steps(self) -> int:
        """Number of decisions so far."""
        return int(self.model.num_timesteps)

    @property
    def is_resumable(self) -> bool:
        """Whether a stretch has ended, so that a checkpoint can be made."""
        stretch = self.preset.ppo.stretch * self.model.n_steps * self.model.n_envs
        return self.steps % stretch == 0

    def _begin_stretch(self) -> None:
        """Reset all robots and all generators, with seeds that follow from seed and decisions."""
        self.model.set_random_seed(_seed_from(self.seed, self.steps))
        self.model._last_obs = None  # so that SB3 resets the environments

    def _step_size(self, _: float) -> float:
        """The step size now: it falls linearly, to a hundredth."""
        left = max(0.01, 1.0 - self.steps / self.preset.steps)
        return left * self.preset.ppo.learning_rate

    def close(self) -> None:
        """Finish the curves and close the environments."""
        self.model.logger.close()
        self._envs.close()


def _model(preset: Preset, envs: VecMonitor, seed: int) -> PPO:
    """The model of stable-baselines3, whose warning of a last, smaller batch is no news here."""
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", "You have specified a mini-batch size", UserWarning)
        return _new_model(preset, envs, seed)


def _new_model(preset: Preset, envs: VecMonitor, seed: int) -> PPO:
    ppo = preset.ppo
    return PPO(
        "MlpPolicy",
        envs,
        learning_rate=ppo.learning_rate,
        n_steps=ppo.rollout,
        batch_size=ppo.batch_size,
        n_epochs=ppo.epochs,
        gamma=ppo.gamma,
        gae_lambda=ppo.gae_lambda,
        clip_range=ppo.clip_range,
        ent_coef=ppo.entropy,
        target_kl=ppo.max_kl,
        policy_kwargs={
            "net_arch": {"pi": list(ppo.hidden), "vf": list(ppo.hidden)},
            "log_std_init": ppo.log_std,
        },
        seed=seed,
        device="cpu",
    )


def _seed_from(seed: int, steps: int) -> int:
    return int(np.random.SeedSequence((seed, steps)).generate_state(1)[0])


def _actor(model: PPO) -> Policy:
    """The part of the model that gives the mean action."""
    network = model.policy.mlp_extractor.policy_net
    return Policy.of_layers(
        [
            (layer.weight.detach().numpy().copy(), layer.bias.detach().numpy().copy())
            for layer in (*network, model.policy.action_net)
            if isinstance(layer, torch.nn.Linear)
        ]
    )


def _check_same(preset: Preset, then: dict[str, Any], folder: Path) -> None:
    for name, value in preset.plain().items():
        if then.get(name) != value:
            raise ValueError(
                f"{folder} was trained with another preset: {name} was {then.get(name)!r:.60}, "
                f"{preset.name!r} has {value!r:.60}; start anew with another --out"
            )


def _spl(episode: dict[str, Any]) -> float:
    return spl(episode["is_success"], episode["path_length"], episode["route_length"])


def _mean(values: list[Any]) -> float:
    return float(np.mean(values)) if values else float("nan")
