"""Floor plan files: what is written reads back equal, what is wrong is refused in one line."""

from __future__ import annotations

import copy
import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from jsonschema import Draft202012Validator
from shapely import Polygon, box

from semnav_env.maps import (
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
from semnav_env.maps.document import MAX_FEATURES, SCHEMA_FILE, validator
from semnav_env.maps.library import BUNDLED
from semnav_env.maps.reader import parse_plan
from semnav_env.maps.writer import to_geojson

Document = dict[str, Any]

# a hall of 4 x 3 m with an open, a closed and a half-open door in its south wall
HALL: list[tuple[str, Any, dict[str, Any]]] = [
    ("Polygon", [[[0, 0], [9, 0], [9, 3], [0, 3], [0, 0]]], {"kind": "boundary"}),
    ("LineString", [[1, 0], [0, 0], [0, 3], [9, 3], [9, 0], [8, 0]], {"kind": "wall"}),
    ("LineString", [[2, 0], [4, 0]], {"kind": "wall"}),
    ("LineString", [[5, 0], [7, 0]], {"kind": "wall", "assumed": True}),
    ("LineString", [[4, 0], [5, 0]], {"kind": "leaf"}),
    ("LineString", [[7, 0], [7.5, 0.866]], {"kind": "leaf"}),
    ("LineString", [[1, 0], [2, 0]], {"kind": "door", "name": "one", "state": "open"}),
    ("LineString", [[4, 0], [5, 0]], {"kind": "door", "name": "two", "state": "closed"}),
    ("LineString", [[7, 0], [8, 0]], {"kind": "door", "name": "three", "state": "half-open"}),
    ("Polygon", [[[0, 0], [9, 0], [9, 3], [0, 3], [0, 0]]], {"kind": "corridor", "name": "hall"}),
    ("Polygon", [[[3, 2], [4, 2], [4, 3], [3, 2]]], {"kind": "furniture", "note": "a desk"}),
]


def hall() -> Document:
    features = [
        {"type": "Feature", "properties": p, "geometry": {"type": t, "coordinates": c}}
        for t, c, p in copy.deepcopy(HALL)
    ]
    return {"type": "FeatureCollection", "name": "hall", "features": features}


def parse(document: Document) -> FloorPlan:
    return parse_plan(json.dumps(document), "hall.geojson", "hall")


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


def edit(index: int, value: object, *path: str | int) -> Callable[[Document], None]:
    """Set something inside a feature."""

    def apply(document: Document) -> None:
        target = document["features"][index]
        for key in path[:-1]:
            target = target[key]
        target[path[-1]] = value

    return apply


PLACE = ("geometry", "coordinates")
WRONG: list[tuple[str, Callable[[Document], None], str]] = [
    ("kind", edit(1, "wal", "properties", "kind"), r"feature 2 of 11 \(wal\).*mean 'wall'"),
    ("no kind", edit(1, {}, "properties"), "feature 2 of 11: properties: lacks 'kind'"),
    ("typo", edit(1, True, "properties", "asumed"), "has 'asumed'; only kind, name, state"),
    ("no name", edit(6, {"kind": "door"}, "properties"), r"feature 7 of 11 \(door\).*lacks 'name'"),
    ("text", edit(1, ["1", 2], *PLACE, 0), "must be of type number, not '1'"),
    ("flag", edit(1, [True, 2], *PLACE, 0), "must be of type number, not True"),
    ("3d", edit(1, [1, 2, 3], *PLACE, 0), r"coordinates.0: .* length of 3; at most 2"),
    ("one point", edit(1, [[1, 2]], *PLACE), "length of 1; at least 2"),
    ("point", edit(1, {"type": "Point", "coordinates": [1, 2]}, "geometry"), "LineString, Polygon"),
    ("room line", edit(9, "LineString", "geometry", "type"), "must be 'Polygon', not 'LineString'"),
    ("state", edit(6, "ajar", "properties", "state"), "must be one of open, half-open, closed"),
    ("far", edit(1, [1e7, 0], *PLACE, 0), "at most 1000 from the origin"),
    ("infinite", edit(1, [10**400, 0], *PLACE, 0), "coordinates are finite"),
    ("twice", edit(1, [0, 0], *PLACE, 0), r"repeats the point \(0.000, 0.000\)"),
    ("ring", edit(9, [0, 1], *PLACE, 0, -1), "repeat its first position as its last"),
    (
        "crossing",
        edit(9, [[[0, 0], [9, 3], [9, 0], [0, 3], [0, 0]]], *PLACE),
        r"feature 10 of 11 \(corridor hall\).*not a simple polygon.*4.5 1.5",
    ),
    (
        "crossing boundary",
        edit(0, [[[0, 0], [9, 3], [9, 0], [0, 3], [0, 0]]], *PLACE),
        "the boundary is not a simple polygon",
    ),
    ("flat", edit(9, [[[0, 0], [9, 0], [0, 0], [0, 0]]], *PLACE), "not a simple polygon"),
    ("same name", edit(7, "one", "properties", "name"), "2 doors are named 'one'"),
    ("blank name", edit(7, " two", "properties", "name"), "use visible characters"),
    ("hidden name", edit(7, "t\u202ewo", "properties", "name"), "use visible characters"),
    ("half a letter", edit(7, "\ud800", "properties", "name"), "use visible characters"),
    ("hanging", edit(6, [[1, 1], [2, 1]], *PLACE), r"door 'one' ends at \(1.000, 1.000\)"),
    ("outside", edit(6, [[1, 0], [2, -2]], *PLACE), "door 'one' leaves the boundary"),
    ("point door", edit(6, [[1, 0], [1, 0]], *PLACE), "is 0.00 m wide"),
    ("no leaf", edit(7, "open", "properties", "state"), "'two' is open, but something solid fills"),
    ("leaf", edit(6, "closed", "properties", "state"), r"draw a leaf from \(1.000, 0.000\)"),
    ("half", edit(8, "open", "properties", "state"), "called open, but is drawn half-open"),
    ("ajar", edit(5, [[7, 0], [7.95, 0.3]], *PLACE), r"leaves only 0.\d\d m; leave 0.5 m"),
    ("region", edit(9, [[[0, 0], [9, 0], [9, 5], [0, 0]]], *PLACE), "'hall' leaves the boundary"),
    ("second boundary", edit(9, "boundary", "properties", "kind"), "2 features of kind boundary"),
    ("no boundary", edit(0, "furniture", "properties", "kind"), "0 features of kind boundary"),
    ("feature", lambda d: d["features"].__setitem__(3, 5), "feature 4 of 11: must be of type obj"),
    ("no features", lambda d: d.update(features=[]), "features: .* at least 1"),
    ("features", lambda d: d.pop("features"), "lacks 'features'"),
    ("degrees", lambda d: d.update(units="degree"), "units: must be 'metre', not 'degree'"),
    ("type", lambda d: d.update(type="Topology"), "must be 'FeatureCollection'"),
    ("many", lambda d: d.update(features=[0] * (MAX_FEATURES + 1)), "10,001 features; at most 10,"),
    (
        "detailed",
        edit(1, [[i, i % 2] for i in range(50_001)], *PLACE),
        "more than 50,000 positions",
    ),
    ("name", lambda d: d.update(name=""), "name: '' has a length of 0; at least 1"),
]


@pytest.mark.parametrize(("change", "message"), [w[1:] for w in WRONG], ids=[w[0] for w in WRONG])
def test_what_is_wrong_is_named_in_one_line(
    change: Callable[[Document], None], message: str
) -> None:
    document = hall()
    change(document)
    with pytest.raises(FloorPlanError, match=message) as caught:
        parse(document)
    text = str(caught.value)
    assert text.startswith("hall.geojson: ")
    assert "\n" not in text
    assert len(text) < 400


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "not JSON: Expecting value at line 1, column 1"),
        ("{", "not JSON"),
        ('{"type": NaN}', "holds NaN"),
        ("[1, -Infinity]", "holds -Infinity"),
        ("[" * 100_000, "nested too deeply"),
        ('{"a":' * 100_000, "nested too deeply"),
        ("[" * 900 + "]" * 900, "nested too deeply|must be of type object"),
        ("null", "must be of type object, not None"),
        ("9" * 6000, "must be of type object, not inf"),
    ],
)
def test_what_is_no_plan_at_all_is_refused(text: str, message: str) -> None:
    with pytest.raises(FloorPlanError, match=message):
        parse_plan(text, "text", "name")


def test_files_that_cannot_be_read_are_refused(tmp_path: Path) -> None:
    latin = tmp_path / "latin.geojson"
    latin.write_bytes('{"name": "Büro"}'.encode("latin-1"))
    with pytest.raises(FloorPlanError, match=r"latin.geojson: byte 11 is not UTF-8"):
        load_floor_plan(latin)
    with pytest.raises(FloorPlanError, match="is a folder"):
        load_floor_plan(tmp_path)
    with pytest.raises(FloorPlanError, match="no such file"):
        load_floor_plan(str(tmp_path / "missing.geojson"))
    with pytest.raises(FloorPlanError, match="cannot be read"):
        load_floor_plan(tmp_path / ("x" * 300))
    large = tmp_path / "large.geojson"
    with large.open("wb") as file:
        file.truncate(20_000_001)
    with pytest.raises(FloorPlanError, match=r"20,000,001 bytes; at most 20,000,000"):
        load_floor_plan(large)


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


def _nodes(value: Any, path: tuple[str | int, ...] = ()) -> list[tuple[str | int, ...]]:
    items = value.items() if isinstance(value, dict) else enumerate(value)
    children = [(item, (*path, key)) for key, item in items]
    deeper = [_nodes(item, p) for item, p in children if isinstance(item, dict | list)]
    return [p for _, p in children] + [p for found in deeper for p in found]


NODES = _nodes(hall())
odd_values = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(-(10**30), 10**30),
    st.floats(),
    st.text(max_size=5),
    st.lists(st.floats(), max_size=3),
    st.just({}),
    st.sampled_from(["wall", "door", "room", "boundary", "Polygon", "LineString", "closed"]),
)


@settings(max_examples=250, deadline=None)
@given(st.lists(st.tuples(st.sampled_from(NODES), odd_values), min_size=1, max_size=3))
def test_damaged_documents_load_or_are_refused(
    damage: list[tuple[tuple[str | int, ...], object]],
) -> None:
    document: Any = hall()
    for path, value in damage:
        _replace(document, path, value)
    plan = _plan_or_error(json.dumps(document))
    if isinstance(plan, FloorPlan):
        assert parse_plan(to_geojson(plan), "again", "hall") == plan
    else:
        assert plan.startswith("damaged: ")
        assert "\n" not in plan


def _replace(target: Any, path: tuple[str | int, ...], value: object) -> None:
    try:
        for key in path[:-1]:
            target = target[key]
        target[path[-1]] = value
    except (TypeError, KeyError, IndexError):
        return  # an earlier change removed the place


@settings(max_examples=100, deadline=None)
@given(st.data())
def test_damaged_bytes_load_or_are_refused(data: st.DataObject) -> None:
    text = (BUNDLED / "villa_hall.geojson").read_text("utf-8")
    start = data.draw(st.integers(0, len(text)))
    cut = data.draw(st.integers(0, 40))
    patch = data.draw(st.text(max_size=5))
    plan = _plan_or_error(text[:start] + patch + text[start + cut :])
    assert isinstance(plan, FloorPlan) or plan.startswith("damaged: ")


def _plan_or_error(text: str) -> FloorPlan | str:
    try:
        return parse_plan(text, "damaged", "name")
    except FloorPlanError as error:
        return str(error)


def test_the_schema_is_a_schema() -> None:
    Draft202012Validator.check_schema(json.loads(SCHEMA_FILE.read_text("utf-8")))
    assert validator().is_valid(hall())


def test_unknown_names_list_the_known_ones_and_the_nearest() -> None:
    with pytest.raises(FloorPlanError, match=r"heidelberg_hallway, .*mean heidelberg_hallway\?"):
        load_floor_plan("heidelberg_halway")
    for odd in ("", "a\0b", "x" * 10_000, "no\nplan"):
        with pytest.raises(FloorPlanError, match="there are: heidelberg_hallway"):
            load_floor_plan(odd)
    with pytest.raises(FloorPlanError, match="a name, a path or a FloorPlan"):
        load_floor_plan(None)  # type: ignore[arg-type]


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
