"""Named tensors in safetensors files, which run no code when they are read."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from safetensors import SafetensorError
from safetensors.numpy import load, save

from semnav_env.networks.layers import Array
from semnav_features.reading import read_bytes
from semnav_features.writing import write_file

Tensors = dict[str, NDArray[Any]]

WEIGHTS_FILE = "weights.safetensors"
"""File of the weights in the folder of a network."""

MAX_FILE_SIZE = 64 * 2**20
"""Largest file that is read, bytes; a small network needs far less."""


def save_weights(folder: Path, tensors: Mapping[str, NDArray[Any]]) -> None:
    """Write the weights of a network to its folder, in one move."""
    save_tensors(folder / WEIGHTS_FILE, tensors)


def load_weights(folder: Path, shapes: Mapping[str, tuple[int, ...]]) -> dict[str, Array]:
    """The weights of the network in a folder; half precision is widened, which is exact.

    Args:
        folder: of the network.
        shapes: of its tensors by name.

    Raises:
        ValueError: they are damaged, or not those of that network; names the file and why.
        OSError: they cannot be read.
    """
    path = folder / WEIGHTS_FILE
    tensors = {
        name: tensor.astype(np.float32) if tensor.dtype == np.float16 else tensor
        for name, tensor in load_tensors(path).items()
    }
    try:
        check_tensors(tensors, shapes)
    except ValueError as error:
        raise ValueError(f"{path}: {error}; train it anew") from None
    return tensors


def serialised(tensors: Mapping[str, NDArray[Any]]) -> bytes:
    """Named tensors as the content of a file."""
    return save({name: tensor.copy() for name, tensor in tensors.items()})


def save_tensors(path: Path, tensors: Mapping[str, NDArray[Any]]) -> None:
    """Write named tensors in one move."""
    write_file(path, serialised(tensors))


def load_tensors(path: Path) -> Tensors:
    """The tensors of a safetensors file.

    Raises:
        ValueError: not such a file.
        OSError: it cannot be read.
    """
    try:
        return dict(load(read_bytes(path, MAX_FILE_SIZE)))
    except (SafetensorError, KeyError, ValueError) as error:
        raise ValueError(f"{path} is not a safetensors file: {error}") from None


def pop_count(tensors: Tensors, name: str) -> int:
    """Remove the tensor of a count from named tensors, and return the count.

    Raises:
        ValueError: it is missing, or no count.
    """
    tensor = tensors.pop(name, None)
    if tensor is None or tensor.shape != () or tensor.dtype != np.int64 or tensor < 0:
        raise ValueError(f"tensor {name!r} must be one whole number of 64 bits, at least 0")
    return int(tensor)


def check_tensors(
    tensors: Mapping[str, NDArray[Any]], shapes: Mapping[str, tuple[int, ...]]
) -> None:
    """Raise `ValueError` unless there are just these float32 tensors, all of them finite."""
    wrong = sorted(tensors.keys() ^ shapes.keys())
    if wrong:
        raise ValueError(f"tensor {wrong[0]!r} is {'missing' if wrong[0] in shapes else 'unknown'}")
    for name, shape in shapes.items():
        tensor = tensors[name]
        if tensor.shape != shape or tensor.dtype != np.float32:
            raise ValueError(
                f"tensor {name!r} is {tensor.dtype} of shape {tensor.shape}; "
                f"it must be float32 of shape {shape}"
            )
        if not np.isfinite(tensor).all():
            raise ValueError(f"tensor {name!r} is not finite")
