"""The grounding network as it is trained; the same as `network.GroundingNetwork`, in torch."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor, nn

from semnav_agents.hearing.network import (
    KINDS,
    MASKED,
    STILL,
    NetworkShape,
)
from semnav_agents.networks.layers import EPSILON


class Grounded(NamedTuple):
    """What the network says of a batch of b samples with n elements.

    Attributes:
        log_shares: of the elements in the mixture, shape (b, n).
        places: proposed by each, shape (b, n, 2).
        headings: the same, unit vectors, shape (b, n, 2).
        outputs: about the goal as a whole, shape (b, 6).
        advances: logits, shape (b, 3).
    """

    log_shares: Tensor
    places: Tensor
    headings: Tensor
    outputs: Tensor
    advances: Tensor


class TorchGrounding(nn.Module):
    """The network; its parameters have the names of `NetworkShape.tensors`, with "_" for "."."""

    def __init__(self, shape: NetworkShape, seed: int) -> None:
        super().__init__()
        self.shape = shape
        generator = torch.Generator().manual_seed(seed)
        for name, size in shape.tensors().items():
            self.register_parameter(_flat(name), nn.Parameter(_drawn(name, size, generator)))

    def named(self) -> dict[str, Tensor]:
        """The parameters by the names of the files."""
        return {name: getattr(self, _flat(name)) for name in self.shape.tensors()}

    def arrays(self) -> dict[str, NDArray[np.float32]]:
        """Copies of the parameters as arrays, as `network.GroundingNetwork` takes them."""
        return {name: tensor.detach().numpy().copy() for name, tensor in self.named().items()}

    def forward(
        self, elements: Tensor, mask: Tensor, command: Tensor, bases: Tensor, robot: Tensor
    ) -> Grounded:
        """Ground a batch.

        Args:
            elements: shape (b, n, ELEMENT_SIZE).
            mask: which count, shape (b, n).
            command: shape (b, COMMAND_SIZE).
            bases: shape (b, n, 3).
            robot: its pose, shape (b, 3).
        """
        d = self.shape.width
        told = self._perceptron("command", command)
        embedded = self._perceptron("embed", elements) + told[:, None, d:]
        x = torch.cat((told[:, None, :d], embedded), dim=1)
        everyone = torch.cat((torch.ones_like(mask[:, :1]), mask), dim=1)
        for k in range(self.shape.layers):
            x = x + self._attend(k, self._norm(f"{k}.norm.0", x), everyone)
            x = x + self._perceptron(f"{k}.feed", self._norm(f"{k}.norm.1", x))
        x = self._norm("norm", x)
        proposals = self._perceptron("offset", x[:, 1:])
        scores = proposals[..., 0].masked_fill(~mask, MASKED)
        places, headings = _placed(proposals[..., 1:], bases)
        outputs = self._perceptron("goal", x[:, 0])
        fit = _fit(scores, places, headings, outputs, robot, elements[:, 0, STILL])
        advances = self._perceptron("advance", torch.cat((x[:, 0], fit), dim=1))
        return Grounded(scores.log_softmax(dim=1), places, headings, outputs, advances)

    def _attend(self, k: int, x: Tensor, mask: Tensor) -> Tensor:
        b, n, d = x.shape
        parts = self._linear(f"{k}.attend", x).view(b, n, 3, self.shape.heads, -1)
        queries, keys, values = parts.permute(2, 0, 3, 1, 4)
        mixed = nn.functional.scaled_dot_product_attention(
            queries, keys, values, attn_mask=mask[:, None, None, :]
        )
        return self._linear(f"{k}.merge", mixed.transpose(1, 2).reshape(b, n, d))

    def _perceptron(self, name: str, x: Tensor) -> Tensor:
        return self._linear(f"{name}.1", self._linear(f"{name}.0", x).relu())

    def _linear(self, name: str, x: Tensor) -> Tensor:
        weight, bias = getattr(self, _flat(f"{name}.weight")), getattr(self, _flat(f"{name}.bias"))
        return nn.functional.linear(x, weight, bias)

    def _norm(self, name: str, x: Tensor) -> Tensor:
        weight, bias = getattr(self, _flat(f"{name}.weight")), getattr(self, _flat(f"{name}.bias"))
        return nn.functional.layer_norm(x, (self.shape.width,), weight, bias, EPSILON)


def _flat(name: str) -> str:
    return "p_" + name.replace(".", "_")


def _drawn(name: str, size: tuple[int, ...], generator: torch.Generator) -> Tensor:
    """First values: small uniform weights, no biases, norms that change nothing."""
    if name.endswith("bias"):
        return torch.zeros(size)
    if len(size) == 1:
        return torch.ones(size)
    bound = 1.0 / math.sqrt(size[1])
    return torch.empty(size).uniform_(-bound, bound, generator=generator)


def _placed(offsets: Tensor, bases: Tensor) -> tuple[Tensor, Tensor]:
    """Proposals seen from the elements, in the frame of the description."""
    c, s = bases[..., 2].cos(), bases[..., 2].sin()
    ahead, aside = offsets[..., 0], offsets[..., 1]
    places = torch.stack(
        (bases[..., 0] + c * ahead - s * aside, bases[..., 1] + s * ahead + c * aside), dim=-1
    )
    cosine, sine = 1.0 + offsets[..., 2], offsets[..., 3]
    turned = torch.stack((c * cosine - s * sine, s * cosine + c * sine), dim=-1)
    return places, nn.functional.normalize(turned, dim=-1, eps=1e-6)


def _fit(
    scores: Tensor, places: Tensor, headings: Tensor, outputs: Tensor, robot: Tensor, still: Tensor
) -> Tensor:
    """As `network.fit_of`, of the likeliest proposal; no gradient flows into that."""
    best = scores.argmax(dim=1)
    rows = torch.arange(len(best))
    place, heading = places[rows, best].detach(), headings[rows, best].detach()
    c, s = heading[:, 0], heading[:, 1]
    dx, dy = (robot[:, :2] - place).unbind(dim=1)
    x, y = c * dx + s * dy, c * dy - s * dx
    turned = robot[:, 2] - torch.atan2(s, c)
    numbers = (
        *(x.clamp(-3.0, 3.0), y.clamp(-3.0, 3.0), (x / 0.3).tanh(), (y / 0.3).tanh()),
        *(torch.hypot(x, y).clamp(max=3.0), turned.cos(), turned.sin()),
        *(torch.atan2(turned.sin(), turned.cos()).abs(), still),
    )
    kinds = outputs[:, :KINDS].softmax(dim=1).detach()
    return torch.cat((torch.stack(numbers, dim=1), kinds), dim=1)
