"""The grounding network as it is trained; the same as `network.GroundingNetwork`, in torch."""

from __future__ import annotations

import math
from typing import NamedTuple

import torch
from torch import Tensor, nn

from semnav_agents.hearing.network import (
    KINDS,
    MASKED,
    STILL,
    NetworkShape,
)
from semnav_agents.networks.torch_network import TorchNetwork


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


class TorchGrounding(TorchNetwork):
    """The network, with the parameters of `NetworkShape.tensors`."""

    def __init__(self, shape: NetworkShape, seed: int) -> None:
        super().__init__(shape.tensors(), _uniform, seed)
        self.shape = shape

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
        told = self.perceptron("command", command)
        embedded = self.perceptron("embed", elements) + told[:, None, d:]
        x = torch.cat((told[:, None, :d], embedded), dim=1)
        everyone = torch.cat((torch.ones_like(mask[:, :1]), mask), dim=1)
        for k in range(self.shape.layers):
            x = x + self._attend(k, self.norm(f"{k}.norm.0", x), everyone)
            x = x + self.perceptron(f"{k}.feed", self.norm(f"{k}.norm.1", x))
        x = self.norm("norm", x)
        proposals = self.perceptron("offset", x[:, 1:])
        scores = proposals[..., 0].masked_fill(~mask, MASKED)
        places, headings = _placed(proposals[..., 1:], bases)
        outputs = self.perceptron("goal", x[:, 0])
        fit = _fit(scores, places, headings, outputs, robot, elements[:, 0, STILL])
        advances = self.perceptron("advance", torch.cat((x[:, 0], fit), dim=1))
        return Grounded(scores.log_softmax(dim=1), places, headings, outputs, advances)

    def _attend(self, k: int, x: Tensor, mask: Tensor) -> Tensor:
        b, n, d = x.shape
        parts = self.linear(f"{k}.attend", x).view(b, n, 3, self.shape.heads, -1)
        queries, keys, values = parts.permute(2, 0, 3, 1, 4)
        mixed = nn.functional.scaled_dot_product_attention(
            queries, keys, values, attn_mask=mask[:, None, None, :]
        )
        return self.linear(f"{k}.merge", mixed.transpose(1, 2).reshape(b, n, d))


def _uniform(name: str, shape: tuple[int, ...], generator: torch.Generator) -> Tensor:
    """Small weights, uniform."""
    bound = 1.0 / math.sqrt(shape[1])
    return torch.empty(shape).uniform_(-bound, bound, generator=generator)


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
