"""`semnav episodes`: list, check, generate and import episodes, also in real buildings."""

from __future__ import annotations

import json
import multiprocessing
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from tyro.conf import Positional, subcommand

from semnav_env.judge.episodes import SPLITS, Episode, Split, load_episodes, write_episodes
from semnav_env.judge.episodes.check import faults
from semnav_env.judge.episodes.generate import generate_split
from semnav_env.judge.episodes.splits import FROZEN_SUFFIX, SEED
from semnav_env.language.vocabulary.typos import did_you_mean
from semnav_features.interruption import for_this_process_alone
from semnav_scripts.episodes_buildings import EpisodesBuildings
from semnav_scripts.episodes_import import EpisodesImport
from semnav_scripts.progress import tracked


@dataclass(frozen=True)
class EpisodesList:
    """Print the splits.

    Attributes:
        json: print JSON.
    """

    json: bool = False

    def run(self) -> int:
        """Print one line for each split."""
        if self.json:
            rows = ({"name": s.name, "episodes": s.episodes} for s in SPLITS.values())
            print(json.dumps(list(rows)))
            return 0
        for split in SPLITS.values():
            clauses = "-".join(str(n) for n in sorted({split.clauses[0], split.clauses[-1]}))
            where = split.plan or f"{split.buildings} offices"
            print(f"{split.name:<16}{split.episodes:>5}  {clauses} clauses, {where}: {split.about}")
        print(f"{'in all':<16}{sum(s.episodes for s in SPLITS.values()):>5}")
        return 0


@dataclass(frozen=True)
class EpisodesGenerate:
    """Generate episodes; the same seed gives the same ones with any number of processes.

    Attributes:
        splits: names of splits; all if none is named.
        out: folder for the files, one for each split.
        seed: of the episodes; that of the frozen ones if not given.
        workers: number of processes.
    """

    splits: Positional[tuple[str, ...]] = ()
    out: Path = Path("episodes")
    seed: int = SEED
    workers: int = 1

    def run(self) -> int:
        """Write a file for each split."""
        if self.seed < 0 or self.workers < 1:
            raise ValueError("--seed must be at least 0 and --workers at least 1")
        for split in _chosen(self.splits):
            made = self._made(split)
            path = self.out / f"{split.name}{FROZEN_SUFFIX}"
            write_episodes(made, path)
            print(f"wrote {path}: {len(made)} episodes, {path.stat().st_size / 1e3:.0f} kB")
        return 0

    def _made(self, split: Split) -> list[Episode]:
        made: list[Episode] = []
        pieces = self._pieces(split)
        label = f"{split.name}: {{}} buildings"
        for piece in tracked(pieces, label.format, lambda: len(made) / split.episodes):
            made.extend(piece)
        return made

    def _pieces(self, split: Split) -> Iterator[list[Episode]]:
        """The episodes of one building after the other."""
        each = split.episodes // split.buildings
        jobs = [(split, self.seed, k * each) for k in range(split.buildings)]
        if self.workers == 1:
            yield from map(_piece, jobs)
            return
        with for_this_process_alone():
            pool = multiprocessing.get_context("spawn").Pool(self.workers)
        with pool:
            yield from pool.imap(_piece, jobs)


@dataclass(frozen=True)
class EpisodesCheck:
    """Check episodes again; the exit code is 1 if one has a fault.

    Attributes:
        splits: names of splits or paths of files; all splits if none is named.
        stride: check only every Nth episode.
        json: print JSON.
    """

    splits: Positional[tuple[str, ...]] = ()
    stride: int = 1
    json: bool = False

    def run(self) -> int:
        """Check, and print every fault and the number of faults."""
        if self.stride < 1:
            raise ValueError(f"--stride is {self.stride}; it must be at least 1")
        checked, found = 0, list[str]()
        for name in self.splits or tuple(SPLITS):
            problems = self._problems(name)
            checked += len(problems)
            found += [problem for some in problems for problem in some]
        if self.json:
            print(json.dumps({"checked": checked, "faults": found}))
        else:
            print("\n".join([*found, f"{checked} episodes checked, {len(found)} faults"]))
        return 1 if found else 0

    def _problems(self, name: str) -> list[tuple[str, ...]]:
        episodes = load_episodes(name)[:: self.stride]
        problems: list[tuple[str, ...]] = []
        for _, some in tracked(
            faults(episodes),
            lambda n: f"{name}: {n} episodes",
            lambda: len(problems) / len(episodes),
        ):
            problems.append(some)
        return problems


def _piece(job: tuple[Split, int, int]) -> list[Episode]:
    split, seed, first = job
    return list(generate_split(split, seed, first, first + split.episodes // split.buildings))


def _chosen(names: tuple[str, ...]) -> list[Split]:
    for name in names:
        if name not in SPLITS:
            hint = did_you_mean(name, SPLITS)
            raise ValueError(f"no split {name!r:.80}; there are: {', '.join(SPLITS)}{hint}")
    return [SPLITS[name] for name in names or SPLITS]


Arguments = (
    Annotated[EpisodesList, subcommand("list")]
    | Annotated[EpisodesCheck, subcommand("check")]
    | Annotated[EpisodesGenerate, subcommand("generate")]
    | Annotated[EpisodesImport, subcommand("import")]
    | Annotated[EpisodesBuildings, subcommand("buildings")]
)
