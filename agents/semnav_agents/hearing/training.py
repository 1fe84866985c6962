"""Training of an agent that hears: rounds of driving and learning, kept in one folder.

Every random draw follows from the seed and the number of the round, the chunk or the epoch. After
an interruption an unfinished chunk or epoch is repeated, and gives the same result. A preset that
begins with the rounds of a finished training goes on from its weights with further rounds.
"""

from __future__ import annotations

import json
import math
import time
from collections.abc import Iterator
from dataclasses import asdict, replace
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import torch

from semnav_agents.base import Agent
from semnav_agents.hearing.agent import HearingAgent
from semnav_agents.hearing.collecting import Collector, Samples, ShownAgent
from semnav_agents.hearing.learning import Learner, measured
from semnav_agents.hearing.mirror import Arrays
from semnav_agents.hearing.network import GroundingNetwork, NetworkShape
from semnav_agents.hearing.presets import HearingPreset, HearingRound
from semnav_agents.hearing.torch_network import TorchGrounding
from semnav_agents.learned import LearnedAgent
from semnav_env.judge.episodes import Episode, load_episodes
from semnav_env.networks.card import CARD_FILE, Card
from semnav_env.networks.weights import (
    WEIGHTS_FILE,
    load_tensors,
    load_weights,
    save_tensors,
    save_weights,
)
from semnav_features.writing import replacing

STATE_FILE, SAMPLES = "training.safetensors", "samples"

PROGRESS = "progress"
"""Name of the tensor that says after which round and epoch the state was saved."""

MEASURED = 4000
"""Samples of the last chunk of a round on which the network is measured in that round; it learns
from no such chunk, unless it is the only one of its round."""

LAST_SHARE = 0.02
"""Share of a round's step size at its end."""


class HearingTrainer:
    """One training, kept in one folder.

    Args:
        preset: the settings of the training.
        folder: for the agent, its samples and its state; made if it does not exist.
        seed: of weights, episodes, samples and their order.

    Raises:
        ValueError: the folder holds a training with another seed or with a preset whose rounds do
            not begin those of this one.
    """

    def __init__(self, preset: HearingPreset, folder: Path, seed: int) -> None:
        torch.set_num_threads(1)  # a small network is slower with more
        self.preset, self.folder, self.seed = preset, folder, seed
        (folder / SAMPLES).mkdir(parents=True, exist_ok=True)
        self.card = Card(preset.shape, plain_preset(preset), seed)
        self.network = TorchGrounding(preset.shape, seed)
        self.learner = Learner(self.network)
        if (folder / CARD_FILE).exists():
            self._resume()

    def advance(self) -> Iterator[dict[str, Any]]:
        """Run the chunks and epochs that are left; yields a row of the curve after each."""
        for number, each in enumerate(self.preset.rounds):
            for chunk in range(self._chunks(each)):
                if not self._has(number, chunk=chunk):
                    yield self._note(self._drive(number, chunk))
            left = [e for e in range(each.epochs) if not self._has(number, epoch=e)]
            samples = self._samples(number) if left else {}
            for epoch in left:
                yield self._note(self._learn(number, epoch, samples))

    @property
    def steps(self) -> int:
        """Chunks and epochs in all."""
        return sum(self._chunks(each) + each.epochs for each in self.preset.rounds)

    def _chunks(self, each: HearingRound) -> int:
        return -(-each.episodes // self.preset.chunk)

    def _has(self, number: int, **what: int) -> bool:
        wanted = {"round": number, **what}
        return any(wanted.items() <= row.items() for row in self.card.curve)

    def _note(self, row: dict[str, Any]) -> dict[str, Any]:
        """Keep a row of the curve. The card is written last, so it describes saved files only."""
        self.card.curve.append(row)
        self.card.write(self.folder)
        return row

    def _drive(self, number: int, chunk: int) -> dict[str, Any]:
        """Drive the episodes of a chunk and keep their samples."""
        start = time.process_time()
        seed, preset = (self.seed, number, chunk), self.preset
        drivers, robots = preset.rounds[number].drivers, preset.rounds[number].robots
        robot = robots[chunk % len(robots)]
        collector = Collector(self._commands, seed, robot, preset.max_seconds)
        driver = self._driver(drivers[chunk % len(drivers)])
        samples, done = Samples(), []
        for episode in self._episodes(number, chunk):
            done.append(collector.drive(episode, driver, samples))
        with replacing(self._file(number, chunk)) as part:
            np.savez(part, **samples.arrays())  # type: ignore[arg-type]
        success, seconds = float(np.mean(done)), time.process_time() - start
        row = {"round": number, "chunk": chunk, "success": round(success, 3)}
        return row | {"samples": len(samples.labels), "seconds": round(seconds, 1)}

    def _learn(self, number: int, epoch: int, samples: Arrays) -> dict[str, Any]:
        """Pass over all samples once, and save."""
        start, each = time.process_time(), self.preset.rounds[number]
        rates = tuple(_rate(each, epoch + k) for k in (0, 1))
        rng = np.random.default_rng((self.seed, number, epoch))
        if epoch == 0:  # a round begins with a fresh optimizer
            self.learner = Learner(self.network)
        loss = self.learner.epoch(samples, self.preset.batch_size, (rates[0], rates[1]), rng)
        found = measured(self.network, self._held_out(number))
        progress = {PROGRESS: np.array((number, epoch))}
        save_tensors(self.folder / STATE_FILE, self.learner.state() | progress)
        save_weights(self.folder, self.network.arrays())
        row = {"round": number, "epoch": epoch, "loss": round(loss, 4)}
        row |= {name: round(value, 4) for name, value in found.items() if math.isfinite(value)}
        return row | {"seconds": round(time.process_time() - start, 1)}

    def _driver(self, name: str) -> Agent:
        """An agent that drives while samples are collected, see `HearingRound.drivers`."""
        if name == "scripted":
            return ShownAgent()
        network = GroundingNetwork(self.preset.shape, self.network.arrays())
        return HearingAgent(network, LearnedAgent.load("drive") if name == "policy" else None)

    def _samples(self, number: int) -> Arrays:
        """All samples so far that are still in the folder, except the chunks that are held out."""
        files = [
            self._file(k, chunk)
            for k, each in enumerate(self.preset.rounds[: number + 1])
            for chunk in range(max(1, self._chunks(each) - 1))
        ]
        parts = [_read(path) for path in files if path.exists()]
        return {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}

    def _held_out(self, number: int) -> Arrays:
        last = self._file(number, self._chunks(self.preset.rounds[number]) - 1)
        return {name: values[:MEASURED] for name, values in _read(last).items()}

    def _file(self, number: int, chunk: int) -> Path:
        return self.folder / SAMPLES / f"round{number}-{chunk:04d}.npz"

    @cached_property
    def _split(self) -> tuple[Episode, ...]:
        return tuple(load_episodes(self.preset.split))

    @cached_property
    def _commands(self) -> list[Any]:
        return [episode.meanings()[0].clauses for episode in self._split]

    def _episodes(self, number: int, chunk: int) -> list[Episode]:
        """The episodes of a chunk; a round repeats episodes of another only when none are left."""
        order = np.random.default_rng(self.seed).permutation(len(self._split))
        first = sum(each.episodes for each in self.preset.rounds[:number])
        begin = chunk * self.preset.chunk
        end = min(begin + self.preset.chunk, self.preset.rounds[number].episodes)
        return [self._split[order[(first + k) % len(order)]] for k in range(begin, end)]

    def _resume(self) -> None:
        card = Card.read(self.folder, NetworkShape)
        for name, same in (
            ("preset", _begins(card.preset, self.card.preset)),
            ("seed", card.seed == self.seed),
        ):
            if not same:
                raise ValueError(
                    f"{self.folder} was trained with another {name}; start anew with another --out"
                )
        self.card = replace(card, preset=self.card.preset)
        if (self.folder / STATE_FILE).exists():
            self._resume_state()
        elif (self.folder / WEIGHTS_FILE).exists():
            self.network.load(load_weights(self.folder, self.preset.shape.tensors()))

    def _resume_state(self) -> None:
        """Go on from the saved state, which may be one epoch ahead of the card."""
        tensors = load_tensors(self.folder / STATE_FILE)
        number, epoch = (int(value) for value in tensors.pop(PROGRESS))
        self.learner.load(tensors)
        if not self._has(number, epoch=epoch):
            save_weights(self.folder, self.network.arrays())
            found = measured(self.network, self._held_out(number))
            row = {name: round(value, 4) for name, value in found.items() if math.isfinite(value)}
            self._note({"round": number, "epoch": epoch, **row})


def plain_preset(preset: HearingPreset) -> dict[str, Any]:
    """A preset as plain data for a JSON file."""
    return dict(json.loads(json.dumps(asdict(preset))))


def _begins(before: dict[str, Any], preset: dict[str, Any]) -> bool:
    """Whether a plain preset is another one, or its first rounds."""
    rounds = before.get("rounds", ())
    return before == preset | {"rounds": preset["rounds"][: len(rounds)]}


def _rate(each: HearingRound, epoch: int) -> float:
    """The step size at the beginning of an epoch: half a cosine (Loshchilov and Hutter 2017)."""
    fallen = 0.5 * (1.0 + np.cos(np.pi * epoch / each.epochs))
    return float(each.rate * (LAST_SHARE + (1.0 - LAST_SHARE) * fallen))


def _read(path: Path) -> Arrays:
    with np.load(path) as file:
        return {name: file[name] for name in file.files}
