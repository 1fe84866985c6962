"""Begin or continue a training on Ray."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from semnav_env.agents.learning.presets import Preset
from semnav_env.agents.learning.rllib.options import RayOptions

if TYPE_CHECKING:  # Ray is optional
    from semnav_env.agents.learning.rllib.trainer import RayTrainer


def start_training(
    preset: Preset, folder: Path, seed: int, options: RayOptions, resume: bool = False
) -> RayTrainer:
    """Start Ray or join a cluster, compile the kernels on each machine, and begin.

    Args:
        preset: what to learn.
        folder: for the agent and its curves.
        seed: of a new training.
        options: where and in how many processes robots are driven.
        resume: continue the training in the folder.

    Raises:
        ImportError: Ray is not installed.
        ValueError: as `RayTrainer.resume` and `connect`.
        RuntimeError, ConnectionError: as `connect`.
    """
    try:
        from semnav_env.agents.learning.rllib.cluster import connect, warm_nodes

        connect(options)
        from semnav_env.agents.learning.rllib.trainer import RayTrainer
    except ModuleNotFoundError as error:
        raise ImportError(
            f'--engine ray needs {error.name}: pip install "semnav-env[rl,ray]" in an environment '
            "of its own, for Ray takes an older Gymnasium than the rest"
        ) from None
    warm_nodes(preset)
    if resume:
        return RayTrainer.resume(preset, folder, options)
    return RayTrainer(preset, folder, seed, options)
