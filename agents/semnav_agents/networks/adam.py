"""The moments of Adam for each parameter, as named tensors PREFIX + KEY + "." + MOMENT."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, TypeVar

import numpy as np

from semnav_env.networks.layers import Shapes
from semnav_env.networks.weights import Tensors

ADAM_MOMENTS = ("step", "exp_avg", "exp_avg_sq")
"""The number of steps, and the means of the gradient and of its square (Kingma and Ba 2015)."""

Key = TypeVar("Key", int, str)
"""The number or the name of a parameter."""

Value = TypeVar("Value")
"""A tensor of NumPy or torch."""


def adam_shapes(prefix: str, parameters: Mapping[Key, tuple[int, ...]]) -> Shapes:
    """The shapes of the tensors of `adam_tensors`.

    Args:
        prefix: of the names.
        parameters: their shapes.
    """
    return {
        f"{prefix}{key}.{name}": () if name == "step" else shape
        for key, shape in parameters.items()
        for name in ADAM_MOMENTS
    }


def adam_tensors(prefix: str, moments: Mapping[Key, Mapping[str, Any]]) -> Tensors:
    """The moments of parameters as named tensors."""
    return {
        f"{prefix}{key}.{name}": np.asarray(each[name], np.float32)
        for key, each in moments.items()
        for name in ADAM_MOMENTS
    }


def adam_moments(
    prefix: str, tensors: Mapping[str, Value], keys: Iterable[Key]
) -> dict[Key, dict[str, Value]]:
    """The opposite of `adam_tensors`."""
    return {key: {name: tensors[f"{prefix}{key}.{name}"] for name in ADAM_MOMENTS} for key in keys}
