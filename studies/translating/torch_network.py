"""The translator's network as it is trained; the same as `TranslatorNetwork`, in torch."""

from __future__ import annotations

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor, nn
from torch.nn import functional

from semnav_agents.networks.layers import EPSILON
from semnav_agents.translating.network import TranslatorShape, positions

LONGEST_TEXT = 320
"""The most words of a text, and symbols of a command, that have a position."""


class TorchTranslator(nn.Module):
    """The network; its parameters have the names of `TranslatorShape.tensors`, "_" for "."."""

    def __init__(self, shape: TranslatorShape, seed: int, dropout: float) -> None:
        super().__init__()
        self.shape, self.dropout = shape, dropout
        generator = torch.Generator().manual_seed(seed)
        for name, size in shape.tensors().items():
            self.register_parameter(_flat(name), nn.Parameter(_drawn(name, size, generator)))
        self.places = torch.from_numpy(positions(LONGEST_TEXT, shape.width))

    def arrays(self) -> dict[str, NDArray[np.float32]]:
        """Copies of the parameters as arrays, as `TranslatorNetwork` takes them."""
        return {
            name: getattr(self, _flat(name)).detach().numpy().copy()
            for name in self.shape.tensors()
        }

    def forward(
        self,
        grams: Tensor,
        shares: Tensor,
        words: Tensor,
        seen: Tensor,
        marks: Tensor,
        mask: Tensor,
        said: Tensor,
    ) -> Tensor:
        """Scores of the next symbol behind each symbol, shape (b, s, symbols).

        Args:
            grams: rows of the table of each of u different words, shape (u, g).
            shares: weight of each of them, 0 for none, shape (u, g).
            words: which of the u words, shape (b, n).
            seen: 1 for words that are seen, 0 for those of which only the mark is, shape (b, n).
            marks: shape (b, n).
            mask: which words there are, shape (b, n).
            said: symbols so far, shape (b, s).
        """
        spelt = functional.embedding_bag(
            grams, self._of("grams"), per_sample_weights=shares, mode="sum"
        )
        x = functional.embedding(words, spelt) * seen[..., None]
        x = self._drop(x + self._of("marks")[marks] + self.places[: words.shape[1]])
        for k in range(self.shape.layers):
            x = x + self._attend(f"encode.{k}.self", x, None, mask)
            x = x + self._feed(f"encode.{k}.feed", x)
        encoded = self._norm("encoded", x)
        y = self._drop(self._of("symbols")[said] + self.places[: said.shape[1]])
        for k in range(self.shape.layers):
            y = y + self._attend(f"decode.{k}.self", y, None, None)
            y = y + self._attend(f"decode.{k}.cross", y, encoded, mask)
            y = y + self._feed(f"decode.{k}.feed", y)
        return self._linear("say", self._norm("decoded", y))

    def _attend(self, name: str, x: Tensor, other: Tensor | None, mask: Tensor | None) -> Tensor:
        heads = self.shape.heads
        plain = self._norm(f"{name}.norm", x)
        memory = plain if other is None else other
        b, m, d = memory.shape
        query = self._linear(f"{name}.query", plain).view(b, -1, heads, d // heads)
        both = self._linear(f"{name}.memory", memory).view(b, m, 2, heads, d // heads)
        mixed = functional.scaled_dot_product_attention(
            query.transpose(1, 2),
            both[:, :, 0].transpose(1, 2),
            both[:, :, 1].transpose(1, 2),
            attn_mask=None if mask is None else mask[:, None, None, :],
            is_causal=mask is None,
        )
        merged = self._linear(f"{name}.merge", mixed.transpose(1, 2).reshape(x.shape))
        return self._drop(merged)

    def _feed(self, name: str, x: Tensor) -> Tensor:
        inner = self._linear(f"{name}.0", self._norm(f"{name}.norm", x)).relu()
        return self._drop(self._linear(f"{name}.1", inner))

    def _linear(self, name: str, x: Tensor) -> Tensor:
        return functional.linear(x, self._of(f"{name}.weight"), self._of(f"{name}.bias"))

    def _norm(self, name: str, x: Tensor) -> Tensor:
        weight, bias = self._of(f"{name}.weight"), self._of(f"{name}.bias")
        return functional.layer_norm(x, (self.shape.width,), weight, bias, EPSILON)

    def _drop(self, x: Tensor) -> Tensor:
        return functional.dropout(x, self.dropout, self.training)

    def _of(self, name: str) -> Tensor:
        found: Tensor = getattr(self, _flat(name))
        return found


def _flat(name: str) -> str:
    return "p_" + name.replace(".", "_")


def _drawn(name: str, size: tuple[int, ...], generator: torch.Generator) -> Tensor:
    """First values: small weights, no biases, norms that change nothing."""
    if name.endswith("bias"):
        return torch.zeros(size)
    if len(size) == 1:
        return torch.ones(size)
    scale = 1.0 if name in ("grams", "marks", "symbols") else size[1] ** -0.5
    return torch.empty(size).normal_(0.0, scale, generator=generator)
