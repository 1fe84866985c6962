"""The translator's network as it is trained; the same as `TranslatorNetwork`, in torch."""

from __future__ import annotations

import torch
from torch import Tensor
from torch.nn import functional

from semnav_agents.networks.torch_network import TorchNetwork
from semnav_env.language.translating.network import TranslatorShape, positions
from studies.translating.arrays import Bags, TextBatch

LONGEST_TEXT = 320
"""The most words of a text, and symbols of a command, that have a position."""


class TorchTranslator(TorchNetwork):
    """The network, with the parameters of `TranslatorShape.tensors`."""

    places: Tensor

    def __init__(self, shape: TranslatorShape, seed: int, dropout: float) -> None:
        super().__init__(shape.tensors(), _normal, seed)
        self.shape, self.dropout = shape, dropout
        self.register_buffer("places", torch.from_numpy(positions(LONGEST_TEXT, shape.width)))

    def forward(self, batch: TextBatch, seen: Tensor, said: Tensor) -> Tensor:
        """Scores of the next symbol behind each symbol, shape (b, s, symbols).

        Args:
            batch: b texts.
            seen: which words are seen; of the others only the mark is, shape (b, n).
            said: symbols so far, shape (b, s).
        """
        x = self._means("grams", batch.grams) * seen[..., None]
        x = x + self._means("classes", batch.kinds)
        x = x + self._rows("marks", batch.marks)
        x = self._drop(x + self.places[: x.shape[1]])
        for k in range(self.shape.layers):
            x = x + self._attend(f"encode.{k}.self", x, None, batch.mask)
            x = x + self._feed(f"encode.{k}.feed", x)
        encoded = self.norm("encoded", x)
        y = self._drop(self._rows("symbols", said) + self.places[: said.shape[1]])
        for k in range(self.shape.decoder_layers):
            y = y + self._attend(f"decode.{k}.self", y, None, None)
            y = y + self._attend(f"decode.{k}.cross", y, encoded, batch.mask)
            y = y + self._feed(f"decode.{k}.feed", y)
        return self.linear("say", self.norm("decoded", y))

    def _means(self, name: str, bags: Bags) -> Tensor:
        """Weighted means of rows of a table, for each word, shape (b, n, width)."""
        means = torch.einsum("ugd,ug->ud", self._rows(name, bags.rows), bags.shares)
        return means.index_select(0, bags.which.flatten()).view(*bags.which.shape, -1)

    def _rows(self, name: str, rows: Tensor) -> Tensor:
        """Rows of a table."""
        found = self.of(name).index_select(0, rows.flatten())
        return found.view(*rows.shape, -1)

    def _attend(self, name: str, x: Tensor, other: Tensor | None, mask: Tensor | None) -> Tensor:
        heads = self.shape.heads
        plain = self.norm(f"{name}.norm", x)
        memory = plain if other is None else other
        b, m, d = memory.shape
        query = self.linear(f"{name}.query", plain).view(b, -1, heads, d // heads)
        both = self.linear(f"{name}.memory", memory).view(b, m, 2, heads, d // heads)
        mixed = functional.scaled_dot_product_attention(
            query.transpose(1, 2),
            both[:, :, 0].transpose(1, 2),
            both[:, :, 1].transpose(1, 2),
            attn_mask=None if mask is None else mask[:, None, None, :],
            is_causal=mask is None,
        )
        merged = self.linear(f"{name}.merge", mixed.transpose(1, 2).reshape(x.shape))
        return self._drop(merged)

    def _feed(self, name: str, x: Tensor) -> Tensor:
        return self._drop(self.perceptron(name, self.norm(f"{name}.norm", x)))

    def _drop(self, x: Tensor) -> Tensor:
        return functional.dropout(x, self.dropout, self.training)


def _normal(name: str, shape: tuple[int, ...], generator: torch.Generator) -> Tensor:
    """Small weights, normal; of tables, those of the size of a normalised row."""
    scale = 1.0 if name in ("grams", "classes", "marks", "symbols") else shape[1] ** -0.5
    return torch.empty(shape).normal_(0.0, scale, generator=generator)
