"""Training texts as arrays, so that batches of them are made on the device of the network."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, fields

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor

from semnav_env.language.errors import CommandError
from semnav_env.language.translating.masking import masked
from semnav_env.language.translating.network import (
    MAX_SYMBOLS,
    TranslatorShape,
    grams_of,
    rows_of_classes,
)
from semnav_env.language.translating.programs import (
    END,
    REFUSE,
    START,
    SYMBOLS,
    UnsayableError,
    symbols_of,
)
from studies.translating.texts import TrainingText

Ints = NDArray[np.int64]

NO_SYMBOL = -1
"""Fills up a command behind its last symbol."""


@dataclass(frozen=True)
class EncodedText:
    """A text as numbers.

    Attributes:
        words: of the text.
        marks: of each word.
        classes: of each word.
        symbols: numbers of what is to be said, with its start and end.
    """

    words: tuple[str, ...]
    marks: tuple[int, ...]
    classes: tuple[tuple[str, ...], ...]
    symbols: tuple[int, ...]


def encoded(text: TrainingText) -> EncodedText | None:
    """A text as numbers; None if what it means cannot be said."""
    try:
        plain = masked(text.text, text.rooms)
        said = symbols_of(text.commands[0], plain) if text.commands else (REFUSE,)
    except (CommandError, UnsayableError):
        return None
    if len(said) >= MAX_SYMBOLS or not plain.words:
        return None
    symbols = tuple(map(SYMBOLS.index, (START, *said, END)))
    return EncodedText(plain.words, plain.marks, plain.classes, symbols)


@dataclass(frozen=True)
class TextArrays:
    """Texts as arrays; those of words and symbols are of all texts, one behind the other.

    Attributes:
        grams: rows of the table of n-grams for each of u different words, shape (u, g).
        gram_shares: the weight of each of them, 0 for none, shape (u, g).
        kinds: rows of the table of classes for each of v different sets of them, shape (v, c).
        kind_shares: the weight of each of them, 0 for none, shape (v, c).
        words: which of the u words.
        classes: which of the v sets.
        marks: of each word.
        first_words: place of the first word of each text, and the end, shape (texts + 1,).
        symbols: what is to be said.
        first_symbols: place of the first symbol of each text, and the end, shape (texts + 1,).
    """

    grams: Tensor
    gram_shares: Tensor
    kinds: Tensor
    kind_shares: Tensor
    words: Tensor
    classes: Tensor
    marks: Tensor
    first_words: Tensor
    symbols: Tensor
    first_symbols: Tensor

    @classmethod
    def of(cls, texts: Sequence[EncodedText], shape: TranslatorShape) -> TextArrays:
        """The arrays of texts, for a network of a shape."""
        words = _numbered(word for text in texts for word in text.words)
        classes = _numbered(names for text in texts for names in text.classes)
        arrays = (
            *_bags([grams_of(word, shape.buckets) for word in words]),
            *_bags([rows_of_classes(names, shape.classes) for names in classes]),
            np.array([words[word] for text in texts for word in text.words]),
            np.array([classes[names] for text in texts for names in text.classes]),
            np.array([mark for text in texts for mark in text.marks]),
            _ends([len(text.words) for text in texts]),
            np.array([symbol for text in texts for symbol in text.symbols]),
            _ends([len(text.symbols) for text in texts]),
        )
        return cls(*map(torch.from_numpy, arrays))

    def to(self, device: str) -> TextArrays:
        """The same arrays on a device."""
        return TextArrays(*(getattr(self, each.name).to(device) for each in fields(self)))

    def batch(self, texts: Tensor, most_words: int, most_symbols: int) -> TextBatch:
        """Some of the texts, filled up to the same length.

        Args:
            texts: their numbers, shape (b,).
            most_words: of a text.
            most_symbols: of a command.
        """
        at, mask = _places(self.first_words, texts, most_words)
        said, is_said = _places(self.first_symbols, texts, most_symbols)
        words, spelt = _different(self.words[at])
        kinds, classed = _different(self.classes[at])
        return TextBatch(
            Bags(self.grams[words], self.gram_shares[words], spelt),
            Bags(self.kinds[kinds], self.kind_shares[kinds], classed),
            self.marks[at],
            mask,
            self.symbols[said].where(is_said, NO_SYMBOL),
        )


@dataclass(frozen=True)
class Bags:
    """Of each word of b texts a set of rows of a table.

    Attributes:
        rows: of each of u sets, shape (u, g).
        shares: weight of each of the rows, 0 for none, shape (u, g).
        which: the set of each word, shape (b, n).
    """

    rows: Tensor
    shares: Tensor
    which: Tensor


@dataclass(frozen=True)
class TextBatch:
    """b texts of at most n words and s symbols each.

    Attributes:
        grams: rows of the table of n-grams.
        kinds: rows of the table of classes.
        marks: shape (b, n).
        mask: which words there are, shape (b, n).
        symbols: what is to be said, `NO_SYMBOL` behind its end, shape (b, s).
    """

    grams: Bags
    kinds: Bags
    marks: Tensor
    mask: Tensor
    symbols: Tensor


def _numbered(things: Iterable[object]) -> dict[object, int]:
    """The different things in the order of their first mention, with their numbers."""
    return {thing: number for number, thing in enumerate(dict.fromkeys(things))}


def _bags(rows: Sequence[tuple[int, ...]]) -> tuple[Ints, NDArray[np.float32]]:
    """Sets of rows as a table, and the weight of each row in the mean of its set."""
    most = max(map(len, rows))
    table = np.tile(np.arange(most), (len(rows), 1))  # of no weight, and spread over the rows
    shares = np.zeros(table.shape, np.float32)
    for k, bag in enumerate(rows):
        table[k, : len(bag)] = bag
        shares[k, : len(bag)] = 1.0 / len(bag)
    return table, shares


def _ends(lengths: Sequence[int]) -> Ints:
    return np.cumsum([0, *lengths])


def _places(firsts: Tensor, texts: Tensor, most: int) -> tuple[Tensor, Tensor]:
    """The places of the parts of some texts, and which of them there are, shape (b, most)."""
    at = firsts[texts][:, None] + torch.arange(most, device=texts.device)
    mask = at < firsts[texts + 1][:, None]
    return at.where(mask, 0), mask


def _different(things: Tensor) -> tuple[Tensor, Tensor]:
    """The different things, and which of them each one is.

    A graphics processor would have to be waited for to know how many they are, so there all are.
    """
    if things.is_cuda:
        return things.flatten(), torch.arange(things.numel(), device=things.device).view_as(things)
    different: tuple[Tensor, Tensor] = torch.unique(things, return_inverse=True)
    return different
