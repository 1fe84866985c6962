"""`python -m studies learning`: five ways of learning, compared by steps of the environment."""

from __future__ import annotations

import importlib
import json
import time
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import torch

from semnav_agents.evaluation.provenance import provenance
from semnav_env.judge.episodes import evenly, load_episodes
from semnav_features.writing import write_file
from studies.learning.command_envs import ROBOT, measured
from studies.learning.demonstrations import demonstrations
from studies.learning.progress import Learned

METHODS = ("ppo", "recurrent_ppo", "cloning", "cloning_ppo", "dagger")
"""Modules of this folder with a function `train`."""

SHOWN = {"cloning", "cloning_ppo", "dagger"}
"""Those that learn from demonstrations, which are driven before, once for all."""


@dataclass(frozen=True)
class Arguments:
    """Train with each method and seed, and measure the policies on episodes of a split.

    A training that has its rows already is not made again, so an interrupted study goes on.

    Attributes:
        out: folder of rows, METHOD-SEED.jsonl, of the demonstrations and of cloned policies.
        methods: ways of learning.
        seeds: of weights, episodes and noise.
        steps: of the environment for each training, demonstrations included; by default 24
            updates of PPO, of 32 robots with 128 decisions of 3 steps each.
        split: on which policies are measured.
        measured: number of evenly spaced episodes there.
    """

    out: Path
    methods: tuple[str, ...] = METHODS
    seeds: tuple[int, ...] = (0, 1, 2)
    steps: int = 294_912
    split: str = "val_unseen"
    measured: int = 100

    def run(self) -> int:
        """Train and measure."""
        if unknown := set(self.methods) - set(METHODS):
            raise ValueError(f"no method {unknown.pop()!r}; there are: {', '.join(METHODS)}")
        torch.set_num_threads(1)
        self.out.mkdir(parents=True, exist_ok=True)
        if set(self.methods) & SHOWN:
            demonstrations(self.steps, self.out)
        for seed in self.seeds:
            for method in self.methods:
                file = self.out / f"{method}-{seed}.jsonl"
                if not file.exists():
                    rows = list(self._rows(method, seed))
                    write_file(file, "".join(json.dumps(row) + "\n" for row in rows).encode())
        return 0

    def _rows(self, method: str, seed: int) -> Iterator[dict[str, Any]]:
        """A row for each policy on the way."""
        train = importlib.import_module(f"studies.learning.{method}").train
        who = {"method": method, "seed": seed, "robot": ROBOT, "split": self.split}
        who |= provenance().row()
        start, apart = time.process_time(), 0.0
        for learned in train(seed, self.steps, self.out):
            before = time.process_time()
            row = who | {"steps": learned.steps, "cpu_seconds": round(before - start - apart, 1)}
            row |= self._measured(learned)
            apart += time.process_time() - before
            print({name: row[name] for name in _PRINTED}, flush=True)
            yield row

    def _measured(self, learned: Learned) -> dict[str, Any]:
        """Means over the episodes, by clauses, and the episodes that succeed."""
        rows = list(measured(learned.decide, evenly(load_episodes(self.split), self.measured)))
        by_clauses = defaultdict(list)
        for row in rows:
            by_clauses[row["clauses"]].append(row["success"])
        means = {name: _mean([row[name] for row in rows]) for name in _MEANS}
        return {
            "n": len(rows),
            **means,
            "success_by_clauses": {str(k): _mean(by_clauses[k]) for k in sorted(by_clauses)},
            "succeeded": sorted(row["episode"] for row in rows if row["success"]),
        }


_MEANS = ("success", "contact_free", "spl")
_PRINTED = ("method", "seed", "steps", "cpu_seconds", *_MEANS)


def _mean(values: list[Any]) -> float:
    return round(float(np.mean(values)), 4)
