"""Doorways across hallways that nobody labelled in a map."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_env.world.maps.importers import import_map
from tests.support.drawn_maps import FREE, SOLID, write_map

PLACES = """
locations: [hall]
polygons: [[2, 2, 198, 2, 198, 22, 2, 22]]
"""


def hall(folder: Path, *pillars: tuple[slice, slice]) -> FloorPlan:
    """A hallway 19.6 m long and 2 m wide, with solid parts (rows, columns) in it, 0.1 m a pixel."""
    grey = np.full((24, 200), FREE)
    grey[[0, 1, -1, -2], :] = SOLID
    grey[:, [0, 1, -1, -2]] = SOLID
    for pillar in pillars:
        grey[pillar] = SOLID
    (folder / "locations.yaml").write_text(PLACES)
    return import_map(write_map(folder, grey)).plan


def test_a_hallway_that_walls_narrow_to_a_door_has_a_doorway(tmp_path: Path) -> None:
    plan = hall(tmp_path, (slice(2, 7), slice(98, 101)), (slice(17, 22), slice(98, 101)))
    (door,) = plan.doors
    assert door.open
    assert door.name == "hall - hall"
    assert door.width == pytest.approx(1.0, abs=0.1)
    assert math.dist(door.midpoint, (9.95, 1.2)) < 0.2


def test_a_pillar_on_one_side_is_enough(tmp_path: Path) -> None:
    (door,) = hall(tmp_path, (slice(2, 11), slice(98, 101))).doors
    assert door.width == pytest.approx(1.1, abs=0.1)


@pytest.mark.parametrize("rows", [slice(2, 8), slice(2, 17)])
def test_a_wider_or_impassable_narrowing_is_no_doorway(tmp_path: Path, rows: slice) -> None:
    """1.4 m are more than anybody calls a door; 0.5 m are too narrow for every robot."""
    assert not hall(tmp_path, (rows, slice(98, 101))).doors


def test_a_hallway_that_stays_narrow_has_no_doorway(tmp_path: Path) -> None:
    """One 1 m wide from end to end."""
    assert not hall(tmp_path, (slice(2, 12), slice(2, 198))).doors
