"""The commands on real floors that an episode would have if none were dropped."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import groupby
from pathlib import Path

from semnav_env.judge.episodes.buildings import EPISODES_PER_GROUP, benchmark_floors
from semnav_env.judge.episodes.generate import TooBareError, generate_episode
from semnav_env.judge.episodes.splits import SEED, SPLITS
from semnav_env.language import Command
from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_features.frames import Pose


@dataclass(frozen=True)
class FirstCommand:
    """A command on a floor.

    Attributes:
        plan: the floor.
        command: what is said.
        start: where, world frame.
    """

    plan: FloorPlan
    command: Command
    start: Pose


def first_commands(kth: Path, split: str, folder: Path) -> Iterator[FirstCommand]:
    """The first command of each episode of a split of `semnav episodes buildings`.

    Args:
        kth: folder of the buildings.
        split: name of the split.
        folder: where the plans are written to.
    """
    wanted = replace(SPLITS["test_real"], name=split)
    floors = [floor for floor, its_split in benchmark_floors([kth]) if its_split == split]
    for group, (_, of_one) in enumerate(groupby(floors, lambda floor: floor.group)):
        sites = [floor.save(folder) for floor in of_one]
        for k in range(EPISODES_PER_GROUP):
            site = sites[k * len(sites) // EPISODES_PER_GROUP]
            number = group * EPISODES_PER_GROUP + k
            try:
                episode = generate_episode(site, wanted, number, SEED)
            except TooBareError:
                continue
            yield FirstCommand(site.plan, episode.meanings()[0], episode.start)
