"""The policy that a trained agent runs: a small network in NumPy."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float32]


@dataclass(frozen=True, eq=False)
class Policy:
    """A perceptron with tanh between its layers; the mean of the policy that was trained.

    Attributes:
        weights: of each layer, shape (outputs, inputs).
        biases: of each layer, shape (outputs,).
    """

    weights: tuple[Array, ...]
    biases: tuple[Array, ...]

    def act(self, values: Array) -> Array:
        """The action for a compact observation, each part in [-1, 1]."""
        for weight, bias in zip(self.weights[:-1], self.biases[:-1], strict=True):
            values = np.tanh(weight @ values + bias)
        action: Array = np.clip(self.weights[-1] @ values + self.biases[-1], -1.0, 1.0)
        return action

    def tensors(self) -> dict[str, Array]:
        """The layers by name: "0.weight", "0.bias", "1.weight" and so on."""
        named: dict[str, Array] = {}
        for i, (weight, bias) in enumerate(zip(self.weights, self.biases, strict=True)):
            named |= {f"{i}.weight": weight, f"{i}.bias": bias}
        return named

    @classmethod
    def from_tensors(cls, tensors: Mapping[str, Array], widths: tuple[int, ...]) -> Policy:
        """The opposite of `tensors`.

        Args:
            tensors: by name.
            widths: of the observation, the hidden layers and the action.

        Raises:
            ValueError: a tensor is missing, too many, of another shape or type, or not finite.
        """
        shapes: dict[str, tuple[int, ...]] = {}
        for i, (inputs, outputs) in enumerate(pairwise(widths)):
            shapes |= {f"{i}.weight": (outputs, inputs), f"{i}.bias": (outputs,)}
        check_tensors(tensors, shapes)
        layers = range(len(widths) - 1)
        return cls(
            tuple(tensors[f"{i}.weight"] for i in layers),
            tuple(tensors[f"{i}.bias"] for i in layers),
        )


def check_tensors(tensors: Mapping[str, Array], shapes: Mapping[str, tuple[int, ...]]) -> None:
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
