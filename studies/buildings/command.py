"""`python -m studies buildings`: doors in simulated scans of real floors."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from semnav_features import ExtractorSettings
from semnav_scripts.progress import tracked
from studies.buildings.buildings import (
    Building,
    FloorLook,
    building_row,
    building_sheet,
    find_buildings,
    look_around,
)
from studies.buildings.map_doorways import map_row, map_sheet
from studies.sheets import Cell

FAILURES_PER_PAGE = 25
"""Most failures that are drawn on one page."""


@dataclass(frozen=True)
class Arguments:
    """Measure the doors that are found in simulated scans of real floors.

    Two rows for each floor: for the doors whose width the extractor looks for, and for all.

    Attributes:
        data: folder with gdc_floors (labelled occupancy maps) and amrl_floors (vector maps).
        poses: random free poses on each floor.
        seed: of poses and noise.
        settings: of the extractor.
        out: folder for pictures of what was missed and of false doors.
        json: print the table as JSON.
    """

    data: Path
    poses: int = 1000
    seed: int = 0
    settings: ExtractorSettings = field(default_factory=ExtractorSettings)
    out: Path | None = None
    json: bool = False

    def run(self) -> int:
        """Measure, draw and print."""
        if self.poses < 1 or self.seed < 0:
            raise ValueError("--poses must be at least 1, and --seed at least 0")
        rows: list[tuple[Cell, ...]] = []
        mapped: list[tuple[Cell, ...]] = []
        for name, read in find_buildings(self.data).items():
            building = read()
            looks = self._look(name, building)
            widths = f"{self.settings.door_width_min} to {self.settings.door_width_max} m"
            rows.append(building_row(f"{name}, {widths}", looks, self.settings))
            rows.append(building_row(f"{name}, all", looks, None))
            if building.pixels is not None and building.doors:
                mapped.append(map_row(name, building, building.pixels))
            if self.out is not None:
                self._draw(self.out / name.replace("/", "_"), building, looks)
        sheets = [building_sheet(rows), *([map_sheet(mapped)] if mapped else [])]
        if self.json:
            print(json.dumps({sheet.title: sheet.records() for sheet in sheets}))
        else:
            print("\n\n".join(sheet.markdown() for sheet in sheets))
        return 0

    def _look(self, name: str, building: Building) -> list[FloorLook]:
        rng = np.random.default_rng(self.seed)
        looks: list[FloorLook] = []
        looking = look_around(building, self.poses, rng, self.settings)
        for look in tracked(looking, lambda n: f"{name}", lambda: len(looks) / self.poses):
            looks.append(look)
        return looks

    def _draw(self, path: Path, building: Building, looks: list[FloorLook]) -> None:
        """Pages with some of the failures, evenly over all."""
        from studies.buildings.failure_pages import Failure, save_failures

        missed = [Failure(look, door) for look in looks for door in look.missed(self.settings)]
        false = [Failure(look, door) for look in looks for door in look.false()]
        for kind, failures in (("missed", missed), ("false", false)):
            if failures:
                shown = failures[:: -(-len(failures) // FAILURES_PER_PAGE)]
                page = path.with_name(f"{path.name}_{kind}.png")
                title = f"{building.plan.name}, {kind}: {len(shown)} of {len(failures)}"
                save_failures(page, building.plan, shown, title)
