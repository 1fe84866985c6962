"""`semnav episodes buildings`: the benchmark of real buildings from the user's own plans."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from semnav_env.judge.episodes import load_episodes
from semnav_env.judge.episodes.buildings import (
    EPISODES_PER_GROUP,
    MAPPED,
    MAPPED_TUNE,
    TEST,
    TUNE,
    benchmark_floors,
    fault_of,
    floors_in,
    halves,
    listed_floors,
    mapped_floors,
    split_of,
    usable_floors,
)
from tests.support.command_line import run
from tests.support.kth_floors import long_floor, real_floors
from tests.support.osm_floors import hall_and_rooms
from tests.support.paths import DATA


def building(folder: Path, name: str, **floors: str) -> Path:
    (folder / name).mkdir(parents=True)
    for floor, text in floors.items():
        (folder / name / f"{floor}.xml").write_text(text)
    return folder


def test_a_building_that_is_not_listed_makes_a_split_of_its_own(
    tmp_path: Path, capsys: Any
) -> None:
    folder = building(tmp_path / "mine", "B1", one=long_floor(), none="<floor/>")
    code, out, err = run(capsys, "episodes", "buildings", "--kth", folder, "--out", tmp_path / "o")
    assert code == 0, err
    assert "real_drawn_other.jsonl.gz: 15 episodes in 1 floor of 1 building; kept" in out
    episodes = load_episodes(tmp_path / "o" / "real_drawn_other.jsonl.gz")
    assert len(episodes) == EPISODES_PER_GROUP
    numbers = json.loads((tmp_path / "o" / "real_drawn.json").read_text())
    counts = numbers["real_drawn_other"]["commands"]["B1"]
    assert sum(counts.values()) - counts["drawn"] == EPISODES_PER_GROUP
    assert counts["drawn"] >= EPISODES_PER_GROUP


def test_a_building_of_openstreetmap_makes_episodes_on_its_levels(
    tmp_path: Path, capsys: Any
) -> None:
    (tmp_path / "house.osm").write_text(hall_and_rooms([{"door": "hinged"}] * 10))
    told = "episodes", "buildings", "--osm", tmp_path / "house.osm", "--out", tmp_path / "o"
    code, out, err = run(capsys, *told)
    assert code == 0, err
    assert "15 episodes in 1 floor of 1 building" in out
    found = load_episodes(tmp_path / "o" / "real_drawn_other.jsonl.gz")
    assert {Path(each.floor_plan).name for each in found} == {"house-0.geojson"}


def mapped(folder: Path, floor: str, capsys: Any) -> Path:
    """A folder with one floor, as a robot would have mapped it."""
    (folder / floor).mkdir(parents=True)
    told = "map", "export", "office_cross", "--out", folder / floor / f"{floor}.yaml"
    code, _, err = run(capsys, *told)
    assert code == 0, err
    return folder


def test_a_mapped_floor_makes_episodes_of_its_own(tmp_path: Path, capsys: Any) -> None:
    folder = mapped(tmp_path / "mine", "ground", capsys)
    code, out, err = run(capsys, "episodes", "buildings", "--gdc", folder, "--out", tmp_path / "o")
    assert code == 0, err
    assert "real_mapped.jsonl.gz: 15 episodes in 1 floor of 1 building; kept" in out
    found = load_episodes(tmp_path / "o" / "real_mapped.jsonl.gz")
    assert {Path(each.floor_plan).name for each in found} == {"gdc-ground.geojson"}
    assert len({each.command for each in found}) > EPISODES_PER_GROUP // 2
    numbers = json.loads((tmp_path / "o" / "real_mapped.json").read_text())
    counts = numbers["real_mapped"]["commands"]["gdc/ground"]
    assert sum(counts.values()) - counts["drawn"] == EPISODES_PER_GROUP


def test_a_mapped_floor_without_a_corridor_is_named_and_left_out(
    tmp_path: Path, capsys: Any
) -> None:
    folder = mapped(tmp_path / "mine", "bare", capsys)
    for labels in ("doors.yaml", "locations.yaml"):
        (folder / "bare" / labels).unlink()
    code, out, err = run(capsys, "episodes", "buildings", "--gdc", folder, "--out", tmp_path / "o")
    assert code == 0, err
    assert "left out: gdc-bare: gives no command" in out
    assert "left out: 15 episodes in gdc/bare" in out
    assert not list((tmp_path / "o").glob("*.jsonl.gz"))


def test_a_changed_mapped_floor_of_the_benchmark_is_left_out_by_name(
    tmp_path: Path, capsys: Any
) -> None:
    folder = mapped(tmp_path / "mine", "2", capsys)
    code, out, err = run(capsys, "episodes", "buildings", "--gdc", folder, "--out", tmp_path / "o")
    assert code == 0, err
    assert "left out: gdc/2: its fingerprint is" in out


@pytest.mark.parametrize("told", [(), ("--osm", "plan.xml"), ("--osm", "no.osm")])
def test_what_is_no_building_is_refused(tmp_path: Path, capsys: Any, told: Any) -> None:
    code, _, err = run(capsys, "episodes", "buildings", *told, "--out", tmp_path / "o")
    assert code == 2
    assert "--osm" in err or "no.osm" in err


def test_a_changed_floor_of_the_benchmark_is_left_out_by_name(tmp_path: Path, capsys: Any) -> None:
    name, stem = next(iter(listed_floors()[TUNE])).split("/")
    folder = building(tmp_path / "mine", name, **{stem: long_floor()})
    code, out, err = run(capsys, "episodes", "buildings", "--kth", folder, "--out", tmp_path / "o")
    assert code == 0, err
    assert f"left out: {name}/{stem}: its fingerprint is" in out


def test_a_folder_without_floors_is_refused(tmp_path: Path, capsys: Any) -> None:
    code, _, err = run(capsys, "episodes", "buildings", "--kth", tmp_path, "--out", tmp_path / "o")
    assert code == 2
    assert "BUILDING/FLOOR.xml" in err
    code, _, err = run(capsys, "episodes", "buildings", "--gdc", tmp_path, "--out", tmp_path / "o")
    assert code == 2
    assert "FLOOR/FLOOR.yaml" in err
    assert not (tmp_path / "o").exists()


def test_buildings_to_tune_on_are_none_to_test_on() -> None:
    tune, test = ({name.split("/")[0] for name in listed_floors()[s]} for s in (TUNE, TEST))
    assert tune
    assert test
    assert not tune & test


@pytest.mark.skipif(not real_floors, reason="the drawn floors are not here")
def test_the_listed_floors_are_those_of_the_rule() -> None:
    floors = floors_in([DATA / "kth_floors"])
    half = halves([floor.building for floor in floors])
    chosen = {floor.name: half[floor.building] for floor in usable_floors(floors)}
    assert chosen == {name: split for split in (TUNE, TEST) for name in listed_floors()[split]}


@pytest.mark.skipif(not real_floors, reason="the drawn floors are not here")
def test_the_fingerprints_are_those_of_the_floors(tmp_path: Path) -> None:
    for floor, split in benchmark_floors([DATA / "kth_floors"])[::9]:
        assert fault_of(floor, split, floor.save(tmp_path).plan) is None


@pytest.mark.skipif(not (DATA / "gdc_floors").is_dir(), reason="the mapped floors are not here")
def test_the_fingerprints_are_those_of_the_mapped_floors(tmp_path: Path) -> None:
    floors = {floor.name: floor for floor in mapped_floors([DATA / "gdc_floors"])}
    listed = {name: split for split in (MAPPED_TUNE, MAPPED) for name in listed_floors()[split]}
    assert {name: split_of(floor) for name, floor in floors.items()} == listed
    one = floors["gdc/3ne"]
    assert fault_of(one, MAPPED_TUNE, one.save(tmp_path).plan) is None
