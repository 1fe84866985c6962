"""Floor plan files: what is wrong is refused in one line that names it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from semnav_env.world.maps import FloorPlanError, load_floor_plan
from semnav_env.world.maps.document import MAX_FEATURES
from semnav_env.world.maps.reader import parse_plan
from tests.support.plan_documents import Document, hall, parse


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
def test_a_wrong_floor_plan_is_refused(text: str, message: str) -> None:
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


def test_unknown_names_list_the_known_ones_and_the_nearest() -> None:
    with pytest.raises(FloorPlanError, match=r"heidelberg_hallway, .*mean heidelberg_hallway\?"):
        load_floor_plan("heidelberg_halway")
    for odd in ("", "a\0b", "x" * 10_000, "no\nplan"):
        with pytest.raises(FloorPlanError, match="there are: heidelberg_hallway"):
            load_floor_plan(odd)
    with pytest.raises(FloorPlanError, match="a name, a path or a FloorPlan"):
        load_floor_plan(None)  # type: ignore[arg-type]
