"""The files of a trained agent: JSON and safetensors, which run no code when they are read.

A folder holds `agent.json` (what was trained), `policy.safetensors` (the network that the agent
runs) and `training.safetensors` (the state from which training continues; that of the checkpoint
before is in `training.previous.safetensors`). Each file is complete by itself and is replaced in
one move, so an interruption at any moment leaves a folder that works.
"""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from numpy.typing import NDArray

from semnav_features.reading import read_bytes
from semnav_features.validation import clipped
from semnav_features.writing import replacing, write_file

if TYPE_CHECKING:
    from semnav_agents.learning.policy import Policy
    from semnav_agents.learning.presets import Preset

Array = NDArray[Any]

FORMAT_VERSION = 2
"""Version of the files in the folder; other versions are refused."""

MAX_FILE_SIZE = 64 * 2**20
"""Largest file that is read, bytes; a small agent needs far less."""

AGENT_FILE, POLICY_FILE, TRAINING_FILE = "agent.json", "policy.safetensors", "training.safetensors"
PREVIOUS_FILE, CURVE_FILE = "training.previous.safetensors", "cloning.json"

CURVES_FOLDER = "tensorboard"
"""Folder of the curves that TensorBoard shows, in that of the agent."""


@dataclass(frozen=True)
class AgentDescription:
    """The content of `agent.json`.

    Attributes:
        robots: names of the bodies that were driven.
        repeat: steps of the environment for which a decision holds.
        widths: of the observation, the hidden layers and the action.
        preset: the preset that was trained, as plain data.
        seed: of the training.
        steps: number of decisions so far.
        imitated: number of demonstrations that were imitated first.
        format: version of the files.
    """

    robots: tuple[str, ...]
    repeat: int
    widths: tuple[int, ...]
    preset: dict[str, Any]
    seed: int
    steps: int
    imitated: int = 0
    format: int = FORMAT_VERSION

    @property
    def is_untrained(self) -> bool:
        """Whether nothing was learned: the weights are those that were drawn by chance."""
        return not self.steps and not self.imitated

    def write(self, folder: Path) -> None:
        """Write it to a folder, in one move."""
        text = json.dumps(asdict(self), indent=1) + "\n"
        write_file(folder / AGENT_FILE, text.encode())

    @classmethod
    def read(cls, folder: Path) -> AgentDescription:
        """Read it from a folder.

        Raises:
            ValueError: not such a file; says why.
            OSError: it cannot be read.
        """
        path = folder / AGENT_FILE
        if not path.is_file():
            raise ValueError(f"{folder} holds no trained agent: there is no {AGENT_FILE} in it")
        content = read_bytes(path, MAX_FILE_SIZE)
        try:
            document = json.loads(content)
        except (ValueError, RecursionError) as error:
            raise ValueError(f"{path} is not JSON: {clipped(str(error))}") from None
        return cls(**_checked(path, document))


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
    save_tensors(folder / POLICY_FILE, policy.tensors())
    widths = (policy.weights[0].shape[1], *(len(bias) for bias in policy.biases))
    plain = preset.plain()
    AgentDescription(preset.robots, preset.repeat, widths, plain, seed, steps, imitated).write(
        folder
    )


def _checked(path: Path, document: Any) -> dict[str, Any]:
    """The fields of the document, or an error that names what is wrong."""
    found = document.get("format") if isinstance(document, dict) else None
    if found != FORMAT_VERSION:
        raise ValueError(
            f"{path} has format {found!r:.40}; this version reads format {FORMAT_VERSION}"
        )
    fields: dict[str, Any] = {}
    for name, kind in _FIELD_TYPES.items():
        value = document.get(name, _imitated_before(document) if name == "imitated" else None)
        if type(value) is not kind:
            raise ValueError(f"{path}: {name!r} must be of type {kind.__name__}, not {value!r:.40}")
        fields[name] = value
    widths = fields["widths"]
    if len(widths) < 2 or not all(type(w) is int and 0 < w <= 4096 for w in widths):
        raise ValueError(f"{path}: 'widths' must be two or more whole numbers from 1 to 4096")
    if fields["repeat"] < 1 or min(fields[name] for name in ("steps", "seed", "imitated")) < 0:
        raise ValueError(
            f"{path}: 'repeat' must be at least 1, 'steps', 'seed' and 'imitated' at least 0"
        )
    robots = fields["robots"]
    if not robots or not all(type(robot) is str for robot in robots):
        raise ValueError(f"{path}: 'robots' must be one or more names")
    return {**fields, "widths": tuple(widths), "robots": tuple(robots)}


_FIELD_TYPES: dict[str, type] = {
    "robots": list,
    "repeat": int,
    "widths": list,
    "preset": dict,
    "seed": int,
    "steps": int,
    "imitated": int,
}


def _imitated_before(document: dict[str, Any]) -> object:
    """The number of demonstrations in a file that does not say how many were imitated."""
    preset = document.get("preset")
    return preset.get("demonstrations", 0) if isinstance(preset, dict) else 0


def save_curve(folder: Path, losses: list[float]) -> None:
    """Write the mean loss of each pass of cloning, in one move."""
    text = json.dumps([round(loss, 5) for loss in losses]) + "\n"
    write_file(folder / CURVE_FILE, text.encode())


def save_checkpoint(folder: Path, tensors: Mapping[str, Array]) -> None:
    """Write the state from which training continues; the one before it is kept beside it."""
    content = _serialised(tensors)
    with replacing(folder / TRAINING_FILE) as part:
        part.write_bytes(content)
        with suppress(FileNotFoundError):
            os.replace(folder / TRAINING_FILE, folder / PREVIOUS_FILE)


def load_checkpoint(folder: Path) -> dict[str, Array]:
    """The newest state that can be read.

    Raises:
        ValueError: neither can.
        OSError: the newest one cannot be read.
    """
    try:
        return load_tensors(folder / TRAINING_FILE)
    except (ValueError, FileNotFoundError):
        if not (folder / PREVIOUS_FILE).exists():
            raise
        return load_tensors(folder / PREVIOUS_FILE)


def _serialised(tensors: Mapping[str, Array]) -> bytes:
    from safetensors.numpy import save

    return save({name: tensor.copy() for name, tensor in tensors.items()})


def save_tensors(path: Path, tensors: Mapping[str, Array]) -> None:
    """Write named tensors in one move."""
    write_file(path, _serialised(tensors))


def load_tensors(path: Path) -> dict[str, Array]:
    """The tensors of a safetensors file.

    Raises:
        ValueError: not such a file.
        OSError: it cannot be read.
        ImportError: safetensors is not installed.
    """
    try:
        from safetensors import SafetensorError
        from safetensors.numpy import load
    except ModuleNotFoundError:
        raise ImportError(
            'a trained agent needs safetensors: pip install "semnav-env[rl]"'
        ) from None
    try:
        return dict(load(read_bytes(path, MAX_FILE_SIZE)))
    except (SafetensorError, KeyError, ValueError) as error:
        raise ValueError(f"{path} is not a safetensors file: {error}") from None
