"""The network of the translator, in NumPy alone.

An encoder and a decoder of transformers with the normalisation first (Vaswani et al. 2017; Xiong et
al. 2020). A word goes in as the mean of vectors of its letter n-grams, which are hashed (Bojanowski
et al. 2017), and a vector of its mark. An unknown word is therefore near words with a similar
spelling.
"""

from __future__ import annotations

import math
import zlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache, lru_cache
from pathlib import Path

import numpy as np

from semnav_env.language.translating.masking import MARKS
from semnav_env.language.translating.programs import END, START, SYMBOLS
from semnav_env.networks.card import Card, TransformerSettings
from semnav_env.networks.layers import (
    Array,
    Shapes,
    attention,
    layer_norm,
    linear,
    linear_shapes,
    norm_shapes,
    perceptron,
    perceptron_shapes,
    softmax,
)
from semnav_env.networks.weights import load_weights
from semnav_features.checked_fields import Count

TRAINED_FOLDER = Path(__file__).with_name("trained")
"""Folder of the trained network."""

SHORTEST, LONGEST = 3, 5
"""Lengths of the n-grams, characters, with a sign for the word's ends."""

MAX_SYMBOLS = 48
"""The most symbols that are said; eight clauses need no more than that."""

NOW_KNOWN = len(SYMBOLS)
"""How many symbols a network learns now."""

UNLIKELY = 7.0
"""A beginning whose probability is less than that of a whole by this power of e is given up."""


@dataclass(frozen=True)
class TranslatorShape(TransformerSettings):
    """Sizes of the network; the width is that of the encoding of a word.

    Attributes:
        decoder_layers: layers of the decoder, which runs for every symbol; `layers` counts those of
            the encoder. A deep encoder with a shallow decoder is as good and faster (Kasai et al.
            2021).
        buckets: rows of the table of n-grams.
        classes: rows of the table of word classes.
        symbols: how many of `SYMBOLS`, the first ones, it knows and may say.
    """

    KIND = "translator"

    decoder_layers: Count = 2
    buckets: Count = 8192
    classes: Count = 1024
    symbols: Count = NOW_KNOWN

    def tensors(self) -> Shapes:
        """The shape of every tensor by name; weights are (outputs, inputs)."""
        d, h = self.width, self.hidden
        shapes: Shapes = {
            "grams": (self.buckets, d),
            "classes": (self.classes, d),
            "marks": (MARKS, d),
            "symbols": (self.symbols, d),
        }
        encoder = [f"encode.{k}" for k in range(self.layers)]
        decoder = [f"decode.{k}" for k in range(self.decoder_layers)]
        for block in (*encoder, *decoder):
            shapes |= _block(f"{block}.self", d) | perceptron_shapes(f"{block}.feed", d, h, d)
            shapes |= norm_shapes(f"{block}.feed.norm", d)
        for block in decoder:
            shapes |= _block(f"{block}.cross", d)
        shapes |= norm_shapes("encoded", d) | norm_shapes("decoded", d)
        return shapes | linear_shapes("say", d, self.symbols)


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


@lru_cache(maxsize=20_000)
def rows_of_classes(names: tuple[str, ...], classes: int) -> tuple[int, ...]:
    """The rows of the table for the classes of a word, hashed by CRC-32."""
    return tuple(zlib.crc32(name.encode()) % classes for name in names)


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

    def encode(
        self, words: Sequence[str], marks: Sequence[int], classes: Sequence[tuple[str, ...]]
    ) -> Array:
        """Encode the words, alone and in their context, shape (n, width)."""
        grams, table = self.tensors["grams"], self.tensors["classes"]
        rows = [grams[list(grams_of(word, self.shape.buckets))].mean(axis=0) for word in words]
        kinds = [list(rows_of_classes(names, self.shape.classes)) for names in classes]
        x = np.stack(rows) + np.stack([table[k].mean(axis=0) for k in kinds])
        x = x + self.tensors["marks"][list(marks)]
        x = x + positions(len(words), self.shape.width)
        for k in range(self.shape.layers):
            x = x + self._attend(f"encode.{k}.self", x)
            x = x + self._feed(f"encode.{k}.feed", x)
        return layer_norm(self.tensors, "encoded", x)

    def candidates(
        self, encoded: Array, count: int, allowed: Sequence[bool]
    ) -> list[tuple[tuple[str, ...], float]]:
        """The likeliest symbols and the logarithms of their probabilities, the likeliest first.

        A beam search: of each length the `count` likeliest beginnings are kept.

        Args:
            encoded: the words, see `encode`.
            count: how many, and the width of the beam.
            allowed: which of `SYMBOLS` may be said; those that it does not know are not.
        """
        unsaid = np.where(allowed[: self.shape.symbols], 0.0, -np.inf)
        beams = Beams(self, encoded)
        live: list[tuple[float, list[int]]] = [(0.0, [SYMBOLS.index(START)])]
        done: list[tuple[float, list[int]]] = []
        while live and len(live[0][1]) <= MAX_SYMBOLS:
            shares = beams.log_shares([said[-1] for _, said in live]) + unsaid
            longer = [
                (share + float(shares[row, k]), row, [*said, int(k)])
                for row, (share, said) in enumerate(live)
                for k in np.argsort(-shares[row], kind="stable")[:count]
            ]
            longer.sort(key=lambda each: -each[0])
            ended = [(s, said) for s, _, said in longer[: 2 * count] if SYMBOLS[said[-1]] == END]
            kept = [each for each in longer if SYMBOLS[each[2][-1]] != END][:count]
            live = [(share, said) for share, _, said in kept]
            beams.keep([row for _, row, _ in kept])
            done = sorted([*done, *ended], key=lambda each: -each[0])[:count]
            if done and live and live[0][0] < done[0][0] - UNLIKELY:
                break
            if len(done) == count and (not live or live[0][0] < done[-1][0]):
                break
        return [(tuple(SYMBOLS[k] for k in said[1:-1]), share) for share, said in done]

    def _attend(self, name: str, x: Array) -> Array:
        heads, plain = self.shape.heads, layer_norm(self.tensors, f"{name}.norm", x)
        queries = linear(self.tensors, f"{name}.query", plain).reshape(len(x), heads, -1)
        both = linear(self.tensors, f"{name}.memory", plain).reshape(len(x), 2, heads, -1)
        mixed = attention(queries, both[:, 0], both[:, 1])
        return linear(self.tensors, f"{name}.merge", mixed)

    def _feed(self, name: str, x: Array) -> Array:
        return perceptron(self.tensors, name, layer_norm(self.tensors, f"{name}.norm", x))


class Beams:
    """Beginnings of what is said, each a row, with the keys and values of their symbols so far.

    Args:
        network: that says them.
        encoded: the words, see `TranslatorNetwork.encode`.
    """

    def __init__(self, network: TranslatorNetwork, encoded: Array) -> None:
        self._tensors, self._shape = network.tensors, network.shape
        d, heads = network.shape.width, network.shape.heads
        self._places = positions(MAX_SYMBOLS + 2, d)
        self._length = 0
        self._heard = [
            linear(self._tensors, f"decode.{k}.cross.memory", encoded).reshape(
                1, len(encoded), 2, heads, d // heads
            )
            for k in range(network.shape.decoder_layers)
        ]
        nothing = np.zeros((1, 0, 2, heads, d // heads), np.float32)
        self._said = [nothing] * network.shape.decoder_layers

    def keep(self, rows: Sequence[int]) -> None:
        """Go on with these rows, one of them for each beginning."""
        self._said = [each[list(rows)] for each in self._said]

    def log_shares(self, said: Sequence[int]) -> Array:
        """Log probability of each symbol behind the given last ones, shape (rows, symbols)."""
        x = self._tensors["symbols"][list(said)] + self._places[self._length]
        self._length += 1
        for k in range(self._shape.decoder_layers):
            plain = layer_norm(self._tensors, f"decode.{k}.self.norm", x)
            new = linear(self._tensors, f"decode.{k}.self.memory", plain)
            new = new.reshape(len(x), 1, *self._said[k].shape[2:])
            self._said[k] = np.concatenate((self._said[k], new), axis=1)
            x = x + self._attend(f"decode.{k}.self", plain, self._said[k])
            plain = layer_norm(self._tensors, f"decode.{k}.cross.norm", x)
            x = x + self._attend(f"decode.{k}.cross", plain, self._heard[k])
            plain = layer_norm(self._tensors, f"decode.{k}.feed.norm", x)
            x = x + perceptron(self._tensors, f"decode.{k}.feed", plain)
        scores = linear(self._tensors, "say", layer_norm(self._tensors, "decoded", x))
        shifted = scores - scores.max(axis=1, keepdims=True)
        result: Array = shifted - np.log(np.exp(shifted).sum(axis=1, keepdims=True))
        return result

    def _attend(self, name: str, plain: Array, memory: Array) -> Array:
        """Attention of each row to its memory, shape (rows or 1, m, 2, heads, width / heads)."""
        rows, heads = len(plain), self._shape.heads
        queries = linear(self._tensors, f"{name}.query", plain).reshape(rows, heads, 1, -1)
        keys, values = memory[:, :, 0], memory[:, :, 1]
        scores = queries @ keys.transpose(0, 2, 3, 1) / math.sqrt(queries.shape[-1])
        mixed = softmax(scores) @ values.transpose(0, 2, 1, 3)
        return linear(self._tensors, f"{name}.merge", mixed.reshape(rows, -1))


@cache
def load_translator(folder: Path = TRAINED_FOLDER) -> TranslatorNetwork:
    """The network of a folder, by default the bundled one; each folder is read once.

    Raises:
        ValueError: the files are not those of a translator, or not of this version.
        OSError: they cannot be read.
    """
    shape = Card.read(folder, TranslatorShape).settings
    return TranslatorNetwork(shape, load_weights(folder, shape.tensors()))
