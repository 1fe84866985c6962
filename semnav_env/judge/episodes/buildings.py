"""The real-building benchmark: floors that the user has, drawn or mapped, and their splits.

The project holds the names and the fingerprints of the floors, and the seed of their episodes, but
no plans: the makers of the drawn ones state no licence.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from importlib.resources import files
from itertools import groupby
from pathlib import Path

import shapely

from semnav_env.judge.episodes.episode import Episode
from semnav_env.judge.episodes.fingerprint import fingerprint
from semnav_env.judge.episodes.generate import TooBareError, generate_episode
from semnav_env.judge.episodes.site import Site
from semnav_env.judge.episodes.splits import SEED, SPLITS
from semnav_env.judge.episodes.stable_answers import StableAnswers
from semnav_env.language import Command
from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_env.world.maps.importers import Drawing, import_map
from semnav_env.world.maps.importers.osm import OsmBuilding
from semnav_env.world.maps.library import load_floor_plan
from semnav_env.world.maps.rules import FloorPlanError
from semnav_env.world.maps.writer import save_floor_plan
from semnav_features.frames import Pose
from semnav_features.rules import DoorRules

TUNE, TEST, OTHER = "real_drawn_tune", "real_drawn_test", "real_drawn_other"
"""Splits of drawn floors: buildings to tune on, buildings to test on, and buildings that the
project has no fingerprint of."""

MAPPED_TUNE, MAPPED = "real_mapped_tune", "real_mapped"
"""Splits of floors that a robot mapped: floors to tune on, and all others, which are to test on."""

FAMILIES = {"real_drawn": (TUNE, TEST, OTHER), "real_mapped": (MAPPED_TUNE, MAPPED)}
"""The splits of drawn and of mapped floors, by the name of the file that lists their floors."""

EPISODES_PER_GROUP = 15
"""Number of episodes in each drawn building, and on each mapped floor, see `RealFloor.group`."""

MAPPED_BUILDING = "gdc"
"""Name of the building whose floors a robot mapped."""

FLOORS_PER_BUILDING = 3
"""Largest number of floors of a building: floors above each other are alike."""

LEAST_CORRIDOR_DOORS = 8
"""A floor with fewer doors at its corridors has too few things that a command can name."""

AT_CORRIDOR = 0.1
"""Distance from a corridor within which a door is the corridor's, metres."""

LISTED_FOLDER = files("semnav_env.judge.episodes") / "frozen"
"""Folder with a file for each of `FAMILIES`: for each split the floors, as BUILDING/FLOOR, with the
fingerprints of their plans."""


@dataclass(frozen=True)
class RealFloor:
    """A floor of a real building.

    Attributes:
        building: name of the building.
        path: file of its plan.
        level: the floor, in the file of a whole building.
    """

    building: str
    path: Path
    level: str | None = None

    @property
    def mapped(self) -> bool:
        """Whether a robot mapped it; else somebody drew it."""
        return self.path.suffix == ".yaml"

    @property
    def name(self) -> str:
        """BUILDING/FLOOR."""
        return f"{self.building}/{self.path.stem if self.level is None else self.level}"

    @property
    def group(self) -> str:
        """Name of what has `EPISODES_PER_GROUP` episodes: the building, or a mapped floor alone.

        Drawn floors above each other are alike; the mapped ones differ as buildings do.
        """
        return self.name if self.mapped else self.building

    def plan(self) -> FloorPlan:
        """Its plan.

        Raises:
            FloorPlanError: it cannot be read.
        """
        return import_map(self.path, drawing=Drawing(level=self.level)).plan

    def save(self, folder: Path) -> Site:
        """Import its plan and write it into a folder; the site for its episodes.

        Raises:
            FloorPlanError: it cannot be read.
        """
        file = folder / f"{self.name.replace('/', '-')}.geojson"
        save_floor_plan(self.plan(), file)
        return Site(load_floor_plan(file), file.name, whole=True)


@lru_cache(maxsize=1)
def listed_floors() -> Mapping[str, Mapping[str, str]]:
    """By split: the fingerprints of the benchmark's floors by their names."""
    found: dict[str, dict[str, str]] = {}
    for family in FAMILIES:
        found |= json.loads((LISTED_FOLDER / f"{family}.json").read_text())
    return found


def split_of(floor: RealFloor) -> str:
    """The split of a floor: that of its building if it is drawn, its own if it is mapped.

    It is `OTHER`, or `MAPPED`, if it is not listed.
    """
    if floor.mapped:
        return MAPPED_TUNE if floor.name in listed_floors()[MAPPED_TUNE] else MAPPED
    for split in (TUNE, TEST):
        if any(name.partition("/")[0] == floor.building for name in listed_floors()[split]):
            return split
    return OTHER


def floors_in(places: Sequence[Path]) -> tuple[RealFloor, ...]:
    """The floors in folders with BUILDING/FLOOR.xml, and in files BUILDING.osm, sorted.

    Raises:
        FloorPlanError: a folder has none, or a file cannot be read.
    """
    found: list[RealFloor] = []
    for place in places:
        found += _levels_of(place) if place.suffix == ".osm" else _floors_of(place)
    return tuple(sorted(found, key=lambda floor: floor.name))


def _levels_of(path: Path) -> Iterator[RealFloor]:
    for level in OsmBuilding(path).levels:
        yield RealFloor(path.stem, path, level)


def _floors_of(folder: Path) -> Iterator[RealFloor]:
    paths = sorted(folder.rglob("*.xml"), key=lambda path: (path.parent.name, path.name))
    if not paths:
        raise FloorPlanError(f"{folder}: holds no BUILDING/FLOOR.xml of the KTH data set")
    for path in paths:
        yield RealFloor(path.parent.name, path)


def mapped_floors(folders: Sequence[Path]) -> tuple[RealFloor, ...]:
    """The mapped floors in folders with FLOOR/FLOOR.yaml, sorted.

    Raises:
        FloorPlanError: a folder has none.
    """
    found: list[RealFloor] = []
    for folder in folders:
        paths = [path for path in folder.glob("*/*.yaml") if path.stem == path.parent.name]
        if not paths:
            raise FloorPlanError(f"{folder}: holds no map of a floor, FLOOR/FLOOR.yaml")
        found += [RealFloor(MAPPED_BUILDING, path) for path in paths]
    return tuple(sorted(found, key=lambda floor: floor.name))


def usable_floors(floors: Sequence[RealFloor]) -> Iterator[RealFloor]:
    """Of each building the floors with most doors at corridors, `FLOORS_PER_BUILDING` at most.

    Floors with fewer than `LEAST_CORRIDOR_DOORS` and those that cannot be read are left out.

    Args:
        floors: sorted by building.
    """
    for _, of_one in groupby(floors, lambda floor: floor.building):
        counted = [(corridor_doors(floor), floor) for floor in of_one]
        enough = [each for each in counted if each[0] >= LEAST_CORRIDOR_DOORS]
        best = sorted(enough, key=lambda each: (-each[0], each[1].name))[:FLOORS_PER_BUILDING]
        yield from sorted([floor for _, floor in best], key=lambda floor: floor.name)


def corridor_doors(floor: RealFloor) -> int:
    """Number of doors at the corridors of a floor that count as doors; 0 if it cannot be read."""
    try:
        plan = floor.plan()
    except FloorPlanError:
        return 0
    halls = shapely.union_all([hall.polygon for hall in plan.corridors])
    return sum(
        door.counts(DoorRules()) and halls.dwithin(shapely.Point(door.midpoint), AT_CORRIDOR)
        for door in plan.doors
    )


def halves(buildings: Sequence[str]) -> dict[str, str]:
    """The split of each building: in sorted order, every other one is to be tested on."""
    names = sorted(set(buildings))
    return {name: (TUNE, TEST)[k % 2] for k, name in enumerate(names)}


def benchmark_floors(
    places: Sequence[Path], mapped: Sequence[Path] = ()
) -> tuple[tuple[RealFloor, str], ...]:
    """The floors that episodes are made in, each with its split, sorted by group.

    Of drawn floors those are the listed ones, and the `usable_floors` of buildings that are not
    listed; of mapped floors all.

    Args:
        places: of drawn floors, as `floors_in` takes them.
        mapped: folders of mapped floors, as `mapped_floors` takes them.

    Raises:
        FloorPlanError: a folder has none, or a file cannot be read.
    """
    drawn = [(floor, split_of(floor)) for floor in floors_in(places)]
    listed = [(floor, s) for floor, s in drawn if floor.name in listed_floors().get(s, {})]
    others = usable_floors([floor for floor, split in drawn if split == OTHER])
    by_robots = [(floor, split_of(floor)) for floor in mapped_floors(mapped)]
    chosen = [*listed, *((floor, OTHER) for floor in others), *by_robots]
    return tuple(sorted(chosen, key=lambda each: each[0].name))


def fault_of(floor: RealFloor, split: str, plan: FloorPlan) -> str | None:
    """Why the plan of a floor is not that of the benchmark; None if it is, or is not listed."""
    wanted = listed_floors().get(split, {}).get(floor.name)
    found = fingerprint(plan)
    if wanted in (None, found):
        return None
    return f"{floor.name}: its fingerprint is {found} and not {wanted}: it was changed since"


@dataclass(eq=False)
class FairnessFilter:
    """Wants the commands with `StableAnswers`, and says what became of the first one it was asked.

    Attributes:
        stable: tells what changes the answer to a command.
        first: what changed the answer to the first command, "kept" for nothing; "none" before.
        drawn: number of commands so far.
    """

    stable: StableAnswers
    first: str = "none"
    drawn: int = 0

    def __call__(self, command: Command, start: Pose) -> bool:
        """Whether the answer to a command is stable."""
        change = self.stable.change(command, start)
        if not self.drawn:
            self.first = change or "kept"
        self.drawn += 1
        return change is None


def episodes_of(
    group: int, sites: Sequence[Site], split: str, seed: int = SEED
) -> Iterator[tuple[Episode | None, FairnessFilter]]:
    """The episodes of a group, evenly over its floors; None for one that could not be made.

    With each comes what became of the commands that were drawn for it: the first one is that of an
    episode of which the answer may depend on centimetres.

    Args:
        group: number of the group in its split, see `RealFloor.group`.
        sites: its floors.
        split: name of the split.
        seed: of the episodes.
    """
    wanted = replace(SPLITS["test_real"], name=split)
    checks = [StableAnswers(site.plan) for site in sites]
    for k in range(EPISODES_PER_GROUP):
        place = k * len(sites) // EPISODES_PER_GROUP
        number = group * EPISODES_PER_GROUP + k
        fair = FairnessFilter(checks[place])
        try:
            yield generate_episode(sites[place], wanted, number, seed, fair), fair
        except TooBareError:
            yield None, fair
