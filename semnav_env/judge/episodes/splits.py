"""Splits of the frozen episodes: numbers of episodes, buildings and clauses."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from importlib.resources import as_file, files
from pathlib import Path

from semnav_env.judge.episodes.episode import Episode, Expected
from semnav_env.judge.episodes.files import read_episodes
from semnav_env.language.vocabulary.typos import did_you_mean
from semnav_env.world.maps.generator.distributions import DISTRIBUTIONS
from semnav_env.world.maps.generator.naming import office_name

FROZEN_FOLDER = files("semnav_env.judge.episodes") / "frozen"
"""Folder of the frozen episodes in the package."""

FROZEN_SUFFIX = ".jsonl.gz"
"""Ending of the names of the frozen files."""


SEED = 2026
"""Seed that the frozen episodes are made from."""


@dataclass(frozen=True)
class Split:
    """A set of episodes for one purpose.

    Attributes:
        name: name of the split.
        about: its purpose, in a few words.
        episodes: number of episodes.
        buildings: number of floor plans, each with the same number of episodes.
        clauses: numbers of clauses of a command; each, with each topic, is equally frequent.
        first: seed of the first office; None for the plan that `plan` names.
        plan: a bundled plan instead of generated ones.
        expected: the right answer to its commands.
    """

    name: str
    about: str
    episodes: int
    buildings: int
    clauses: tuple[int, ...]
    first: int | None
    plan: str = ""
    expected: Expected = Expected.FEASIBLE

    def floor_plan(self, number: int) -> str:
        """The name of the floor plan of an episode; the distributions are used in turn."""
        if self.first is None:
            return self.plan
        office = number * self.buildings // self.episodes
        kinds = tuple(DISTRIBUTIONS)
        return office_name(kinds[office % len(kinds)], self.first + office)


TRAIN_SEED, UNSEEN_SEED, LONG_SEED, ASK_SEED, HOPELESS_SEED = (k * 1_000_000 for k in range(1, 6))
"""Seeds of the first offices of the splits, so far apart that only val_seen shares
its offices, with train."""

SPLITS = {
    split.name: split
    for split in (
        Split("train", "to learn from", 6000, 120, (1, 2, 3), TRAIN_SEED),
        Split("val_seen", "other episodes in offices of train", 800, 40, (1, 2, 3), TRAIN_SEED),
        Split("val_unseen", "in other offices", 1200, 48, (1, 2, 3), UNSEEN_SEED),
        Split("test_long", "three to six clauses", 1000, 40, (3, 4, 5, 6), LONG_SEED),
        Split(
            "test_real",
            "in a hallway that was measured",
            200,
            1,
            (1, 2, 3),
            None,
            "heidelberg_hallway",
        ),
        Split(
            "test_ambiguous",
            "what can mean several things",
            400,
            20,
            (1, 2, 3),
            ASK_SEED,
            expected=Expected.AMBIGUOUS,
        ),
        Split(
            "test_infeasible",
            "what cannot be done there",
            400,
            20,
            (1, 2, 3),
            HOPELESS_SEED,
            expected=Expected.INFEASIBLE,
        ),
    )
}
"""The splits by their names."""


def load_episodes(name: str | Path) -> tuple[Episode, ...]:
    """The frozen episodes of a split, or those of a file.

    Raises:
        ValueError: no such split; lists those there are.
        EpisodeFileError: the file is not a file of episodes.
    """
    if isinstance(name, str) and name in SPLITS:
        return _frozen(name)
    if is_episodes(name):
        return read_episodes(name)
    raise ValueError(
        f"no split {name!r:.80}; there are: {', '.join(SPLITS)}, or the path of a .jsonl or "
        f".jsonl.gz file{did_you_mean(str(name), SPLITS)}"
    )


def find_episode(name: str) -> Episode:
    """The frozen episode of an id, such as "val_unseen-00246".

    Args:
        name: the id in a split, or FILE:ID for an episode of a file.

    Raises:
        ValueError: no such split or episode; names those there are.
        EpisodeFileError: the file is none of episodes.
    """
    file, _, wanted = name.rpartition(":")
    split = wanted.rpartition("-")[0]
    episodes = {each.id: each for each in load_episodes(file or split or wanted)}
    if wanted not in episodes:
        first, *_, last = (*episodes, *episodes)
        raise ValueError(f"no episode {wanted!r:.80}; there are: {first} to {last}")
    return episodes[wanted]


def is_episodes(name: str | Path) -> bool:
    """Whether a name is that of a split, or may be the path of a file of episodes."""
    return isinstance(name, Path) or name in SPLITS or name.endswith((".jsonl", ".gz"))


def evenly(episodes: Sequence[Episode], count: int) -> tuple[Episode, ...]:
    """Choose a number of episodes spread evenly over a split; all of them if there are fewer."""
    count = min(count, len(episodes))
    return tuple(episodes[k * len(episodes) // count] for k in range(count))


@lru_cache(maxsize=len(SPLITS))
def _frozen(name: str) -> tuple[Episode, ...]:
    with as_file(FROZEN_FOLDER / f"{name}{FROZEN_SUFFIX}") as path:
        return read_episodes(path)
