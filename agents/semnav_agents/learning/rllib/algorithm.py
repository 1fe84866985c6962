"""The PPO of RLlib with the settings of a preset."""

from __future__ import annotations

import logging
import math
from collections.abc import Mapping
from functools import partial
from typing import Any

import gymnasium as gym
from ray.rllib.algorithms.ppo import PPO, PPOConfig
from ray.rllib.callbacks.callbacks import RLlibCallback
from ray.rllib.core.rl_module.default_model_config import DefaultModelConfig
from ray.tune.registry import register_env

from semnav_agents.learning.presets import Preset
from semnav_agents.learning.rllib.options import RayOptions
from semnav_agents.learning.rllib.runner_env import RunnerVectorEnv, runner_envs
from semnav_env.judge.metrics import spl

ENVIRONMENT = "semnav-preset"
"""Name under which Ray knows the environments."""

MEASURES = ("success", "contact_free", "spl")
"""Measures of an episode that the curves are made of, besides its reward."""

WINDOW = 100
"""Episodes over which the curves are means."""


class EpisodeMeasures(RLlibCallback):
    """Logs the measures of each episode at its end."""

    def on_episode_end(self, *, episode: Any, metrics_logger: Any, **_: Any) -> None:
        """Log an episode."""
        info = episode.get_infos(-1)
        success = bool(info["is_success"])
        values = (
            success,
            info["collisions"] == 0,
            spl(success, info["path_length"], info["route_length"]),
        )
        for name, value in zip(MEASURES, values, strict=True):
            metrics_logger.log_value(name, float(value), window=WINDOW)


def build_algorithm(preset: Preset, seed: int, options: RayOptions) -> PPO:
    """Build RLlib's PPO for a preset, as similar as possible to stable-baselines3; Ray must run.

    RLlib cannot stop an update at `max_kl`. Its penalty on the divergence is not used, and hidden
    layers start orthogonal: with the defaults of RLlib, one training needed twice as many decisions
    (docs/guides/cluster.md).
    """
    logging.getLogger("ray.rllib").setLevel(logging.ERROR)
    register_env(ENVIRONMENT, partial(_envs, preset, options.threads))
    ppo = preset.ppo
    config = (
        PPOConfig()
        .environment(ENVIRONMENT)
        .env_runners(
            num_env_runners=options.runners,
            num_envs_per_env_runner=options.robots_each(preset),
            num_cpus_per_env_runner=options.threads,
            gym_env_vectorize_mode=gym.VectorizeMode.VECTOR_ENTRY_POINT,
            rollout_fragment_length=ppo.rollout,
        )
        .rl_module(
            model_config=DefaultModelConfig(
                fcnet_hiddens=list(ppo.hidden),
                fcnet_activation="tanh",
                fcnet_kernel_initializer="orthogonal_",
                fcnet_kernel_initializer_kwargs={"gain": math.sqrt(2.0)},
                vf_share_layers=False,
                free_log_std=True,
            )
        )
        .training(
            train_batch_size_per_learner=options.decisions(preset),
            minibatch_size=min(ppo.batch_size, options.decisions(preset)),
            num_epochs=ppo.epochs,
            lr=ppo.learning_rate,
            gamma=ppo.gamma,
            lambda_=ppo.gae_lambda,
            clip_param=ppo.clip_range,
            entropy_coeff=ppo.entropy,
            use_kl_loss=False,
            vf_loss_coeff=0.5,
            vf_clip_param=float("inf"),
            grad_clip=0.5,
        )
        .callbacks(EpisodeMeasures)
        .reporting(metrics_num_episodes_for_smoothing=WINDOW)
        .fault_tolerance(restart_failed_env_runners=True)
        .debugging(seed=seed, log_level="ERROR", log_sys_usage=False)
    )
    return config.build_algo()


def _envs(preset: Preset, threads: int, context: Mapping[str, Any]) -> RunnerVectorEnv:
    return runner_envs(preset, context["num_envs"], threads)
