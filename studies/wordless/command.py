"""`python -m studies wordless`: train the listener without its words, and drive with it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np
import torch

from semnav_agents.evaluation import run_suite
from semnav_agents.evaluation.provenance import provenance
from semnav_env.judge.episodes import evenly, load_episodes
from semnav_env.networks.card import CARD_FILE
from semnav_scripts.jsonl import JsonLines
from studies.wordless.wordless import WordlessAgent, train


@dataclass(frozen=True)
class Arguments:
    """Train on episodes of `train`, then drive evenly spaced ones of a split, with both bodies.

    Attributes:
        out: folder of the agent, and of a file of results for each body, as `semnav evaluate --out`
            writes them. An agent that is there already is not trained again.
        episodes: of `train` that are learned from.
        epochs: passes over their samples.
        split: on which it is measured.
        measured: number of episodes there.
        robots: bodies that drive them.
        seed: of weights, episodes, samples and their order.
    """

    out: Path
    episodes: int = 600
    epochs: int = 60
    split: str = "val_unseen"
    measured: int = 100
    robots: tuple[str, ...] = ("wheelchair", "spot")
    seed: int = 0

    def run(self) -> int:
        """Train, drive and count."""
        torch.set_num_threads(1)
        self.out.mkdir(parents=True, exist_ok=True)
        if not (self.out / CARD_FILE).exists():
            found = load_episodes("train")
            order = np.random.default_rng(self.seed).permutation(len(found))[: self.episodes]
            for row in train(self.out, [found[k] for k in order], self.epochs, self.seed):
                print(row, flush=True)
        agent = partial(WordlessAgent.load, self.out)
        for robot in self.robots:
            self._drive(agent, robot)
        return 0

    def _drive(self, agent: partial[WordlessAgent], robot: str) -> None:
        who = {"agent": "wordless", "training_seed": self.seed, "split": self.split, "robot": robot}
        who |= provenance().row()
        done = []
        with JsonLines(self.out / f"wordless.{self.split}.{robot}.jsonl") as file:
            for result in run_suite(evenly(load_episodes(self.split), self.measured), agent, robot):
                file.write(who | result.row())
                done.append(result.success)
        print(f"{self.split}, {robot}: {np.mean(done):.3f} of {len(done)} succeed", flush=True)
