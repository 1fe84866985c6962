"""Networks for training, in torch: the layers, and parameters by the names of the files."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor, nn
from torch.nn import functional

from semnav_env.networks.layers import EPSILON, Shapes

Draw = Callable[[str, tuple[int, ...], torch.Generator], Tensor]
"""Draws the first values of a matrix, by its name and shape."""


class TorchNetwork(nn.Module):
    """A network with named parameters; biases start at 0, and norms start as the identity.

    Args:
        shapes: of the parameters by name; they have these names with "_" for ".".
        draw: the first values of the matrices.
        seed: of what is drawn.
    """

    def __init__(self, shapes: Shapes, draw: Draw, seed: int) -> None:
        super().__init__()
        self._names = tuple(shapes)
        generator = torch.Generator().manual_seed(seed)
        for name, shape in shapes.items():
            if name.endswith("bias"):
                first = torch.zeros(shape)
            else:
                first = draw(name, shape, generator) if len(shape) > 1 else torch.ones(shape)
            self.register_parameter(_flat(name), nn.Parameter(first))

    def named(self) -> dict[str, Tensor]:
        """The parameters by the names of the files."""
        return {name: self.of(name) for name in self._names}

    def arrays(self) -> dict[str, NDArray[np.float32]]:
        """Copies of the parameters as arrays, as the network in NumPy takes them."""
        return {name: tensor.detach().numpy().copy() for name, tensor in self.named().items()}

    def load(self, arrays: Mapping[str, NDArray[Any]]) -> None:
        """Take the values of a result of `arrays`."""
        with torch.no_grad():
            for name, parameter in self.named().items():
                parameter.copy_(torch.from_numpy(arrays[name].copy()))

    def of(self, name: str) -> Tensor:
        """The parameter of a name."""
        found: Tensor = getattr(self, _flat(name))
        return found

    def linear(self, name: str, x: Tensor) -> Tensor:
        """As `layers.linear`."""
        return functional.linear(x, self.of(f"{name}.weight"), self.of(f"{name}.bias"))

    def perceptron(self, name: str, x: Tensor) -> Tensor:
        """As `layers.perceptron`."""
        return self.linear(f"{name}.1", self.linear(f"{name}.0", x).relu())

    def norm(self, name: str, x: Tensor) -> Tensor:
        """As `layers.layer_norm`."""
        weight, bias = self.of(f"{name}.weight"), self.of(f"{name}.bias")
        return functional.layer_norm(x, tuple(weight.shape), weight, bias, EPSILON)


def _flat(name: str) -> str:
    return "p_" + name.replace(".", "_")
