"""Layers of the learned networks in NumPy alone, with weights by name.

Each layer that has weights has its shapes beside it: a network declares its tensors with those, and
applies them by the same names.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float32]
Shapes = dict[str, tuple[int, ...]]

MOST_PRODUCTS = 1 << 18
"""The most products of a matrix multiplication that OpenBLAS does in the calling thread. It parts
larger ones among threads, which for such small matrices wait longer for a busy core than work."""

EPSILON = 1e-5
"""Keeps the normalisation of a layer finite."""


def linear_shapes(name: str, inputs: int, outputs: int) -> Shapes:
    """Shapes of the tensors of `linear`."""
    return {f"{name}.weight": (outputs, inputs), f"{name}.bias": (outputs,)}


def linear(tensors: Mapping[str, Array], name: str, x: Array) -> Array:
    """A linear layer: `NAME.weight`, shape (outputs, inputs), and `NAME.bias`."""
    result: Array = _product(x, tensors[f"{name}.weight"].T) + tensors[f"{name}.bias"]
    return result


def _product(x: Array, weight: Array) -> Array:
    """`x @ weight`, so many rows at a time that no other thread is asked."""
    if x.ndim == 1 or x.shape[0] * weight.size <= MOST_PRODUCTS:
        return x @ weight
    rows = max(1, MOST_PRODUCTS // weight.size)
    return np.concatenate([x[k : k + rows] @ weight for k in range(0, len(x), rows)])


def perceptron_shapes(name: str, inputs: int, hidden: int, outputs: int) -> Shapes:
    """Shapes of the tensors of `perceptron`."""
    first, second = (f"{name}.{k}" for k in (0, 1))
    return linear_shapes(first, inputs, hidden) | linear_shapes(second, hidden, outputs)


def perceptron(tensors: Mapping[str, Array], name: str, x: Array) -> Array:
    """Two linear layers, `NAME.0` and `NAME.1`, with a rectifier between them."""
    return linear(tensors, f"{name}.1", np.maximum(linear(tensors, f"{name}.0", x), 0.0))


def norm_shapes(name: str, width: int) -> Shapes:
    """Shapes of the tensors of `layer_norm`."""
    return {f"{name}.weight": (width,), f"{name}.bias": (width,)}


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


def attention(queries: Array, keys: Array, values: Array) -> Array:
    """Scaled dot-product attention of several heads (Vaswani et al. 2017), shape (n, h * d).

    Args:
        queries: shape (n, h, d).
        keys: shape (m, h, d).
        values: shape (m, h, d).
    """
    queries, keys, values = (each.transpose(1, 0, 2) for each in (queries, keys, values))
    scores = queries @ keys.transpose(0, 2, 1) / math.sqrt(queries.shape[-1])
    mixed = softmax(scores) @ values
    return mixed.transpose(1, 0, 2).reshape(mixed.shape[1], -1)
