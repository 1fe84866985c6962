"""`semnav episodes import`: make episodes in maps of real floors."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

from tyro.conf import Positional

from semnav_env.episodes import SPLITS, Episode, write_episodes
from semnav_env.episodes.files import PLAN_SUFFIX
from semnav_env.episodes.generate import Site, generate_episode
from semnav_env.episodes.splits import FROZEN_SUFFIX, SEED
from semnav_env.maps import FloorPlan, load_floor_plan, save_floor_plan
from semnav_env.maps.importers.opening import import_map
from semnav_env.scripts.progress import tracked

SPLIT_NAME = "test_real_floors"


@dataclass(frozen=True)
class EpisodesImport:
    """Make episodes like those of test_real in maps that are not part of the package.

    Attributes:
        maps: floor plans (.geojson), or files as `semnav map import` reads them.
        out: folder for the floor plans and the file of episodes.
        episodes: number of episodes in each map.
        seed: of the episodes.
    """

    maps: Positional[tuple[Path, ...]]
    out: Path = Path("episodes")
    episodes: int = 100
    seed: int = SEED

    def run(self) -> int:
        """Import every map, and write the episodes of all maps to one file."""
        if not self.maps or self.episodes < 1 or self.seed < 0:
            raise ValueError("give at least one map, --episodes at least 1 and --seed at least 0")
        plans = [_plan(source) for source in self.maps]
        total = len(self.maps) * self.episodes
        made: list[Episode] = []
        label = f"{{}} of {total} episodes".format
        for episode in tracked(self._made(plans), label, lambda: len(made) / total):
            made.append(episode)
        path = self.out / f"{SPLIT_NAME}{FROZEN_SUFFIX}"
        write_episodes(made, path)
        print(f"wrote {path}: {len(made)} episodes in {len(self.maps)} floors")
        return 0

    def _made(self, plans: list[FloorPlan]) -> Iterator[Episode]:
        split = replace(SPLITS["test_real"], name=SPLIT_NAME)
        for index, plan in enumerate(plans):
            path = self.out / f"{plan.name}-{index}{PLAN_SUFFIX}"
            save_floor_plan(plan, path)
            site = Site(load_floor_plan(path), path.name)
            for k in range(self.episodes):
                yield generate_episode(site, split, index * self.episodes + k, self.seed)


def _plan(source: Path) -> FloorPlan:
    """A floor plan of the project's own format or of another one."""
    own = source.suffix.lower() == PLAN_SUFFIX
    return load_floor_plan(source) if own else import_map(source).plan
