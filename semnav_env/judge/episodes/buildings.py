"""The real-building benchmark: floors of drawn buildings that the user has, and their splits.

The project holds the names and the fingerprints of KTH's floors, and the seed of their episodes,
but no plans: their makers state no licence.
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

SPLIT_NAMES = (TUNE, TEST, OTHER)
"""All of them."""

EPISODES_PER_BUILDING = 15
"""Number of episodes in each building."""

FLOORS_PER_BUILDING = 3
"""Largest number of floors of a building: floors above each other are alike."""

LEAST_CORRIDOR_DOORS = 8
"""A floor with fewer doors at its corridors has too few things that a command can name."""

AT_CORRIDOR = 0.1
"""Distance from a corridor within which a door is the corridor's, metres."""

LISTED = files("semnav_env.judge.episodes") / "frozen" / "real_drawn.json"
"""For each split the floors, as BUILDING/FLOOR, with the fingerprints of their plans."""


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
    def name(self) -> str:
        """BUILDING/FLOOR."""
        return f"{self.building}/{self.path.stem if self.level is None else self.level}"

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
    found: dict[str, dict[str, str]] = json.loads(LISTED.read_text())
    return found


def split_of(building: str) -> str:
    """The split of a building: `TUNE`, `TEST`, or `OTHER` if it is not listed."""
    for split, floors in listed_floors().items():
        if any(name.partition("/")[0] == building for name in floors):
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


def benchmark_floors(places: Sequence[Path]) -> tuple[tuple[RealFloor, str], ...]:
    """The floors in places of `floors_in` that episodes are made in, each with its split, sorted.

    Those are the listed floors, and the `usable_floors` of buildings that are not listed.

    Raises:
        FloorPlanError: a folder has none, or a file cannot be read.
    """
    there = [(floor, split_of(floor.building)) for floor in floors_in(places)]
    listed = [(floor, s) for floor, s in there if floor.name in listed_floors().get(s, {})]
    others = usable_floors([floor for floor, split in there if split == OTHER])
    return tuple(
        sorted([*listed, *((floor, OTHER) for floor in others)], key=lambda each: each[0].name)
    )


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
    building: int, sites: Sequence[Site], split: str, seed: int = SEED
) -> Iterator[tuple[Episode | None, FairnessFilter]]:
    """The episodes of a building, evenly over its floors; None for one that could not be made.

    With each comes what became of the commands that were drawn for it: the first one is that of an
    episode of which the answer may depend on centimetres.

    Args:
        building: number of the building in its split.
        sites: its floors.
        split: name of the split.
        seed: of the episodes.
    """
    wanted = replace(SPLITS["test_real"], name=split)
    checks = [StableAnswers(site.plan) for site in sites]
    for k in range(EPISODES_PER_BUILDING):
        place = k * len(sites) // EPISODES_PER_BUILDING
        number = building * EPISODES_PER_BUILDING + k
        fair = FairnessFilter(checks[place])
        try:
            yield generate_episode(sites[place], wanted, number, seed, fair), fair
        except TooBareError:
            yield None, fair
