"""`python -m studies frames`: the doors of Barbret's hallway in scans like that of his figure 5.4.

His frame 536 shows three open doors, of which he finds two. The frame itself is not at hand: scans
are simulated in the plan of his figure 5.1, from the place of that frame and from places around it,
with jambs as deep as the walls of the building are thick.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from semnav_env.world.lidar import Lidar
from semnav_env.world.maps import FloorPlan, load_floor_plan
from semnav_env.world.maps.floor_plan import Surface
from semnav_features import Scan, extract
from semnav_features.frames import ORIGIN, Pose
from semnav_features.lidars import TIM561
from semnav_features.scene import Door, Scene
from studies.doors.door_sightings import matches
from studies.features.barbret_chain import barbret_scene
from studies.features.study import THESIS_STRATEGY, Extractor
from studies.sheets import Cell, ResultSheet

HALLWAY, SHOWN_DOORS = "heidelberg_hallway", ("north", "south_1", "south_2")
"""The plan, and those of its doors that the frame shows; the fourth is beyond his 6 m."""

PLACE_SPREAD, HEADING_SPREAD = 0.15, 0.1
"""Largest distance along each axis, metres, and turn, radians, from the place of the frame."""

EXTRACTORS: dict[str, Extractor] = {
    THESIS_STRATEGY: barbret_scene,
    "semnav": partial(extract),
}
"""The chains that are compared, by name."""


@dataclass(frozen=True)
class Arguments:
    """Count the doors of Barbret's hallway in simulated scans like his frame 536.

    Attributes:
        scans: number of scans from the place of the frame, and as many from places around it.
        depths: depths of the jambs, metres.
        sigma: standard deviation of the ranges, metres.
        seed: of places and noise.
        json: print the table as JSON.
    """

    scans: int = 100
    depths: tuple[float, ...] = (0.0, 0.1, 0.16, 0.25)
    sigma: float = 0.02
    seed: int = 0
    json: bool = False

    def run(self) -> int:
        """Measure and print."""
        if self.scans < 1 or min(self.depths) < 0.0:
            raise ValueError("--scans must be at least 1, and --depths 0 or more")
        sheet = ResultSheet("Doors of the hallway, frame 536", _COLUMNS, list(self._rows()))
        print(json.dumps(sheet.records()) if self.json else sheet.markdown())
        return 0

    def _rows(self) -> Iterator[tuple[Cell, ...]]:
        for depth in self.depths:
            plan = with_deep_jambs(load_floor_plan(HALLWAY), depth)
            for place, is_spread in (("there", False), ("around", True)):
                frames = list(self._frames(plan, is_spread))
                for name, look in EXTRACTORS.items():
                    yield name, depth, place, *_counted(frames, look)

    def _frames(self, plan: FloorPlan, is_spread: bool) -> Iterator[tuple[Scan, tuple[Door, ...]]]:
        """Scans, each with the shown doors in the lidar frame."""
        rng = np.random.default_rng(self.seed)
        lidar = Lidar(plan, replace(TIM561, sigma=self.sigma))
        doors = tuple([door.as_door() for door in plan.doors if door.name in SHOWN_DOORS])
        for number in range(self.scans):
            pose: Pose = ORIGIN
            if is_spread:
                x, y = rng.uniform(-PLACE_SPREAD, PLACE_SPREAD, 2).tolist()
                pose = x, y, float(rng.uniform(-HEADING_SPREAD, HEADING_SPREAD))
            seen = Scene(doors=doors).seen_from(pose).doors
            yield lidar.scan(pose, (self.seed, int(is_spread), number)), tuple(seen)


_COLUMNS = (
    *("chain", "depth of the jambs, m", "scans from", *SHOWN_DOORS),
    *("all three", "false doors in a scan"),
)


def with_deep_jambs(plan: FloorPlan, depth: float) -> FloorPlan:
    """The plan with walls behind each jamb, away from the origin, as deep as told, metres."""
    added = []
    for door in plan.doors:
        start, end = np.array(door.start), np.array(door.end)
        along = (end - start) / door.width
        normal = np.array((along[1], -along[0]))
        if normal @ start < 0.0:
            normal = -normal
        for jamb in (start, end) if depth else ():
            back = jamb + depth * normal
            added.append(
                Surface(
                    ((float(jamb[0]), float(jamb[1])), (float(back[0]), float(back[1]))),
                )
            )
    return replace(plan, surfaces=(*plan.surfaces, *added))


def _counted(frames: list[tuple[Scan, tuple[Door, ...]]], look: Extractor) -> Iterator[float]:
    """Shares of the scans in which each door is found, and all; mean number of false doors."""
    found, false = [], 0
    for scan, doors in frames:
        seen = look(scan).doors
        found.append([any(matches(each, d.start, d.end) for each in seen) for d in doors])
        false += sum(not any(matches(each, d.start, d.end) for d in doors) for each in seen)
    shares = np.array(found)
    yield from shares.mean(axis=0).tolist()
    yield float(shares.all(axis=1).mean())
    yield false / len(frames)
