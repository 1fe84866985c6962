"""Doors in simulated scans of real floors: which are wanted, and how detections are judged."""

import json
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from semnav_env.world.maps.floor_plan import PlanDoor
from semnav_env.world.maps.importers import read_occupancy
from semnav_env.world.maps.importers.segments import plan_of_segments
from semnav_features import ExtractorSettings
from semnav_features.scene import Door
from studies.__main__ import STUDIES
from studies.buildings.buildings import (
    building_row,
    find_buildings,
    labelled,
    look_around,
)
from studies.buildings.false_doorways import false_doorways
from studies.buildings.map_doorways import map_row
from studies.buildings.plan_openings import openings_of
from tests.support.drawn_maps import DOORS, FREE, PLACES, SOLID, narrowing, write_map
from tests.support.paths import DATA


def rectangle(west, south, east, north):
    return [
        (west, south, east, south),
        (east, south, east, north),
        (east, north, west, north),
        (west, north, west, south),
    ]


def parted(gap, thickness=0.2, shift=0.0):
    """A room of 6 m by 4 m, parted by a wall with a gap; the lower half may lie to one side."""
    walls = rectangle(-3.0, -2.0, 3.0, 2.0)
    walls += rectangle(-thickness / 2, gap / 2, thickness / 2, 1.9)
    walls += rectangle(shift - thickness / 2, -1.9, shift + thickness / 2, -gap / 2)
    return plan_of_segments(walls, Path("parted.json"), "test").plan


@pytest.fixture
def data(tmp_path):
    """A folder with one labelled floor and one vector map."""
    folder = tmp_path / "gdc_floors" / "small"
    folder.mkdir(parents=True)
    grey = np.full((70, 134), FREE)  # two rooms of 3 m by 3 m at 0.05 m a pixel
    for line in (slice(0, 4), slice(-4, None)):
        grey[line, :] = SOLID
        grey[:, line] = SOLID
    grey[:, 65:69] = SOLID
    grey[24:44, 65:69] = FREE
    write_map(folder, grey, "small", resolution=0.05)
    (folder / "doors.yaml").write_text(DOORS)
    (folder / "locations.yaml").write_text(
        PLACES.replace("32", "64").replace("35", "69").replace("65", "130")
    )
    amrl = tmp_path / "amrl_floors"
    amrl.mkdir()
    rows = [
        {"p0": {"x": a, "y": b}, "p1": {"x": c, "y": d}}
        for a, b, c, d in parted(1.0).segments.tolist()
    ]
    (amrl / "drawn.vectormap.json").write_text(json.dumps(rows))
    return tmp_path


@pytest.mark.parametrize("gap", [0.7, 1.0, 1.7])
def test_a_gap_between_the_ends_of_two_walls_is_an_opening(gap):
    (door,) = openings_of(parted(gap))
    assert door.width == pytest.approx(gap)
    assert door.midpoint == pytest.approx((0.0, 0.0))


@pytest.mark.parametrize(("gap", "shift"), [(0.5, 0.0), (2.2, 0.0), (1.0, 0.5)])
def test_gaps_too_narrow_too_wide_or_shifted_are_no_openings(gap, shift):
    """The two walls of a passage are too near, too far apart or shifted."""
    assert openings_of(parted(gap, shift=shift)) == ()


def test_a_blocked_gap_is_no_opening():
    plan = parted(1.0)
    cupboard = [*plan.segments.tolist(), (0.3, -2.0, 0.3, 2.0)]
    assert openings_of(plan_of_segments(cupboard, Path("niche.json"), "test").plan) == ()


def test_buildings_are_found_by_name(data):
    assert list(find_buildings(data)) == ["gdc_floors/small", "amrl_floors/drawn"]
    with pytest.raises(ValueError, match=r"gdc_floors/NAME/NAME\.yaml"):
        find_buildings(data / "gdc_floors")


def test_poses_are_indoors_in_places_and_clear_of_walls(data):
    building = find_buildings(data)["gdc_floors/small"]()
    for (x, y, _), _ in zip(building.poses(np.random.default_rng(0)), range(50), strict=False):
        assert building.area.contains_properly(building.area.representative_point())
        assert 0.5 < x < 6.2
        assert 0.5 < y < 3.0


def test_an_opening_leads_elsewhere_if_it_parts_two_places(data):
    building = find_buildings(data)["gdc_floors/small"]()
    (door,) = building.doors
    assert building.leads_elsewhere(door)
    assert building.leads_elsewhere(Door(door.end, door.start))
    assert not building.leads_elsewhere(Door((1.0, 1.0), (1.0, 2.0)))


def test_door_and_detection_are_counted_once_in_each_scan(data):
    building = find_buildings(data)["gdc_floors/small"]()
    limits = ExtractorSettings()
    looks = list(look_around(building, 40, np.random.default_rng(1), limits))
    row = building_row("small", looks, limits)
    gated, recall, seen, _, detections, right, passages, false = row[2:10]
    assert gated <= seen <= len(looks)
    assert detections == right + passages + false
    assert sum(len(list(look.false())) for look in looks) == false
    missed = sum(len(list(look.missed(limits))) for look in looks)
    assert gated - missed == pytest.approx(recall * gated)
    assert recall > 0.8
    narrow = replace(limits, door_width_max=0.8, door_width_min=0.7)
    assert building_row("small", looks, narrow)[2] == 0


def test_the_command_measures_every_floor_and_draws_failures(data, capsys):
    words = ["buildings", "--data", str(data), "--poses", "15", "--json"]
    blind = ["--settings.door-confidence-min", "1.0"]
    assert STUDIES.main([*words, *blind, "--out", str(data / "pages")]) == 0
    records, mapped = json.loads(capsys.readouterr().out).values()
    (small,) = mapped
    assert (small["labelled open doors"], small["of them found"]) == (1, 1)
    assert (small["doorways found"], small["false"]) == (1, 0)
    assert [record["scans"] for record in records] == [15] * 4
    assert all(record["recall"] == 0.0 for record in records)
    assert (data / "pages" / "gdc_floors_small_missed.png").stat().st_size > 0


def test_a_doorway_with_a_way_around_it_is_false(tmp_path):
    """A doorway is false if, with all doorways sealed, a way leads around it."""
    grey = np.full((60, 100), FREE)
    grey[[0, -1], :] = grey[:, [0, -1]] = SOLID
    grey[:20, 50] = grey[40:, 50] = SOLID  # an opening of 2 m
    grey[29:31, 50] = SOLID  # with a pillar in it
    pixels = read_occupancy(write_map(tmp_path, grey))
    halves = (
        PlanDoor("north", (5.05, 4.0), (5.05, 3.1)),
        PlanDoor("south", (5.05, 2.9), (5.05, 2.0)),
    )
    assert false_doorways(halves, (), pixels) == ()
    assert false_doorways(halves[:1], halves[1:], pixels) == ()
    assert false_doorways(halves[:1], (), pixels) == halves[:1]


def test_doorways_count_where_straight_walls_narrow_them(tmp_path):
    building = labelled(narrowing(tmp_path))
    row = map_row("narrow", building, building.pixels)
    assert row[:-1] == ("narrow", 1, 1, 1.0, 1, 0, 0, 0.0)


def test_bad_arguments_are_refused(data, capsys):
    assert STUDIES.main(["buildings", "--data", str(data), "--poses", "0"]) == 2
    assert STUDIES.main(["buildings", "--data", str(data / "amrl_floors")]) == 2
    assert "gdc_floors" in capsys.readouterr().err


def test_most_doors_of_a_drawn_floor_are_found():
    folder = DATA / "amrl_floors"
    if not folder.exists():
        pytest.skip("the vector maps are not here")
    building = find_buildings(DATA)["amrl_floors/GDC1"]()
    limits = ExtractorSettings()
    looks = list(look_around(building, 200, np.random.default_rng(2), limits))
    row = building_row("GDC1", looks, limits)
    assert row[3] > 0.8
    assert row[10] > 0.8
    assert not math.isnan(row[5])
