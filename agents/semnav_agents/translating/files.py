"""The files of a translator: a card in JSON, and its weights as safetensors of half precision."""

from __future__ import annotations

import json
from dataclasses import asdict
from functools import cache
from pathlib import Path

import numpy as np

from semnav_agents.learning.files import load_tensors, save_tensors
from semnav_agents.learning.policy import check_tensors
from semnav_agents.translating.network import TranslatorNetwork, TranslatorShape
from semnav_features.writing import write_file

BUNDLED_FOLDER = Path(__file__).parents[1] / "pretrained" / "translator"

CARD_FILE, WEIGHTS_FILE = "translator.json", "translator.safetensors"


def save_translator(folder: Path, network: TranslatorNetwork, notes: dict[str, object]) -> None:
    """Write a network to a folder, with what is to be known about it."""
    card = {"shape": asdict(network.shape), **notes}
    write_file(folder / CARD_FILE, json.dumps(card, indent=1) + "\n")
    halves = {name: array.astype(np.float16) for name, array in network.tensors.items()}
    save_tensors(folder / WEIGHTS_FILE, halves)


@cache
def load_translator(folder: Path = BUNDLED_FOLDER) -> TranslatorNetwork:
    """The network of a folder; read once.

    Raises:
        ValueError: the files are not those of a translator, or not of this version.
        OSError: they cannot be read.
    """
    try:
        shape = TranslatorShape(**json.loads((folder / CARD_FILE).read_text("utf-8"))["shape"])
    except (ValueError, KeyError, TypeError) as error:
        raise ValueError(f"{folder / CARD_FILE} is no card of a translator: {error}") from None
    tensors = {
        name: array.astype(np.float32)
        for name, array in load_tensors(folder / WEIGHTS_FILE).items()
    }
    check_tensors(tensors, shape.tensors())
    return TranslatorNetwork(shape, tensors)
