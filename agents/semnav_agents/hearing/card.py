"""The files of an agent that hears: a model card in JSON, and safetensors."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from semnav_agents.hearing.network import GroundingNetwork, NetworkShape
from semnav_agents.learning.files import load_tensors
from semnav_features.reading import read_bytes
from semnav_features.validation import clipped
from semnav_features.writing import write_file

CARD_FILE, NETWORK_FILE = "hearing.json", "grounding.safetensors"

CARD_FORMAT = 1
"""Version of the card; other versions are refused."""

MAX_CARD_SIZE = 2**20
"""Largest card that is read, bytes."""


@dataclass(frozen=True)
class ModelCard:
    """The content of `hearing.json`.

    Attributes:
        shape: of the network.
        preset: that was trained, as plain data.
        seed: of the training.
        curve: what was measured while training, one row for each epoch and each chunk of episodes.
        notes: what else is to be known: data, results, limits.
        format: version of the card.
    """

    shape: NetworkShape
    preset: dict[str, Any]
    seed: int
    curve: list[dict[str, Any]] = field(default_factory=list)
    notes: dict[str, Any] = field(default_factory=dict)
    format: int = CARD_FORMAT

    def write(self, folder: Path) -> None:
        """Write it to a folder, in one move."""
        document = asdict(self)
        rows = ",\n  ".join(json.dumps(row) for row in document.pop("curve"))
        text = json.dumps(document, indent=1)[:-2] + f',\n "curve": [\n  {rows}\n ]\n}}\n'
        write_file(folder / CARD_FILE, text)

    @classmethod
    def read(cls, folder: Path) -> ModelCard:
        """Read it from a folder.

        Raises:
            ValueError: not such a file; says why.
            OSError: it cannot be read.
        """
        path = folder / CARD_FILE
        try:
            document = json.loads(read_bytes(path, MAX_CARD_SIZE))
        except (ValueError, RecursionError) as error:
            raise ValueError(f"{path} is not JSON: {clipped(str(error))}") from None
        found = document.get("format") if isinstance(document, dict) else None
        if found != CARD_FORMAT:
            raise ValueError(
                f"{path} has format {found!r:.40}; this version reads format {CARD_FORMAT}"
            )
        for name, kind in _CARD_TYPES.items():
            if type(document.get(name)) is not kind:
                raise ValueError(
                    f"{path}: {name!r} must be of type {kind.__name__}, "
                    f"not {document.get(name)!r:.40}"
                )
        rest = {name: document[name] for name in _CARD_TYPES if name != "shape"}
        try:
            return cls(NetworkShape(**document["shape"]), **rest)
        except (TypeError, ValueError) as error:
            raise ValueError(f"{path}: shape: {error}") from None


_CARD_TYPES: dict[str, type] = {
    "shape": dict,
    "preset": dict,
    "seed": int,
    "curve": list,
    "notes": dict,
}


def load_network(folder: Path) -> GroundingNetwork:
    """The network of a folder.

    Raises:
        ValueError: there is none, it is damaged, or it does not fit this version.
        OSError: a file cannot be read.
        ImportError: safetensors is not installed.
    """
    card, path = ModelCard.read(folder), folder / NETWORK_FILE
    try:
        return GroundingNetwork(card.shape, load_tensors(path))
    except ValueError as error:
        raise ValueError(f"{path}: {error}; train it anew") from None
