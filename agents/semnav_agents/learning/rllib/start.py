"""Begin or continue a training on Ray."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from semnav_agents.learning.policy import PolicySettings
from semnav_agents.learning.presets import Preset
from semnav_agents.learning.rllib.options import RayOptions
from semnav_agents.learning.rllib.weights import RLLIB_FILE
from semnav_env.networks.card import Card
from semnav_env.networks.weights import Tensors, load_tensors

if TYPE_CHECKING:  # Ray is optional
    from semnav_agents.learning.rllib.trainer import RayTrainer


def start_training(
    preset: Preset, folder: Path, seed: int, options: RayOptions, resume: bool = False
) -> RayTrainer:
    """Start Ray or join a cluster, compile the kernels on each machine, and begin.

    Args:
        preset: the settings of the training.
        folder: for the agent and its curves.
        seed: of a new training.
        options: where and in how many processes robots are driven.
        resume: continue the training in the folder.

    Raises:
        ImportError: Ray is not installed.
        ValueError: the preset has several bodies or demonstrations; the folder holds no training
            on Ray, a damaged one or one of another preset; or there are fewer cores than the
            runners reserve.
        RuntimeError, ConnectionError: as `connect`.
    """
    if len(preset.robots) > 1 or preset.demonstrations:
        raise ValueError(
            f"--engine ray trains one body from nothing; {preset.name!r} has several bodies or "
            "begins with demonstrations: train it with --engine local"
        )
    saved = _saved(preset, folder) if resume else None
    try:
        from semnav_agents.learning.rllib.cluster import connect, warm_nodes

        connect(options)
        from semnav_agents.learning.rllib.trainer import RayTrainer
    except ModuleNotFoundError as error:
        raise ImportError(
            f'--engine ray needs {error.name}: pip install "semnav-env[rl,ray]" in an environment '
            "of its own, for Ray takes an older Gymnasium than the rest"
        ) from None
    warm_nodes(preset)
    if saved is None:
        return RayTrainer(preset, folder, seed, options)
    return RayTrainer.resume(preset, folder, options, *saved)


def _saved(preset: Preset, folder: Path) -> tuple[Card[PolicySettings], Tensors]:
    """The card and the tensors of an earlier training on Ray in a folder."""
    card = Card.read(folder, PolicySettings)
    if card.preset != preset.plain():
        raise ValueError(
            f"{folder} was trained with another preset than the present {preset.name!r}; "
            "start anew with another --out"
        )
    if not (folder / RLLIB_FILE).is_file():
        raise ValueError(f"{folder} was not trained with --engine ray: no {RLLIB_FILE} in it")
    return card, load_tensors(folder / RLLIB_FILE)
