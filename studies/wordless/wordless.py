"""The listener with its words hidden, in what it learns from and in what it drives by.

It has the network, the samples and the planner of the listener. Every command reads to it as the
same eight tokens, and ways to named rooms are not told. So it cannot know which clause is under
way, nor how many there are: what it achieves is what is learned of offices and of commands in
general (Thomason et al. 2019, "Shifting the Baseline").
"""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from semnav_agents.base import Observation
from semnav_agents.hearing.agent import HearingAgent
from semnav_agents.hearing.collecting import Collector, GroundedGoal, Samples, ShownAgent
from semnav_agents.hearing.learning import Learner
from semnav_agents.hearing.network import NetworkShape
from semnav_agents.hearing.torch_network import TorchGrounding
from semnav_env.env import SemNavEnv
from semnav_env.judge.episodes import Episode
from semnav_env.language import encode, parse
from semnav_env.mind.observations import EntryObservation, Moment
from semnav_env.networks.card import Card
from semnav_env.networks.weights import save_weights

BATCH_SIZE, FIRST_RATE, LAST_RATE = 256, 1.5e-3, 3e-5
"""Samples in a gradient step, and the step size at the beginning and the end."""

MAX_SECONDS = 100.0
"""Time limit of an episode while samples are collected, simulated seconds."""

_CLAUSE = encode(parse("go down the hallway"))[0]
ANY_COMMAND = np.tile(_CLAUSE, 8).astype(np.int16)
"""The tokens that every command reads as: eight times the same clause."""


def without_words(observation: Observation) -> dict[str, NDArray[Any]]:
    """An observation with `observation="command"` in which nothing depends on what was said."""
    hidden = {name: np.zeros_like(observation[name]) for name in observation if "told_" in name}
    return {**observation, **hidden, "command": ANY_COMMAND}


class WordlessObservation(EntryObservation):
    """The entries of `observation="command"` with the words hidden."""

    def observe(self, moment: Moment) -> dict[str, NDArray[Any]]:
        """The entries as fresh arrays."""
        return without_words(super().observe(moment))


class WordlessAgent(HearingAgent):
    """A listener that does not hear."""

    observation = WordlessObservation("command")  # type: ignore[assignment]


class WordlessCollector(Collector):
    """Collects what the scripted agent is led to do, with the words hidden."""

    def __init__(self, seed: int, robot: str) -> None:
        super().__init__((), (seed,), robot, MAX_SECONDS)
        observation = WordlessObservation("command", [GroundedGoal()])
        self.env = SemNavEnv(robot, observation=observation, max_seconds=MAX_SECONDS)

    def _imagine(self, *_: Any) -> None:
        """No other clauses: how often each is said is all that there is to learn of them."""


def train(
    folder: Path, episodes: Sequence[Episode], epochs: int, seed: int, robot: str = "wheelchair"
) -> Iterator[dict[str, float]]:
    """Drive the episodes, learn from them, and write an agent to a folder.

    Yields:
        A row of the curve after the driving and after each epoch; seconds are of processor time.
    """
    start, samples = time.process_time(), Samples()
    collector, driver = WordlessCollector(seed, robot), ShownAgent()
    done = [collector.drive(episode, driver, samples) for episode in episodes]
    arrays = samples.arrays()
    curve = [{"success": float(np.mean(done)), "samples": len(samples.labels)}]
    yield curve[0] | {"seconds": round(time.process_time() - start, 1)}
    shape = NetworkShape()
    network = TorchGrounding(shape, seed)
    learner = Learner(network)
    rates = np.geomspace(FIRST_RATE, LAST_RATE, epochs + 1).tolist()
    for epoch in range(epochs):
        rng = np.random.default_rng((seed, epoch))
        loss = learner.epoch(arrays, BATCH_SIZE, (rates[epoch], rates[epoch + 1]), rng)
        curve.append({"epoch": epoch, "loss": round(loss, 4)})
        yield curve[-1] | {"seconds": round(time.process_time() - start, 1)}
    save_weights(folder, network.arrays())
    said = {"name": "wordless", "robot": robot, "episodes": len(episodes), "epochs": epochs}
    Card(shape, said, seed, curve=curve).write(folder)
