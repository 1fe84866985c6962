"""`semnav episodes import`: make episodes in maps of real floors."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

from tyro.conf import Positional

from semnav_env.judge.episodes import SPLITS, Episode, write_episodes
from semnav_env.judge.episodes.files import PLAN_SUFFIX
from semnav_env.judge.episodes.generate import TooBareError, generate_episode
from semnav_env.judge.episodes.site import Site
from semnav_env.judge.episodes.splits import FROZEN_SUFFIX, SEED
from semnav_env.world.maps import FloorPlan, load_floor_plan, save_floor_plan
from semnav_env.world.maps.importers.opening import import_map
from semnav_env.world.maps.rules import FloorPlanError
from semnav_scripts.outputs import counted
from semnav_scripts.progress import tracked

SPLIT_NAME = "test_real_floors"

MAX_BARE = 3
"""Number of episodes without a possible command after which a floor is given up."""

NO_CORRIDOR = (
    "has no corridor, and episodes begin in corridors: write the plan with `semnav map import`, "
    "add features of kind corridor (vector maps and lists of walls hold none), and give that file"
)


@dataclass(frozen=True)
class EpisodesImport:
    """Make episodes like those of test_real in maps that are not part of the package.

    A floor in which no episode can be made is left out; the last lines say which floors, and why.

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
        left_out: list[str] = []
        label = f"{{}} of {total} episodes".format
        for episode in tracked(self._made(plans, left_out), label, lambda: len(made) / total):
            made.append(episode)
        if not made:
            raise ValueError(f"no episode could be made; {'; '.join(left_out)}")
        path = self.out / f"{SPLIT_NAME}{FROZEN_SUFFIX}"
        write_episodes(made, path)
        floors = counted(len({episode.floor_plan for episode in made}), "floor")
        print(f"wrote {path}: {counted(len(made), 'episode')} in {floors}")
        print("".join(f"left out: {line}\n" for line in left_out), end="")
        return 0

    def _made(self, plans: list[FloorPlan], left_out: list[str]) -> Iterator[Episode]:
        """The episodes of all plans; missing ones are listed in `left_out`, with the reason."""
        for index, plan in enumerate(plans):
            try:
                yield from self._made_in(plan, index, left_out)
            except FloorPlanError as error:
                left_out.append(str(error))

    def _made_in(self, plan: FloorPlan, index: int, left_out: list[str]) -> Iterator[Episode]:
        if not plan.corridors:
            raise FloorPlanError(f"{plan.name} {NO_CORRIDOR}")
        path = self.out / f"{plan.name}-{index}{PLAN_SUFFIX}"
        save_floor_plan(plan, path)
        site = Site(load_floor_plan(path), path.name, whole=True)
        split = replace(SPLITS["test_real"], name=SPLIT_NAME)
        made = bare = 0
        for k in range(index * self.episodes, (index + 1) * self.episodes):
            try:
                yield generate_episode(site, split, k, self.seed)
                made += 1
            except TooBareError:
                bare += 1
                if bare == MAX_BARE:
                    break
        if made < self.episodes:
            missing = counted(self.episodes - made, "episode")
            left_out.append(f"{missing} in {plan.name}, where too few commands can be carried out")
        if site.unreached:
            names = ", ".join(site.unreached)
            left_out.append(f"what no robot gets into in {plan.name}: {names}")


def _plan(source: Path) -> FloorPlan:
    """A floor plan of the project's own format or of another one."""
    own = source.suffix.lower() == PLAN_SUFFIX
    return load_floor_plan(source) if own else import_map(source).plan
