"""Floor plan files: what is written reads back equal, and what else one may hold does no harm."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from jsonschema import Draft202012Validator
from shapely import Polygon, box

from semnav_env.world.maps import (
    FloorPlan,
    FloorPlanError,
    Material,
    PlanDoor,
    Region,
    Surface,
    bundled_names,
    load_floor_plan,
    save_floor_plan,
)
from semnav_env.world.maps.reader import parse_plan
from semnav_env.world.maps.schema import SCHEMA_FILE, validator
from semnav_env.world.maps.writer import to_geojson
from tests.support.plan_documents import hall, parse


def test_the_hall_reads() -> None:
    plan = parse(hall())
    assert [(door.name, door.open) for door in plan.doors] == [
        ("one", True),
        ("two", False),
        ("three", True),
    ]
    assert [surface.material for surface in plan.surfaces].count(Material.LEAF) == 2
    assert plan.surfaces[2].assumed
    assert plan.surfaces[-1].points[0] == plan.surfaces[-1].points[-1]


@pytest.mark.parametrize("name", bundled_names())
def test_bundled_plans_read_back_equal(name: str, tmp_path: Path) -> None:
    plan = load_floor_plan(name)
    save_floor_plan(plan, tmp_path / "copy.geojson")
    again = load_floor_plan(tmp_path / "copy.geojson")
    assert again == plan
    assert to_geojson(again) == to_geojson(plan)


numbers = st.floats(-50, 50, allow_nan=False)
points = st.tuples(numbers, numbers)
names = st.text(st.characters(categories=["L", "N", "P"]), min_size=1, max_size=20)
materials = st.sampled_from(Material)


@st.composite
def surfaces(draw: st.DrawFn) -> Surface:
    """A line of segments of 1 to 20 m that may cross itself, or close."""
    steps = draw(st.lists(st.tuples(st.floats(1, 20), st.floats(0, 6)), min_size=1, max_size=4))
    line = [draw(points)]
    for length, turn in steps:
        line.append((line[-1][0] + length, line[-1][1] + turn))
    if len(line) > 2 and draw(st.booleans()):
        line.append(line[0])
    return Surface(tuple(line), draw(materials), draw(st.booleans()))


@st.composite
def regions(draw: st.DrawFn) -> Polygon:
    x, y = draw(points)
    outer = box(x, y, x + draw(st.floats(1, 20)), y + draw(st.floats(1, 20)))
    return (
        outer.difference(box(x + 0.2, y + 0.2, x + 0.4, y + 0.6)) if draw(st.booleans()) else outer
    )


@st.composite
def plans(draw: st.DrawFn) -> FloorPlan:
    """A wall along y = -60 with doors in it, anything north of it."""
    count = draw(st.integers(0, 3))
    widths = draw(st.lists(st.floats(0.7, 1.5), min_size=count, max_size=count))
    lots: list[Surface] = []
    doors: list[PlanDoor] = []
    at = -40.0
    for width, name in zip(widths, draw(_distinct(names, count)), strict=True):
        is_open = draw(st.booleans())
        lots.append(Surface(((at, -60.0), (at + 1, -60.0))))
        doors.append(PlanDoor(name, (at + 1, -60.0), (at + 1 + width, -60.0), is_open))
        if not is_open:
            lots.append(Surface((doors[-1].start, doors[-1].end), Material.LEAF))
        at += 1 + width
    lots.append(Surface(((at, -60.0), (at + 1, -60.0))))
    named = draw(_distinct(names, 3))
    areas = [Region(n, draw(regions()), draw(st.booleans())) for n in named]
    return FloorPlan(
        name=draw(names),
        surfaces=(*lots, *draw(st.lists(surfaces(), max_size=4))),
        doors=tuple(doors),
        rooms=(areas[0],),
        corridors=(areas[1],),
        intersections=(areas[2],),
        boundary=box(-80, -80, 150, 150),
        source=draw(st.text(max_size=30)),
    )


def _distinct(texts: st.SearchStrategy[str], count: int) -> st.SearchStrategy[list[str]]:
    return st.lists(texts, min_size=count, max_size=count, unique=True)


@settings(max_examples=60, deadline=None)
@given(plans())
def test_any_valid_plan_reads_back_equal(plan: FloorPlan) -> None:
    assert parse_plan(to_geojson(plan), "text", "other name") == plan


def test_saving_refuses_what_could_not_be_loaded(tmp_path: Path) -> None:
    plan = parse(hall())
    for wrong in (
        replace(plan, doors=plan.doors * 2),
        replace(plan, name=""),
        replace(plan, name="x" * 100),
        replace(plan, source="\ud800"),
        replace(plan, surfaces=(*plan.surfaces, Surface(((0, 0), (float("nan"), 1))))),
    ):
        with pytest.raises(FloorPlanError):
            save_floor_plan(wrong, tmp_path / "wrong.geojson")
    assert not list(tmp_path.iterdir())


def test_a_plan_given_as_such_is_checked_too() -> None:
    plan = parse(hall())
    assert load_floor_plan(plan) is plan
    with pytest.raises(FloorPlanError, match="finite"):
        load_floor_plan(replace(plan, boundary=Polygon([(0, 0), (float("inf"), 0), (1, 1)])))


def test_a_byte_order_mark_does_no_harm(tmp_path: Path) -> None:
    path = tmp_path / "hall.geojson"
    path.write_text(json.dumps(hall()), encoding="utf-8-sig")
    assert load_floor_plan(path) == parse(hall())


def test_null_attributes_of_drawing_programs_are_ignored() -> None:
    document = hall()
    for feature in document["features"]:
        feature["properties"] = {"name": None, "state": None, "note": None} | feature["properties"]
    assert parse(document) == parse(hall())


def test_a_plan_without_a_name_is_called_after_its_file(tmp_path: Path) -> None:
    document = hall()
    del document["name"]
    path = tmp_path / "cellar.geojson"
    path.write_text(json.dumps(document), encoding="utf-8")
    assert load_floor_plan(path).name == "cellar"


def test_the_schema_is_a_schema() -> None:
    Draft202012Validator.check_schema(json.loads(SCHEMA_FILE.read_text("utf-8")))
    assert validator().is_valid(hall())


def test_a_file_is_read_anew_only_after_it_has_changed(tmp_path: Path) -> None:
    path = tmp_path / "plan.geojson"
    save_floor_plan(load_floor_plan("villa_hall"), path)
    first = load_floor_plan(path)
    assert load_floor_plan(str(path)) is first
    save_floor_plan(load_floor_plan("office_cross"), path)
    assert load_floor_plan(path) == load_floor_plan("office_cross")
    path.unlink()
    with pytest.raises(FloorPlanError, match=r"plan\.geojson"):
        load_floor_plan(path)
