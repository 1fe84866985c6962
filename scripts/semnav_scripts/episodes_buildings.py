"""`semnav episodes buildings`: make the real-building benchmark from the user's own plans."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import groupby
from pathlib import Path

from semnav_env.judge.episodes import Episode, write_episodes
from semnav_env.judge.episodes.buildings import (
    EPISODES_PER_BUILDING,
    SPLIT_NAMES,
    RealFloor,
    benchmark_floors,
    episodes_of,
    fault_of,
)
from semnav_env.judge.episodes.splits import FROZEN_SUFFIX, SEED
from semnav_features.writing import write_file
from semnav_scripts.outputs import counted
from semnav_scripts.progress import tracked

REPORT = "real_drawn.json"
"""File with the numbers of commands that were kept and dropped, beside the episodes."""


@dataclass
class SplitTally:
    """What was made of one split.

    Attributes:
        episodes: the episodes.
        floors: number of floors.
        counts: by building, what became of the first command of each episode ("kept", or the
            cause that dropped it, see `StableAnswers`), and how many were "drawn" in all.
    """

    episodes: list[Episode] = field(default_factory=list)
    floors: int = 0
    counts: dict[str, Counter[str]] = field(default_factory=dict)

    @property
    def total(self) -> Counter[str]:
        """The counts of all buildings."""
        return sum(self.counts.values(), Counter())

    def __str__(self) -> str:
        """Numbers of episodes and floors, and how many commands were kept."""
        total = self.total
        first = total.total() - total["drawn"]
        made = counted(len(self.episodes), "episode")
        where = f"{counted(self.floors, 'floor')} of {counted(len(self.counts), 'building')}"
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

    The plans are your own copies. Those of the benchmark are recognised by their fingerprints; the
    split real_drawn_tune is to tune on, real_drawn_test to test on, and floors of further buildings
    make real_drawn_other. A command whose right answer changes if walls move by 3 cm, the start by
    0.1 m and 5 degrees, or the limits of doors and openings by 0.1 m is dropped and counted.

    Attributes:
        kth: folders with floors of the KTH data set, BUILDING/FLOOR.xml.
        osm: buildings of OpenStreetMap with indoor tags, BUILDING.osm.
        out: folder for the floor plans, the episodes of each split, and real_drawn.json, which says
            how many commands were kept and dropped in each building.
        seed: of the episodes.
    """

    kth: tuple[Path, ...] = ()
    osm: tuple[Path, ...] = ()
    out: Path = Path("real_buildings")
    seed: int = SEED

    def run(self) -> int:
        """Write the floor plans, one file of episodes for each split, and the numbers."""
        if self.seed < 0 or not (self.kth or self.osm):
            raise ValueError("give a folder after --kth or a file after --osm; --seed at least 0")
        if strange := [path for path in self.osm if path.suffix != ".osm"]:
            raise ValueError(f"{strange[0]}: no .osm file, as --osm needs")
        floors = benchmark_floors((*self.kth, *self.osm))
        of_split = {split: SplitTally() for split in SPLIT_NAMES}
        left_out: list[str] = []
        buildings = len({floor.building for floor, _ in floors})
        done = Counter[str]()
        label = f"{{}} of {buildings} buildings".format
        for split, building, tally in tracked(
            self._made(floors, of_split, left_out), label, lambda: done.total() / buildings
        ):
            done[building] += 1
            of_split[split] = tally
        self._write(of_split)
        print("".join(f"left out: {line}\n" for line in left_out), end="")
        return 0

    def _made(
        self,
        floors: tuple[tuple[RealFloor, str], ...],
        of_split: dict[str, SplitTally],
        left_out: list[str],
    ) -> Iterator[tuple[str, str, SplitTally]]:
        """The tally of a split after each of its buildings."""
        for building, of_one in groupby(floors, lambda each: each[0].building):
            sites = []
            for floor, split in of_one:
                site = floor.save(self.out)
                fault = fault_of(floor, split, site.plan)
                if fault is None:
                    sites.append(site)
                else:
                    left_out.append(fault)
            tally = of_split[split]
            counts = tally.counts.setdefault(building, Counter())
            tally.floors += len(sites)
            number = len(tally.counts) - 1
            made = 0
            for episode, fair in episodes_of(number, sites, split, self.seed) if sites else ():
                counts[fair.first] += 1
                counts["drawn"] += fair.drawn
                if episode is not None:
                    tally.episodes.append(episode)
                    made += 1
            missing = EPISODES_PER_BUILDING - made
            if missing:
                left_out.append(f"{counted(missing, 'episode')} in {building}")
            yield split, building, tally

    def _write(self, of_split: dict[str, SplitTally]) -> None:
        made = {split: tally for split, tally in of_split.items() if tally.episodes}
        for split, tally in made.items():
            path = self.out / f"{split}{FROZEN_SUFFIX}"
            write_episodes(tally.episodes, path)
            print(f"wrote {path}: {tally}")
        numbers = {
            split: {"episodes": len(tally.episodes), "commands": tally.counts}
            for split, tally in made.items()
        }
        write_file(self.out / REPORT, (json.dumps(numbers, indent=1) + "\n").encode())
