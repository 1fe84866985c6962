"""How a trained agent lies on disk: JSON and safetensors, nothing that runs code when read.

A folder holds `agent.json` (what was trained), `policy.safetensors` (what the agent runs) and
`training.safetensors` (what training goes on from). Each file is whole by itself and is replaced
in one move, so an interruption at any moment leaves a folder that works.
"""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from numpy.typing import NDArray

Array = NDArray[Any]

FORMAT = 1
"""Of the folder; other numbers are refused."""

LARGEST = 64 * 2**20
"""No file of a small agent is larger, bytes."""

AGENT, POLICY, TRAINING = "agent.json", "policy.safetensors", "training.safetensors"


@dataclass(frozen=True)
class Description:
    """What `agent.json` says.

    Attributes:
        robot: name of the body that was driven.
        repeat: steps for which a decision holds.
        widths: of the observation, the hidden layers and the action.
        preset: that was trained, as plain data.
        seed: of the training.
        steps: decisions trained for so far.
        format: version of the folder.
    """

    robot: str
    repeat: int
    widths: tuple[int, ...]
    preset: dict[str, Any]
    seed: int
    steps: int
    format: int = FORMAT

    def write(self, folder: Path) -> None:
        """Put it in its place."""
        text = json.dumps(asdict(self), indent=1) + "\n"
        replace_file(folder / AGENT, text.encode())

    @classmethod
    def read(cls, folder: Path) -> Description:
        """What lies there.

        Raises:
            ValueError: not such a file; says why.
            OSError: it cannot be read.
        """
        path = folder / AGENT
        if not path.is_file():
            raise ValueError(f"{folder} holds no trained agent: there is no {AGENT} in it")
        try:
            document = json.loads(_read(path))
        except (UnicodeDecodeError, json.JSONDecodeError, RecursionError) as error:
            raise ValueError(f"{path} is not JSON: {error}") from None
        return cls(**_checked(path, document))


def _checked(path: Path, document: Any) -> dict[str, Any]:
    """The fields of a description."""
    found = document.get("format") if isinstance(document, dict) else None
    if found != FORMAT:
        raise ValueError(f"{path} has format {found!r:.40}; this version reads format {FORMAT}")
    fields: dict[str, Any] = {}
    for name, kind in _KINDS.items():
        value = document.get(name)
        if type(value) is not kind:
            raise ValueError(f"{path}: {name!r} must be of type {kind.__name__}, not {value!r:.40}")
        fields[name] = value
    widths = fields["widths"]
    if len(widths) < 2 or not all(type(w) is int and 0 < w <= 4096 for w in widths):
        raise ValueError(f"{path}: 'widths' must be two or more whole numbers from 1 to 4096")
    if fields["repeat"] < 1 or fields["steps"] < 0 or fields["seed"] < 0:
        raise ValueError(f"{path}: 'repeat' must be at least 1, 'steps' and 'seed' at least 0")
    return {**fields, "widths": tuple(widths)}


_KINDS: dict[str, type] = {
    "robot": str,
    "repeat": int,
    "widths": list,
    "preset": dict,
    "seed": int,
    "steps": int,
}


def save_tensors(path: Path, tensors: Mapping[str, Array]) -> None:
    """Write named tensors in one move."""
    from safetensors.numpy import save

    replace_file(path, save({name: tensor.copy() for name, tensor in tensors.items()}))


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
        return dict(load(_read(path)))
    except (SafetensorError, KeyError, ValueError) as error:
        raise ValueError(f"{path} is not a safetensors file: {error}") from None


def _read(path: Path) -> bytes:
    if path.stat().st_size > LARGEST:
        raise ValueError(f"{path} is larger than {LARGEST >> 20} MiB; no trained agent is")
    return path.read_bytes()


def replace_file(path: Path, data: bytes) -> None:
    """Write a file so that there is the old one or the new one, never half of it."""
    part = path.with_name(path.name + ".part")
    with open(part, "wb") as file:
        file.write(data)
        file.flush()
        os.fsync(file.fileno())
    os.replace(part, path)
