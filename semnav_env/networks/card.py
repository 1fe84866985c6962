"""The card of a network as JSON: its settings, its training, and notes on its data and results.

A folder holds one network: its `card.json`, and its weights in `weights.safetensors` beside it.
"""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any, Generic, TypeVar

from semnav_features.checked_fields import Count, check_fields
from semnav_features.reading import read_bytes
from semnav_features.validation import clipped
from semnav_features.writing import write_file

CARD_FILE = "card.json"

CARD_FORMAT = 3
"""Version of the card; other versions are refused."""

MAX_CARD_SIZE = 2**20
"""Largest card that is read, bytes."""


@dataclass(frozen=True)
class NetworkSettings:
    """The settings that an agent needs to run one kind of network."""

    KIND = ""
    """What the cards of this kind of network call it."""


@dataclass(frozen=True)
class TransformerSettings(NetworkSettings):
    """Sizes of a transformer.

    Attributes:
        width: size of the encoding of an element or a word.
        heads: of the attention.
        layers: of the encoder, and of a decoder.
        hidden: width of the perceptrons between.
    """

    width: Count = 64
    heads: Count = 4
    layers: Count = 2
    hidden: Count = 128

    def __post_init__(self) -> None:
        check_fields(self)
        if self.width % self.heads:
            raise ValueError(f"width is {self.width}; it must be a multiple of heads, {self.heads}")


Settings = TypeVar("Settings", bound=NetworkSettings)


@dataclass(frozen=True)
class Card(Generic[Settings]):
    """The content of `card.json`.

    Attributes:
        settings: of the network.
        preset: that was trained, as plain data.
        seed: of the training.
        notes: further facts: data, results, limits.
        curve: measures of the training, one row for each epoch and each chunk of episodes.
    """

    settings: Settings
    preset: dict[str, Any]
    seed: int
    notes: dict[str, Any] = field(default_factory=dict)
    curve: list[dict[str, Any]] = field(default_factory=list)

    def write(self, folder: Path) -> None:
        """Write it to a folder, in one move; each row of the curve is a line."""
        document = {"format": CARD_FORMAT, "network": self.settings.KIND, **asdict(self)}
        rows = ",\n  ".join(json.dumps(row) for row in document.pop("curve"))
        curve = f"[\n  {rows}\n ]" if rows else "[]"
        text = json.dumps(document, indent=1)[:-2] + f',\n "curve": {curve}\n}}\n'
        write_file(folder / CARD_FILE, text)

    @classmethod
    def read(cls, folder: Path, kind: type[Settings]) -> Card[Settings]:
        """Read it from a folder.

        Args:
            folder: of the network.
            kind: its settings.

        Raises:
            ValueError: there is none, it is damaged, or it is that of another kind of network.
            OSError: it cannot be read.
        """
        path, document = folder / CARD_FILE, card_fields(folder)
        found = document["network"]
        if found != kind.KIND:
            raise ValueError(f"{path} is the card of a {found!r:.40}, not of a {kind.KIND!r}")
        try:
            settings = kind(**document["settings"])
        except (TypeError, ValueError) as error:
            raise ValueError(f"{path}: settings: {clipped(str(error))}") from None
        return cls(settings, *(document[name] for name in ("preset", "seed", "notes", "curve")))


_FIELD_TYPES: dict[str, type] = {
    "network": str,
    "settings": dict,
    "preset": dict,
    "seed": int,
    "notes": dict,
    "curve": list,
}


def card_fields(folder: Path) -> dict[str, Any]:
    """The fields of the card in a folder, for any kind of network; checks the types.

    Raises:
        ValueError: there is none, or it is damaged.
        OSError: it cannot be read.
    """
    path = folder / CARD_FILE
    if not path.is_file():
        raise ValueError(f"{folder} holds no trained network: there is no {CARD_FILE} in it")
    try:
        document = json.loads(read_bytes(path, MAX_CARD_SIZE))
    except (ValueError, RecursionError) as error:
        raise ValueError(f"{path} is not JSON: {clipped(str(error))}") from None
    found = document.get("format") if isinstance(document, dict) else None
    if found != CARD_FORMAT:
        raise ValueError(
            f"{path} has format {found!r:.40}; this version reads format {CARD_FORMAT}"
        )
    for name, kind in _FIELD_TYPES.items():
        value = document.get(name)
        if type(value) is not kind:
            raise ValueError(f"{path}: {name!r} must be of type {kind.__name__}, not {value!r:.40}")
    if document["seed"] < 0:
        raise ValueError(f"{path}: 'seed' must be at least 0, not {document['seed']}")
    return dict(document)
