"""`semnav episodes buildings`: make the real-building benchmark from the user's own plans."""

from __future__ import annotations

import json
from collections import Counter, defaultdict
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import groupby
from pathlib import Path

from semnav_env.judge.episodes import Episode, write_episodes
from semnav_env.judge.episodes.buildings import (
    EPISODES_PER_GROUP,
    FAMILIES,
    RealFloor,
    benchmark_floors,
    episodes_of,
    fault_of,
)
from semnav_env.judge.episodes.site import Site
from semnav_env.judge.episodes.splits import FROZEN_SUFFIX, SEED
from semnav_features.writing import write_file
from semnav_scripts.outputs import counted
from semnav_scripts.progress import tracked


@dataclass
class SplitTally:
    """What was made of one split.

    Attributes:
        episodes: the episodes.
        floors: number of floors with episodes.
        counts: by `RealFloor.group`, what became of the first command of each episode ("kept", or
            the cause that dropped it, see `StableAnswers`), and how many were "drawn" in all.
    """

    episodes: list[Episode] = field(default_factory=list)
    floors: int = 0
    counts: dict[str, Counter[str]] = field(default_factory=dict)

    @property
    def total(self) -> Counter[str]:
        """The counts of all groups."""
        return sum(self.counts.values(), Counter())

    def __str__(self) -> str:
        """Numbers of episodes and floors, and how many commands were kept."""
        total = self.total
        first = total.total() - total["drawn"]
        made = counted(len(self.episodes), "episode")
        buildings = {group.partition("/")[0] for group in self.counts}
        where = f"{counted(self.floors, 'floor')} of {counted(len(buildings), 'building')}"
        causes = ", ".join(
            f"{total[cause]} by {words}" for cause, words in CAUSES.items() if total[cause]
        )
        kept = f"kept {total['kept']} of {first} first commands"
        dropped = f", dropped {causes}" if causes else ""
        return f"{made} in {where}; {kept}{dropped}; drew {total['drawn']} in all"


CAUSES = {"walls": "moved walls", "start": "another start", "limits": "other limits of widths"}
"""What may change the answer to a command, in words."""


@dataclass(frozen=True)
class EpisodesBuildings:
    """Make the benchmark of real buildings, of which the project holds no plans.

    The plans are your own copies. Those of the benchmark are recognised by their names and checked
    by their fingerprints. Of drawn floors the split real_drawn_tune is to tune on, real_drawn_test
    to test on, and floors of further buildings make real_drawn_other. Of floors that a robot mapped
    real_mapped_tune is to tune on, and real_mapped has all others. A command whose right answer
    changes if walls move by 3 cm, the start by 0.1 m and 5 degrees, or the limits of doors and
    openings by 0.1 m is dropped and counted.

    Attributes:
        kth: folders with floors of the KTH data set, BUILDING/FLOOR.xml.
        osm: buildings of OpenStreetMap with indoor tags, BUILDING.osm.
        gdc: folders with floors that a robot mapped, FLOOR/FLOOR.yaml of ROS's map_server, with
            doors.yaml and locations.yaml beside it, as those of the Gates Dell Complex.
        out: folder for the floor plans, the episodes of each split, and real_drawn.json and
            real_mapped.json, which say how many commands were kept and dropped in each building, or
            on each mapped floor.
        seed: of the episodes.
    """

    kth: tuple[Path, ...] = ()
    osm: tuple[Path, ...] = ()
    gdc: tuple[Path, ...] = ()
    out: Path = Path("real_buildings")
    seed: int = SEED

    def run(self) -> int:
        """Write the floor plans, one file of episodes for each split, and the numbers."""
        if self.seed < 0 or not (self.kth or self.osm or self.gdc):
            raise ValueError(
                "give a folder after --kth or --gdc, or a file after --osm; --seed at least 0"
            )
        if strange := [path for path in self.osm if path.suffix != ".osm"]:
            raise ValueError(f"{strange[0]}: no .osm file, as --osm needs")
        floors = benchmark_floors((*self.kth, *self.osm), self.gdc)
        of_split: dict[str, SplitTally] = defaultdict(SplitTally)
        left_out: list[str] = []
        groups = len({floor.group for floor, _ in floors})
        done: list[str] = []
        label = f"{{}} of {groups} buildings or mapped floors".format
        for group in tracked(
            self._made(floors, of_split, left_out), label, lambda: len(done) / groups
        ):
            done.append(group)
        self._write(of_split)
        print("".join(f"left out: {line}\n" for line in left_out), end="")
        return 0

    def _made(
        self,
        floors: tuple[tuple[RealFloor, str], ...],
        of_split: dict[str, SplitTally],
        left_out: list[str],
    ) -> Iterator[str]:
        """The name of each group after its episodes were added to the tally of its split."""
        for group, of_one in groupby(floors, lambda each: each[0].group):
            sites = []
            for floor, split in of_one:
                site = floor.save(self.out)
                fault = fault_of(floor, split, site.plan)
                if fault is None:
                    sites.append(site)
                else:
                    left_out.append(fault)
            left_out += self._add(group, sites, split, of_split[split])
            yield group

    def _add(self, group: str, sites: list[Site], split: str, tally: SplitTally) -> Iterator[str]:
        """Add the episodes of a group to the tally of its split; yield what is left out."""
        number = len(tally.counts)
        counts = tally.counts.setdefault(group, Counter())
        made = []
        for episode, fair in episodes_of(number, sites, split, self.seed) if sites else ():
            counts[fair.first] += 1
            counts["drawn"] += fair.drawn
            if episode is not None:
                made.append(episode)
        tally.episodes += made
        there = {episode.floor_plan for episode in made}
        tally.floors += len(there)
        for site in sites:
            if site.name not in there:
                yield f"{Path(site.name).stem}: gives no command"
        missing = EPISODES_PER_GROUP - len(made)
        if missing:
            yield f"{counted(missing, 'episode')} in {group}"

    def _write(self, of_split: dict[str, SplitTally]) -> None:
        for family, splits in FAMILIES.items():
            made = {split: of_split[split] for split in splits if of_split[split].episodes}
            for split, tally in made.items():
                path = self.out / f"{split}{FROZEN_SUFFIX}"
                write_episodes(tally.episodes, path)
                print(f"wrote {path}: {tally}")
            numbers = {
                split: {"episodes": len(tally.episodes), "commands": tally.counts}
                for split, tally in made.items()
            }
            if made:
                text = json.dumps(numbers, indent=1) + "\n"
                write_file(self.out / f"{family}.json", text.encode())
