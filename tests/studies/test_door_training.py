"""The training of the scorer of doors: its floors, and the file that it writes."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
import shapely

from semnav_env.world.maps import load_floor_plan
from semnav_features.door_scorer import load_scorer
from semnav_features.kernels.evidence_layout import BIAS_ROW, SCORER_ROWS
from studies.door_scorer.drawn_floors import drawn_floors, furnished_floor
from studies.door_scorer.random_offices import SCANNER_CLEARANCE
from studies.door_scorer.train_doors import Arguments
from studies.theses.frames_command import with_deep_jambs
from tests.support.paths import DATA

HALL = "office_cross"


def test_a_training_writes_a_scorer_that_can_be_loaded(tmp_path: Path) -> None:
    out = tmp_path / "scorer.json"
    assert Arguments(out, offices=4, poses=2, hidden=3).run() == 0
    table = load_scorer(out)
    assert table.shape == (SCORER_ROWS, 3)
    assert np.abs(table[:BIAS_ROW]).max() > 0.0


def test_the_same_seed_trains_the_same_scorer(tmp_path: Path) -> None:
    texts = []
    for name in ("a.json", "b.json"):
        Arguments(tmp_path / name, offices=3, poses=2, hidden=2).run()
        texts.append(json.loads((tmp_path / name).read_text()))
    assert texts[0] == texts[1]


@pytest.mark.parametrize("seed", range(5))
def test_nothing_stands_in_the_open_doors_of_a_furnished_floor(seed: int) -> None:
    """Their leaves end at a jamb, at 35 degrees or more to the doorway."""
    rng = np.random.default_rng(seed)
    floor = furnished_floor(load_floor_plan(HALL), rng)
    for door in floor.doors:
        middle = shapely.Point(door.midpoint)
        assert not len(floor.floor_plan.solids.query(middle, "dwithin", 0.2 * door.width))


@pytest.mark.parametrize("seed", range(5))
def test_poses_of_a_furnished_floor_are_free(seed: int) -> None:
    rng = np.random.default_rng(seed)
    floor = furnished_floor(load_floor_plan(HALL), rng)
    for pose in (floor.corridor_pose(rng), floor.any_pose(rng)):
        near = floor.floor_plan.solids.query(shapely.Point(pose[:2]), "dwithin", SCANNER_CLEARANCE)
        assert not len(near)


def test_the_drawn_floors_are_those_of_the_tuning_half() -> None:
    folder = DATA / "kth_floors"
    if not folder.exists():
        pytest.skip(f"{folder} is missing")
    assert len(drawn_floors(folder)) == 19


def test_a_folder_that_lacks_a_floor_is_refused(tmp_path: Path) -> None:
    (tmp_path / "A1").mkdir()
    (tmp_path / "A1" / "one.xml").write_text("<Floor/>")
    with pytest.raises(ValueError, match="lacks A0043009"):
        drawn_floors(tmp_path)


def test_deep_jambs_leave_the_doorways_open() -> None:
    plan = load_floor_plan("heidelberg_hallway")
    deep = with_deep_jambs(plan, 0.16)
    assert len(deep.surfaces) == len(plan.surfaces) + 2 * len(plan.doors)
    assert with_deep_jambs(plan, 0.0).surfaces == plan.surfaces
