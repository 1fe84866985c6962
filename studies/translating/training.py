"""Trains the translator's network on texts, on processors, the same for the same seed."""

from __future__ import annotations

import math
import time
from collections.abc import Hashable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import torch
from torch.nn import functional

from semnav_env.language.errors import CommandError
from semnav_env.language.translating.masking import NO_MARK, masked
from semnav_env.language.translating.network import (
    MAX_SYMBOLS,
    TranslatorNetwork,
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
from semnav_features.checked_fields import Count, check_fields
from studies.translating.texts import TrainingText
from studies.translating.torch_network import TorchTranslator


@dataclass(frozen=True)
class TranslatorTraining:
    """How the network is trained.

    Attributes:
        steps: of gradient descent.
        batch: texts of a step.
        rate: highest learning rate; it rises linearly and falls as a cosine.
        warm_up: steps in which it rises.
        dropout: share of the activations that are dropped.
        word_dropout: share of the words of which only the mark is seen.
        value_dropout: the same of words with a mark.
        shape: of the network.
    """

    steps: Count = 16000
    batch: Count = 48
    rate: float = 1.5e-3
    warm_up: Count = 300
    dropout: float = 0.12
    word_dropout: float = 0.12
    value_dropout: float = 0.6
    shape: TranslatorShape = field(default_factory=lambda: TranslatorShape(128, 4, 3, 384))

    def __post_init__(self) -> None:
        check_fields(self)


@dataclass(frozen=True)
class EncodedText:
    """A text as numbers.

    Attributes:
        words: of the text.
        marks: of each word.
        symbols: numbers of what is to be said, with its start and end.
    """

    words: tuple[str, ...]
    marks: tuple[int, ...]
    classes: tuple[tuple[int, ...], ...]
    symbols: tuple[int, ...]


def encoded(text: TrainingText, shape: TranslatorShape) -> EncodedText | None:
    """A text as numbers; None if what it means cannot be said."""
    try:
        plain = masked(text.text, text.rooms)
        said = symbols_of(text.commands[0], plain) if text.commands else (REFUSE,)
    except (CommandError, UnsayableError):
        return None
    if len(said) >= MAX_SYMBOLS or not plain.words:
        return None
    rows = tuple(rows_of_classes(names, shape.classes) for names in plain.classes)
    return EncodedText(
        plain.words, plain.marks, rows, tuple(map(SYMBOLS.index, (START, *said, END)))
    )


def trained(
    texts: Sequence[TrainingText], settings: TranslatorTraining, seed: int
) -> TranslatorNetwork:
    """A network that translates the texts.

    Args:
        texts: drawn from at random.
        settings: of the training.
        seed: of the weights and of what is drawn.
    """
    known = [each for t in texts if (each := encoded(t, settings.shape)) is not None]
    torch.set_num_threads(1)  # a small network is slower with more, and its sums may differ
    torch.manual_seed(seed)
    model = TorchTranslator(settings.shape, seed, settings.dropout)
    optimizer = torch.optim.AdamW(model.parameters(), lr=settings.rate, betas=(0.9, 0.98))
    start, total = time.monotonic(), 0.0
    batches = _batches(known, settings, np.random.default_rng(seed))
    for step in range(settings.steps):
        for group in optimizer.param_groups:
            group["lr"] = settings.rate * _pace(step, settings)
        loss = _loss(model, next(batches))
        optimizer.zero_grad()
        loss.backward()  # type: ignore[no-untyped-call]
        torch.nn.utils.clip_grad_norm_(model.parameters(), 1.0)
        optimizer.step()
        total += loss.item()
        if step % 250 == 249:
            took = time.monotonic() - start
            print(f"step {step + 1}: loss {total / 250:.3f}, {took:.0f} s", flush=True)
            total = 0.0
    return TranslatorNetwork(settings.shape, model.arrays())


def _pace(step: int, settings: TranslatorTraining) -> float:
    if step < settings.warm_up:
        return (step + 1) / settings.warm_up
    done = (step - settings.warm_up) / (settings.steps - settings.warm_up)
    return 0.5 * (1.0 + math.cos(math.pi * done))


def _loss(model: TorchTranslator, batch: tuple[torch.Tensor, ...]) -> torch.Tensor:
    *inputs, said = batch
    scores = model(*inputs, said[:, :-1].clamp(min=0))
    return functional.cross_entropy(scores.flatten(0, 1), said[:, 1:].flatten(), ignore_index=-1)


def _batches(
    known: Sequence[EncodedText], settings: TranslatorTraining, rng: np.random.Generator
) -> Iterator[tuple[torch.Tensor, ...]]:
    """Batches of texts of similar length, without end."""
    lengths = np.array([len(each.marks) for each in known])
    pool = settings.batch * 16
    while True:
        drawn = rng.integers(len(known), size=pool)
        drawn = drawn[np.argsort(lengths[drawn], kind="stable")]
        for first in rng.permutation(np.arange(0, pool, settings.batch)):
            yield _tensors([known[k] for k in drawn[first : first + settings.batch]], settings, rng)


def _tensors(
    texts: Sequence[EncodedText], settings: TranslatorTraining, rng: np.random.Generator
) -> tuple[torch.Tensor, ...]:
    b, n = len(texts), max(len(each.marks) for each in texts)
    shape = settings.shape
    grams, words = _bags(
        [[(w, grams_of(w, shape.buckets)) for w in each.words] for each in texts], n
    )
    kinds, classed = _bags([[(row, row) for row in each.classes] for each in texts], n)
    marks = np.zeros((b, n), np.int64)
    said = np.full((b, max(len(each.symbols) for each in texts)), -1)
    for i, each in enumerate(texts):
        marks[i, : len(each.marks)] = each.marks
        said[i, : len(each.symbols)] = each.symbols
    limits = np.where(marks == NO_MARK, settings.word_dropout, settings.value_dropout)
    seen = (rng.random(marks.shape) >= limits).astype(np.float32)
    mask = np.arange(n) < np.array([len(each.marks) for each in texts])[:, None]
    arrays = (*grams, words, *kinds, classed, seen, marks, mask, said)
    return tuple(map(torch.from_numpy, arrays))


def _bags(
    texts: Sequence[Sequence[tuple[Hashable, tuple[int, ...]]]], n: int
) -> tuple[tuple[Any, Any], Any]:
    """The different bags of rows, with the weight of each row, and which bag each word has.

    Args:
        texts: of each word what it is, and its rows.
        n: words of the longest text.
    """
    rows: dict[Hashable, tuple[int, ...]] = {key: bag for each in texts for key, bag in each}
    places = {key: k for k, key in enumerate(rows)}
    table = np.zeros((len(rows), max(map(len, rows.values()))), np.int64)
    shares = np.zeros(table.shape, np.float32)
    for k, bag in enumerate(rows.values()):
        table[k, : len(bag)] = bag
        shares[k, : len(bag)] = 1.0 / len(bag)
    which = np.zeros((len(texts), n), np.int64)
    for i, each in enumerate(texts):
        which[i, : len(each)] = [places[key] for key, _ in each]
    return (table, shares), which
