"""Doors in simulated scans of real floors: labelled ones of occupancy maps, gaps of vector maps."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import NamedTuple

import numpy as np
import shapely
from shapely.geometry.base import BaseGeometry

from semnav_env.world.lidar import Lidar, LidarSpec
from semnav_env.world.maps import FloorPlan
from semnav_env.world.maps.importers import (
    OccupancyMap,
    load_building,
    load_vector_map,
    read_occupancy,
)
from semnav_env.world.maps.importers.gaps import places_beside
from semnav_env.world.maps.importers.labels import DOORS_FILE, read_door_labels
from semnav_features import ExtractorSettings, Scan, extract
from semnav_features.frames import Point, Pose
from semnav_features.lidars import TIM561
from semnav_features.scene import Door, Scene
from studies.buildings.plan_openings import openings_of
from studies.doors.door_sightings import DoorCounts, Gate, View, judge, matches
from studies.sheets import Cell, ResultSheet

LIDAR_CLEARANCE = 0.35
"""Least distance from the lidar to anything solid, metres: about half the width of a robot."""

MAX_POSE_TRIES = 100_000
"""Random places that are drawn for one pose before the floor is found to have no room."""

DOOR_GATE = Gate()
"""Which doors count as in good view."""

INDOOR_TEST_LIDAR = LidarSpec("eight", 8, -math.pi, math.pi / 4, range_max=200.0)
"""A place is indoors if every beam of this lidar ends at a wall."""


@dataclass(frozen=True, eq=False)
class Building:
    """A real floor whose doors are known.

    Attributes:
        plan: what is solid, and its places.
        doors: the open ones, world frame.
        area: where the lidar may stand.
        pixels: the occupancy map that the plan comes from, if it does.
    """

    plan: FloorPlan
    doors: tuple[Door, ...]
    area: BaseGeometry
    pixels: OccupancyMap | None = None

    def is_free(self, point: Point) -> bool:
        """Whether the source of the plan says that a place is free."""
        return self.pixels is None or self.pixels.is_free(point)

    def poses(self, rng: np.random.Generator) -> Iterator[Pose]:
        """Random free poses indoors, uniform over place and heading, without end.

        Raises:
            ValueError: there is no room to stand.
        """
        bounds = self.area.bounds
        compass = Lidar(self.plan, INDOOR_TEST_LIDAR)
        shapely.prepare(self.area)
        for _ in range(MAX_POSE_TRIES):
            x, y = rng.uniform(bounds[:2], bounds[2:]).tolist()
            pose = x, y, float(rng.uniform(-math.pi, math.pi))
            if not shapely.contains_xy(self.area, x, y) or not self.is_free((x, y)):
                continue
            if len(self.plan.solids.query(shapely.Point(x, y), "dwithin", LIDAR_CLEARANCE)):
                continue
            if np.isfinite(compass.exact_ranges(pose)).all():
                yield pose
        raise ValueError(
            f"{self.plan.name}: too few places are {LIDAR_CLEARANCE} m from everything solid"
        )

    def leads_elsewhere(self, opening: Door) -> bool:
        """Whether different places of the plan lie before and behind an opening, world frame."""
        before, behind = places_beside(opening.start, opening.end, self.plan.regions)
        return before is not None and behind is not None and before != behind


def find_buildings(folder: Path) -> dict[str, Callable[[], Building]]:
    """The real floors in a folder with data, by name, read when they are asked for.

    Those are gdc_floors/NAME/NAME.yaml and amrl_floors/NAME.vectormap.json.

    Raises:
        ValueError: there are none.
    """
    maps = [path for path in folder.glob("gdc_floors/*/*.yaml") if path.stem == path.parent.name]
    vectors = sorted(folder.glob("amrl_floors/*.vectormap.json"))
    found: dict[str, Callable[[], Building]] = {}
    for path in sorted(maps):
        found[f"gdc_floors/{path.stem}"] = partial(labelled, path)
    for path in vectors:
        found[f"amrl_floors/{path.name.split('.')[0]}"] = partial(drawn, path)
    if not found:
        raise ValueError(
            f"{folder} holds neither gdc_floors/NAME/NAME.yaml nor "
            "amrl_floors/NAME.vectormap.json; give the folder with the real floors"
        )
    return found


def labelled(path: Path) -> Building:
    """A floor of an occupancy map whose open doors are those that people labelled."""
    plan = load_building(path).plan
    names = {label.name for label in read_door_labels(path.with_name(DOORS_FILE))}
    doors = tuple([door.as_door() for door in plan.doors if door.open and door.name in names])
    area = shapely.union_all([region.polygon for region in plan.regions])
    return Building(plan, doors, area, read_occupancy(path))


def drawn(path: Path) -> Building:
    """A floor of a vector map whose doors are the gaps between walls (`openings_of`)."""
    plan = load_vector_map(path).plan
    return Building(plan, openings_of(plan), plan.boundary)


class FloorLook(NamedTuple):
    """One simulated scan of a building; doors are in the lidar frame.

    Attributes:
        pose: of the lidar, world frame.
        scan: what it measures.
        doors: all those of the building.
        found: those that the extractor finds.
        passages: of them those that match no door, but lead from one place to another.
    """

    pose: Pose
    scan: Scan
    doors: tuple[Door, ...]
    found: tuple[Door, ...]
    passages: tuple[Door, ...]

    def counts(self, limits: ExtractorSettings | None = None) -> DoorCounts:
        """What was found; passages are undecided.

        Args:
            limits: only the sightings of doors as wide as these settings ask for count.
        """
        wanted = [door for door in self.doors if limits is None or is_wanted(door, limits)]
        return judge(self.scan, self.found, self.doors, self.passages, DOOR_GATE, wanted)

    def missed(self, limits: ExtractorSettings) -> Iterator[Door]:
        """Doors in good view that were not found."""
        for door in self.doors:
            seen = DOOR_GATE.view(self.scan, door.start, door.end) is View.GATED
            found = any(matches(each, door.start, door.end) for each in self.found)
            if seen and not found and is_wanted(door, limits):
                yield door

    def false(self) -> Iterator[Door]:
        """Detections within the gate's reach that are neither a door nor a passage."""
        for door in self.found:
            near = max(math.hypot(*door.start), math.hypot(*door.end)) <= DOOR_GATE.reach
            if near and not any(matches(door, d.start, d.end) for d in self.doors + self.passages):
                yield door


def is_wanted(door: Door, limits: ExtractorSettings) -> bool:
    """Whether a door is as wide as the extractor looks for."""
    slack = limits.door_width_tolerance
    return limits.door_width_min - slack <= door.width <= limits.door_width_max + slack


def look_around(
    building: Building,
    count: int,
    rng: np.random.Generator,
    settings: ExtractorSettings,
    spec: LidarSpec = TIM561,
) -> Iterator[FloorLook]:
    """Scans from random free poses, with the doors found in each."""
    lidar = Lidar(building.plan, spec)
    everything = Scene(doors=building.doors)
    for number, pose in zip(range(count), building.poses(rng), strict=False):
        scan = lidar.scan(pose, (int(rng.integers(2**31)), 0, number))
        scene = extract(scan, settings)
        found = zip(scene.doors, Scene(doors=scene.doors).placed(pose).doors, strict=True)
        passages = tuple([door for door, placed in found if building.leads_elsewhere(placed)])
        doors = tuple(everything.seen_from(pose).doors)
        yield FloorLook(pose, scan, doors, tuple(scene.doors), passages)


def building_row(
    name: str, looks: Sequence[FloorLook], limits: ExtractorSettings | None
) -> tuple[Cell, ...]:
    """Recall and precision in one building; see `building_sheet`."""
    total = sum([look.counts(limits) for look in looks], DoorCounts())
    seen = (total.gated, total.recall, total.seen, total.recall_ungated)
    false = total.detections - total.right - total.undecided
    given = (total.detections, total.right, total.undecided, false)
    return (name, len(looks), *seen, *given, total.precision, total.precision_at_least)


def building_sheet(rows: Sequence[tuple[Cell, ...]]) -> ResultSheet:
    """The rows of `building_row` as a table."""
    columns = (
        *("floor", "scans", "gated", "recall", "in view", "recall, all in view", "detections"),
        *("of a door", "of an unlabelled opening", "of neither"),
        *("precision", "precision, unlabelled wrong"),
    )
    return ResultSheet("Doors in real floors, simulated scans", columns, rows)
