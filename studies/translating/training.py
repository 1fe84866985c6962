"""Trains the translator's network on texts; on processors the same for the same seed.

A network may also learn from others that have learned already, its teachers: what they say of a
text together is a better measure of what it may mean than the one command that an author wrote
(Hinton et al. 2015). They say nothing of a text that is new to them, which would leave the network
as unsure of it as they are, nor of one whose meaning has a symbol that one of them does not know.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np
import torch
from torch import Tensor
from torch.nn import functional

from semnav_env.language.translating.masking import NO_MARK
from semnav_env.language.translating.network import TranslatorNetwork, TranslatorShape
from semnav_features.checked_fields import Count, check_fields
from studies.translating.arrays import NO_SYMBOL, EncodedText, TextArrays, TextBatch, encoded
from studies.translating.texts import TrainingText
from studies.translating.torch_network import TorchTranslator

LENGTH_GROUPS = 16
"""Groups of texts of similar length; each batch is drawn from one group."""

OWN_WEIGHT = 0.5
"""Weight of the authors' own meanings in the loss of a text of which the teachers say something."""

SHOWN = 500
"""Steps between two lines of the log."""


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
        device: "cpu", or "cuda" for a graphics processor.
    """

    steps: Count = 23150
    batch: Count = 256
    rate: float = 1.5e-3
    warm_up: Count = 500
    dropout: float = 0.08
    word_dropout: float = 0.12
    value_dropout: float = 0.6
    shape: TranslatorShape = field(default_factory=lambda: TranslatorShape(192, 6, 4, 576))
    device: str = "cpu"

    def __post_init__(self) -> None:
        check_fields(self)


def encoded_texts(texts: Iterable[TrainingText]) -> list[EncodedText]:
    """The texts whose meaning can be said, encoded."""
    return [each for text in texts if (each := encoded(text)) is not None]


def trained(
    texts: TextArrays,
    settings: TranslatorTraining,
    seed: int,
    teachers: Sequence[TranslatorNetwork] = (),
    begun: TranslatorNetwork | None = None,
    taught: float = math.inf,
) -> TranslatorNetwork:
    """A network that translates the texts.

    Args:
        texts: drawn from at random.
        settings: of the training.
        seed: of the weights and of what is drawn.
        teachers: networks whose probabilities are learned beside the texts' own meanings.
        begun: a network of the same shape whose weights are the first ones, though it may know
            fewer symbols; what it lacks is drawn.
        taught: how many of the texts, the first ones, the teachers know; all by default.
    """
    torch.set_num_threads(1)  # a small network is slower with more, and its sums may differ
    torch.manual_seed(seed)
    device = settings.device
    torch.backends.cuda.matmul.allow_tf32 = True
    model = TorchTranslator(settings.shape, seed, settings.dropout)
    if begun is not None:
        _copy(begun, model)
    model.to(device)
    known = [_teacher(each).to(device) for each in teachers]
    descent = _Descent(model, known, texts.to(device), settings, taught)
    start, losses = time.monotonic(), torch.zeros((), device=device)
    for step, (numbers, words, symbols) in enumerate(_draws(texts, settings, seed), 1):
        losses += descent.step(numbers.to(device), words, symbols, _pace(step, settings))
        if step % SHOWN == 0:
            took = time.monotonic() - start
            print(f"step {step}: loss {losses.item() / SHOWN:.3f}, {took:.0f} s", flush=True)
            losses.zero_()
    return TranslatorNetwork(settings.shape, model.cpu().arrays())


def _teacher(network: TranslatorNetwork) -> TorchTranslator:
    model = TorchTranslator(network.shape, 0, 0.0)
    _copy(network, model)
    return model.eval().requires_grad_(False)


def _copy(network: TranslatorNetwork, model: TorchTranslator) -> None:
    """Give a model the weights of a network; rows that only the model has stay."""
    with torch.no_grad():
        for name, tensor in model.named().items():
            known = torch.from_numpy(network.tensors[name])
            tensor[: len(known)].copy_(known)


def _draws(
    texts: TextArrays, settings: TranslatorTraining, seed: int
) -> Iterator[tuple[Tensor, int, int]]:
    """For each step the numbers of texts of similar length, with their most words and symbols.

    On a graphics processor these are the most of the group, so that few steps are recorded.
    """
    rng = np.random.default_rng(seed)
    lengths, said = (np.diff(each.numpy()) for each in (texts.first_words, texts.first_symbols))
    groups = min(LENGTH_GROUPS, len(lengths))
    sets = np.array_split(np.argsort(lengths + said, kind="stable"), groups)
    limits = [(int(lengths[each].max()), int(said[each].max())) for each in sets]
    for _ in range(settings.steps):
        k = int(rng.integers(groups))
        drawn = rng.choice(sets[k], settings.batch)
        most = int(lengths[drawn].max()), int(said[drawn].max())
        yield torch.from_numpy(drawn), *(most if settings.device == "cpu" else limits[k])


def _pace(step: int, settings: TranslatorTraining) -> float:
    """The learning rate of a step."""
    if step <= settings.warm_up:
        return settings.rate * step / settings.warm_up
    done = (step - settings.warm_up) / (settings.steps - settings.warm_up)
    return settings.rate * 0.5 * (1.0 + math.cos(math.pi * done))


class _Descent:
    """Steps of gradient descent.

    On a graphics processor a step is recorded once for each shape of a batch (a CUDA graph) and
    then replayed, because starting its many small kernels takes longer than running them.
    """

    def __init__(
        self,
        model: TorchTranslator,
        teachers: Sequence[TorchTranslator],
        texts: TextArrays,
        settings: TranslatorTraining,
        taught: float,
    ) -> None:
        self._model, self._teachers, self._texts, self._settings = model, teachers, texts, settings
        self._taught = taught
        on_cuda = settings.device != "cpu"
        self._rate = torch.tensor(0.0, device=settings.device)
        self._optimizer = torch.optim.AdamW(
            model.parameters(),
            lr=self._rate,
            betas=(0.9, 0.98),
            capturable=on_cuda,
            foreach=on_cuda,
        )
        self._numbers = torch.zeros(settings.batch, dtype=torch.int64, device=settings.device)
        self._memory = torch.cuda.graph_pool_handle() if on_cuda else None
        self._recorded: dict[tuple[int, int], Callable[[], Tensor]] = {}

    def step(self, numbers: Tensor, words: int, symbols: int, rate: float) -> Tensor:
        """Take one step; returns the loss before it.

        Args:
            numbers: of the texts, shape (batch,).
            words: most of a text.
            symbols: most of a command.
            rate: the learning rate.
        """
        self._numbers.copy_(numbers)
        self._rate.fill_(rate)
        if self._memory is None:
            return self._descend(words, symbols)
        if (words, symbols) not in self._recorded:
            self._recorded[words, symbols] = self._record(words, symbols)
        return self._recorded[words, symbols]()

    def _record(self, words: int, symbols: int) -> Callable[[], Tensor]:
        aside = torch.cuda.Stream()  # type: ignore[no-untyped-call]
        aside.wait_stream(torch.cuda.current_stream())
        with torch.cuda.stream(aside):
            for _ in range(3):
                self._descend(words, symbols)
        torch.cuda.current_stream().wait_stream(aside)
        graph = torch.cuda.CUDAGraph()
        with torch.cuda.graph(graph, pool=self._memory):
            loss = self._descend(words, symbols)

        def play() -> Tensor:
            graph.replay()
            return loss

        return play

    def _descend(self, words: int, symbols: int) -> Tensor:
        batch = self._texts.batch(self._numbers, words, symbols)
        self._optimizer.zero_grad(set_to_none=True)
        loss = self._loss(batch)
        loss.backward()  # type: ignore[no-untyped-call]
        torch.nn.utils.clip_grad_norm_(self._model.parameters(), 1.0)
        self._optimizer.step()
        return loss.detach()

    def _loss(self, batch: TextBatch) -> Tensor:
        said, wanted = batch.symbols[:, :-1].clamp(min=0), batch.symbols[:, 1:]
        limits = torch.where(
            batch.marks == NO_MARK, self._settings.word_dropout, self._settings.value_dropout
        )
        seen = torch.rand(batch.marks.shape, device=limits.device) >= limits
        scores = self._model(batch, seen, said)
        own = functional.cross_entropy(
            scores.transpose(1, 2), wanted, ignore_index=NO_SYMBOL, reduction="none"
        )
        count = (wanted != NO_SYMBOL).sum()
        if not self._teachers:
            return own.sum() / count
        known = min(each.shape.symbols for each in self._teachers)
        is_taught = (wanted < known).all(dim=1) & (self._numbers < self._taught)
        counts = (wanted != NO_SYMBOL) & is_taught[:, None]
        with torch.no_grad():
            all_seen, spoken = torch.ones_like(seen), said.clamp(max=known - 1)
            shares = [each(batch, all_seen, spoken).softmax(dim=2) for each in self._teachers]
            taught = torch.stack([each[..., :known] for each in shares]).mean(dim=0)
        missed = -(taught * scores.log_softmax(dim=2)[..., :known]).sum(dim=2)
        weight = torch.where(counts, OWN_WEIGHT, 1.0)
        loss: Tensor = (weight * own + (1.0 - weight) * missed).sum() / count
        return loss
