"""The translator's network as it runs: NumPy alone.

An encoder and a decoder of transformers with the normalisation first (Vaswani et al. 2017; Xiong et
al. 2020). A word goes in as the mean of vectors of its letter n-grams, which are hashed (Bojanowski
et al. 2017), and a vector of its mark. So a word that was never seen is near those spelt alike.
"""

from __future__ import annotations

import math
import zlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache, lru_cache
from pathlib import Path

import numpy as np

from semnav_agents.networks.card import BUNDLED_FOLDER, Card, TransformerSettings
from semnav_agents.networks.layers import (
    Array,
    Shapes,
    attention,
    layer_norm,
    linear,
    linear_shapes,
    norm_shapes,
    perceptron,
    perceptron_shapes,
)
from semnav_agents.networks.weights import load_weights
from semnav_agents.translating.masking import MARKS
from semnav_agents.translating.programs import END, START, SYMBOLS
from semnav_features.checked_fields import Count

SHORTEST, LONGEST = 3, 5
"""Lengths of the n-grams, characters, with a sign for the word's ends."""

MAX_SYMBOLS = 48
"""The most symbols that are said; eight clauses need no more than that."""

UNLIKELY = 7.0
"""A beginning whose probability is less than that of a whole by this power of e is given up."""


@dataclass(frozen=True)
class TranslatorShape(TransformerSettings):
    """Sizes of the network, whose width is that of a word inside.

    Attributes:
        buckets: rows of the table of n-grams.
    """

    KIND = "translator"

    buckets: Count = 4096

    def tensors(self) -> Shapes:
        """The shape of every tensor by name; weights are (outputs, inputs)."""
        d, h = self.width, self.hidden
        shapes: Shapes = {
            "grams": (self.buckets, d),
            "marks": (MARKS, d),
            "symbols": (len(SYMBOLS), d),
        }
        for k in range(self.layers):
            for block in (f"encode.{k}", f"decode.{k}"):
                shapes |= _block(f"{block}.self", d) | perceptron_shapes(f"{block}.feed", d, h, d)
                shapes |= norm_shapes(f"{block}.feed.norm", d)
            shapes |= _block(f"decode.{k}.cross", d)
        shapes |= norm_shapes("encoded", d) | norm_shapes("decoded", d)
        return shapes | linear_shapes("say", d, len(SYMBOLS))


def _block(name: str, d: int) -> Shapes:
    shapes = norm_shapes(f"{name}.norm", d) | linear_shapes(f"{name}.query", d, d)
    return shapes | linear_shapes(f"{name}.memory", d, 2 * d) | linear_shapes(f"{name}.merge", d, d)


@lru_cache(maxsize=20_000)
def grams_of(word: str, buckets: int) -> tuple[int, ...]:
    """The rows of the table for a word: its n-grams and the word itself, hashed by CRC-32."""
    padded = f"<{word}>"
    parts = {
        padded[start : start + length]
        for length in range(SHORTEST, LONGEST + 1)
        for start in range(len(padded) - length + 1)
    }
    return tuple(sorted(zlib.crc32(part.encode()) % buckets for part in parts | {padded}))


def positions(count: int, width: int) -> Array:
    """Sines and cosines of the positions, shape (count, width)."""
    rates = np.exp(-math.log(1e4) * np.arange(0, width, 2) / width)
    angles = np.arange(count)[:, None] * rates
    return np.concatenate((np.sin(angles), np.cos(angles)), axis=1).astype(np.float32)


class TranslatorNetwork:
    """A trained network.

    Args:
        shape: of the network.
        tensors: its weights by name, see `TranslatorShape.tensors`.
    """

    def __init__(self, shape: TranslatorShape, tensors: Mapping[str, Array]) -> None:
        self.shape, self.tensors = shape, tensors

    def encode(self, words: Sequence[str], marks: Sequence[int]) -> Array:
        """What the words are, one by one and with those around them, shape (n, width)."""
        grams = self.tensors["grams"]
        rows = [grams[list(grams_of(word, self.shape.buckets))].mean(axis=0) for word in words]
        x = np.stack(rows) + self.tensors["marks"][list(marks)]
        x = x + positions(len(words), self.shape.width)
        for k in range(self.shape.layers):
            x = x + self._attend(f"encode.{k}.self", x)
            x = x + self._feed(f"encode.{k}.feed", x)
        return layer_norm(self.tensors, "encoded", x)

    def log_shares(self, said: Sequence[int], encoded: Array) -> Array:
        """Log probability of each symbol behind the symbols that are said, shape (symbols,)."""
        x = self.tensors["symbols"][list(said)] + positions(len(said), self.shape.width)
        for k in range(self.shape.layers):
            x = x + self._attend(f"decode.{k}.self", x, causal=True)
            x = x + self._attend(f"decode.{k}.cross", x, encoded)
            x = x + self._feed(f"decode.{k}.feed", x)
        scores = linear(self.tensors, "say", layer_norm(self.tensors, "decoded", x[-1:]))[0]
        shifted = scores - scores.max()
        result: Array = shifted - np.log(np.exp(shifted).sum())
        return result

    def candidates(self, encoded: Array, count: int) -> list[tuple[tuple[str, ...], float]]:
        """The likeliest symbols and the logarithms of their probabilities, the likeliest first.

        A beam search: of each length the `count` likeliest beginnings are kept.

        Args:
            encoded: the words, see `encode`.
            count: how many, and the width of the beam.
        """
        live: list[tuple[float, list[int]]] = [(0.0, [SYMBOLS.index(START)])]
        done: list[tuple[float, list[int]]] = []
        while live and len(live[0][1]) <= MAX_SYMBOLS:
            longer = []
            for share, said in live:
                shares = self.log_shares(said, encoded)
                longer += [
                    (share + float(shares[k]), [*said, int(k)])
                    for k in np.argsort(-shares, kind="stable")[:count]
                ]
            longer.sort(key=lambda each: -each[0])
            ended = [each for each in longer[: 2 * count] if SYMBOLS[each[1][-1]] == END]
            live = [each for each in longer if SYMBOLS[each[1][-1]] != END][:count]
            done = sorted([*done, *ended], key=lambda each: -each[0])[:count]
            if done and live and live[0][0] < done[0][0] - UNLIKELY:
                break
            if len(done) == count and (not live or live[0][0] < done[-1][0]):
                break
        return [(tuple(SYMBOLS[k] for k in said[1:-1]), share) for share, said in done]

    def log_share_of(self, symbols: Sequence[str], encoded: Array) -> float:
        """The logarithm of the probability that these symbols, and no more, are said."""
        said, total = [SYMBOLS.index(START)], 0.0
        for symbol in (*symbols, END):
            total += float(self.log_shares(said, encoded)[SYMBOLS.index(symbol)])
            said.append(SYMBOLS.index(symbol))
        return total

    def _attend(
        self, name: str, x: Array, other: Array | None = None, causal: bool = False
    ) -> Array:
        heads, plain = self.shape.heads, layer_norm(self.tensors, f"{name}.norm", x)
        memory = plain if other is None else other
        queries = linear(self.tensors, f"{name}.query", plain).reshape(len(x), heads, -1)
        both = linear(self.tensors, f"{name}.memory", memory).reshape(len(memory), 2, heads, -1)
        mixed = attention(queries, both[:, 0], both[:, 1], causal)
        return linear(self.tensors, f"{name}.merge", mixed)

    def _feed(self, name: str, x: Array) -> Array:
        return perceptron(self.tensors, name, layer_norm(self.tensors, f"{name}.norm", x))


@cache
def load_translator(folder: Path = BUNDLED_FOLDER / "translator") -> TranslatorNetwork:
    """The network of a folder, of that which comes with the package by default; read once.

    Raises:
        ValueError: the files are not those of a translator, or not of this version.
        OSError: they cannot be read.
    """
    shape = Card.read(folder, TranslatorShape).settings
    return TranslatorNetwork(shape, load_weights(folder, shape.tensors()))
