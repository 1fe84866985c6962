"""The files of a training: an agent that runs, and the state from which training continues.

Beside `card.json` and `weights.safetensors` (see `semnav_agents.networks`) a folder holds
`training.safetensors`; the state of the checkpoint before is in `training.previous.safetensors`.
Each file is complete by itself and is replaced in one move, so an interruption at any moment leaves
a folder that works.
"""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

from numpy.typing import NDArray

from semnav_agents.learning.policy import Policy, PolicySettings
from semnav_env.networks.card import Card
from semnav_env.networks.weights import Tensors, load_tensors, save_weights, serialised
from semnav_features.writing import replacing, write_file

if TYPE_CHECKING:
    from semnav_agents.learning.presets import Preset

TRAINING_FILE, PREVIOUS_FILE = "training.safetensors", "training.previous.safetensors"
CURVE_FILE = "cloning.json"

CURVES_FOLDER = "tensorboard"
"""Folder of the curves that TensorBoard shows, in that of the agent."""


def save_agent(
    folder: Path, policy: Policy, preset: Preset, seed: int, steps: int, imitated: int = 0
) -> None:
    """Write what an agent needs to run, each file in one move.

    Args:
        folder: of the agent.
        policy: the network.
        preset: that was trained.
        seed: of the training.
        steps: number of decisions so far.
        imitated: number of demonstrations that were imitated first.
    """
    save_weights(folder, policy.tensors)
    settings = PolicySettings(preset.robots, preset.repeat, policy.widths, steps, imitated)
    Card(settings, preset.plain(), seed).write(folder)


def save_curve(folder: Path, losses: list[float]) -> None:
    """Write the mean loss of each pass of cloning, in one move."""
    text = json.dumps([round(loss, 5) for loss in losses]) + "\n"
    write_file(folder / CURVE_FILE, text.encode())


def save_checkpoint(folder: Path, tensors: Mapping[str, NDArray[Any]]) -> None:
    """Write the state from which training continues; the one before it is kept beside it."""
    content = serialised(tensors)
    with replacing(folder / TRAINING_FILE) as part:
        part.write_bytes(content)
        with suppress(FileNotFoundError):
            os.replace(folder / TRAINING_FILE, folder / PREVIOUS_FILE)


def load_checkpoint(folder: Path) -> Tensors:
    """Read the newest state that is complete.

    Raises:
        ValueError: neither state is complete.
        OSError: the newest state cannot be read.
    """
    try:
        return load_tensors(folder / TRAINING_FILE)
    except (ValueError, FileNotFoundError):
        if not (folder / PREVIOUS_FILE).exists():
            raise
        return load_tensors(folder / PREVIOUS_FILE)
