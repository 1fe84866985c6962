"""Layers of the learned networks as they run: NumPy alone, weights by name."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float32]

EPSILON = 1e-5
"""Keeps the normalisation of a layer finite."""


def linear(tensors: Mapping[str, Array], name: str, x: Array) -> Array:
    """A linear layer: `NAME.weight`, shape (outputs, inputs), and `NAME.bias`."""
    result: Array = x @ tensors[f"{name}.weight"].T + tensors[f"{name}.bias"]
    return result


def perceptron(tensors: Mapping[str, Array], name: str, x: Array) -> Array:
    """Two linear layers, `NAME.0` and `NAME.1`, with a rectifier between them."""
    return linear(tensors, f"{name}.1", np.maximum(linear(tensors, f"{name}.0", x), 0.0))


def layer_norm(tensors: Mapping[str, Array], name: str, x: Array) -> Array:
    """Each row with mean 0 and variance 1, scaled and shifted (Ba et al. 2016)."""
    centred = x - x.mean(axis=-1, keepdims=True)
    scale = np.sqrt((centred**2).mean(axis=-1, keepdims=True) + EPSILON)
    result: Array = centred / scale * tensors[f"{name}.weight"]
    return result + tensors[f"{name}.bias"]


def softmax(scores: Array) -> Array:
    """Probabilities along the last axis."""
    raised = np.exp(scores - scores.max(axis=-1, keepdims=True))
    result: Array = raised / raised.sum(axis=-1, keepdims=True)
    return result
