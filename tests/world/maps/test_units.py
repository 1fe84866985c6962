"""Plans that are drawn in another unit than metres are told from their doors."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from semnav_env.world.maps import bundled_names, load_floor_plan
from semnav_env.world.maps.check import check
from semnav_env.world.maps.importers import Drawing, import_map
from semnav_env.world.maps.rules import FloorPlanError
from semnav_env.world.maps.units import CERTAIN_WIDTH, UNITS, certain_unit_fault, unit_fault
from semnav_env.world.maps.writer import to_geojson
from tests.support.command_line import run

CERTAIN = ("inches", "centimetres", "millimetres")


def drawn_in(unit: str, folder: Path) -> Path:
    """A bundled plan as a program draws it that counts in another unit."""
    document = json.loads(to_geojson(load_floor_plan("office_cross")))
    for feature in document["features"]:
        geometry = feature["geometry"]
        geometry["coordinates"] = times(geometry["coordinates"], 1.0 / UNITS[unit])
    path = folder / "plan.geojson"
    path.write_text(json.dumps(document))
    return path


def times(coordinates: Any, factor: float) -> Any:
    if isinstance(coordinates, list):
        return [times(each, factor) for each in coordinates]
    return coordinates * factor


@pytest.mark.parametrize("unit", CERTAIN)
def test_a_plan_in_another_unit_is_refused_by_the_name_of_the_unit(
    tmp_path: Path, unit: str
) -> None:
    with pytest.raises(FloorPlanError, match=rf"drawn in {unit}; .*--drawing.scale {UNITS[unit]}"):
        load_floor_plan(drawn_in(unit, tmp_path))


def test_a_plan_in_feet_is_loaded_and_its_check_doubts_it(tmp_path: Path) -> None:
    [fault, *_] = check(load_floor_plan(drawn_in("feet", tmp_path)))
    assert "drawn in feet; " in fault.problem


@pytest.mark.parametrize("unit", [name for name in UNITS if name != "metres"])
def test_the_scale_that_is_named_makes_metres_of_a_plan(tmp_path: Path, unit: str) -> None:
    path = drawn_in(unit, tmp_path)
    plan, report = import_map(path, drawing=Drawing(scale=UNITS[unit]))
    right = load_floor_plan("office_cross")
    assert plan.segments == pytest.approx(right.segments, abs=1e-5)
    assert plan.door_ends == pytest.approx(right.door_ends, abs=1e-5)
    assert report.notes == (f"{UNITS[unit]:g} m a unit",)


def test_the_command_that_is_named_mends_a_plan(tmp_path: Path, capsys: Any) -> None:
    path, out = drawn_in("centimetres", tmp_path), tmp_path / "metres.geojson"
    code, _, said = run(capsys, "map", "check", path)
    assert (code, said.count("\n")) == (2, 1)
    scale = said.split("with ")[1].split()
    assert run(capsys, "map", "import", path, "--out", out, *scale)[0] == 0
    assert run(capsys, "map", "check", out)[0] == 0


def test_an_import_in_feet_has_a_note(tmp_path: Path) -> None:
    _, report = import_map(drawn_in("feet", tmp_path))
    assert "--drawing.scale 0.3048" in report.notes[-1]


@pytest.mark.parametrize("suffix", ["csv", "json"])
def test_lists_of_walls_are_scaled(tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"walls.{suffix}"
    wall = {"p0": {"x": 0, "y": 0}, "p1": {"x": 250, "y": 40}}
    path.write_text("0,0,250,40\n" if suffix == "csv" else json.dumps([wall]))
    plan, _ = import_map(path, drawing=Drawing(scale=0.01))
    assert plan.segments[0] == pytest.approx([0.0, 0.0, 2.5, 0.4])


def test_a_list_of_walls_of_600_m_is_imported_with_a_doubt(tmp_path: Path) -> None:
    path = tmp_path / "walls.csv"
    path.write_text("0,0,600,0\n600,0,600,400\n")
    _, report = import_map(path)
    assert "spans 602 m x 402 m" in report.notes[-1]


@pytest.mark.parametrize(
    "widths", [(), (0.8, 0.9, 90.0), (1.2, 2.5), (0.9,), (1.9, 1.9), (4.0, 0.8)]
)
def test_doors_of_buildings_are_in_metres(widths: tuple[float, ...]) -> None:
    assert unit_fault(widths) is None


def test_a_gate_is_doubted_but_not_refused() -> None:
    assert certain_unit_fault([CERTAIN_WIDTH - 1.0]) is None
    assert unit_fault([CERTAIN_WIDTH - 1.0]) is not None


@pytest.mark.parametrize("name", [*bundled_names(), "office:house:1", "office:large:1"])
def test_our_own_plans_are_in_metres(name: str) -> None:
    assert unit_fault(door.width for door in load_floor_plan(name).doors) is None
