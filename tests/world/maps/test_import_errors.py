"""Maps that cannot be imported are refused in one line that names what is wrong."""

import math
import re
from pathlib import Path

import pytest

from semnav_env.world.maps import FloorPlanError
from semnav_env.world.maps.importers import Tracing, import_map
from tests.support.drawn_maps import two_rooms, write_map

GOOD = "image: floor.pgm\nresolution: 0.1\norigin: [0, 0, 0]\n"


@pytest.mark.parametrize(
    ("name", "text", "words"),
    [
        ("a.yaml", "image: floor.pgm\norigin: [0, 0, 0]", ("a.yaml", "resolution")),
        ("a.yaml", GOOD.replace("0.1", "-1"), ("resolution is -1", "0.001 to 10")),
        ("a.yaml", GOOD.replace("0.1", "abc"), ("abc", "resolution is a number")),
        ("a.yaml", GOOD.replace("[0, 0, 0]", "[0]"), ("origin is [x, y, heading]",)),
        ("a.yaml", GOOD.replace("[0, 0, 0]", "[0, .nan, 0]"), ("not finite",)),
        ("a.yaml", GOOD.replace("floor.pgm", "none.pgm"), ("none.pgm", "cannot be read")),
        ("a.yaml", GOOD.replace("floor.pgm", "a.yaml"), ("a.yaml", "PNG")),
        ("a.yaml", GOOD + "mode: raw", ("raw", "trinary")),
        (
            "a.yaml",
            GOOD + "occupied_thresh: 0.1",
            ("free_thresh", "occupied_thresh, which is 0.1"),
        ),
        ("a.yaml", GOOD + "occupied_thresh: 1.0", ("no pixel is darker", "negate")),
        ("a.yaml", "[" * 5000, ("a.yaml", "not YAML")),
        ("a.yaml", "a: [", ("a.yaml", "not YAML")),
        ("a.yaml", "just text", ("image, resolution, origin",)),
        ("a.pgm", "P5 1 1 255 ", ("resolution", "0.05")),
        ("a.json", "[]", ("holds no wall",)),
        ("a.json", '[{"p0": {"x": 1, "y": NaN}, "p1": {"x": 1, "y": 2}}]', ("not finite", "p0")),
        ("a.json", '[{"p0": {"x": 1}}]', ("p0",)),
        ("a.json", "[" * 100_000, ("not a vector map",)),
        ("a.csv", "", ("holds no wall",)),
        ("a.csv", "0,0,1,1\n0,0,1\n", ("line 2", "x1, y1, x2, y2")),
        ("a.csv", "0,0,1,1\n0,0,1,inf\n", ("line 2", "not finite")),
        ("a.stl", "", ("a.stl", ".yaml", ".json", ".csv")),
    ],
)
def test_what_cannot_be_imported_is_refused_in_one_line(tmp_path, name, text, words):
    write_map(tmp_path, two_rooms())
    path = tmp_path / name
    path.write_text(text)
    with pytest.raises(FloorPlanError) as error:
        import_map(path)
    message = str(error.value)
    assert "\n" not in message
    assert all(word in message for word in words), message


@pytest.mark.parametrize(
    ("name", "text", "words"),
    [
        ("doors.yaml", "a: 1", ("doors.yaml", "no list of doors", "door_corner_pt_1")),
        ("doors.yaml", "- {name: a, door_corner_pt_1: [0, 0]}", ("door 1", "door_corner_pt_2")),
        (
            "doors.yaml",
            "- {name: a, door_corner_pt_1: [0, 0], door_corner_pt_2: [0, 0]}",
            ("door 1", "the same"),
        ),
        ("locations.yaml", "locations: [a]", ("locations.yaml", "polygons")),
        ("locations.yaml", "locations: [a]\npolygons: []", ("1 locations but 0 polygons",)),
        ("locations.yaml", "locations: [a]\npolygons: [[1, 2, 3]]", ("place 1", "corners")),
    ],
)
def test_labels_that_cannot_be_read_are_refused_in_one_line(tmp_path, name, text, words):
    path = write_map(tmp_path, two_rooms())
    (tmp_path / name).write_text(text)
    with pytest.raises(FloorPlanError) as error:
        import_map(path)
    message = str(error.value)
    assert "\n" not in message
    assert all(word in message for word in words), message


@pytest.mark.parametrize("limit", [{"mend": -1}, {"mend": 11}, {"simplify": math.nan}])
def test_how_walls_are_traced_is_checked(limit):
    with pytest.raises(ValueError, match=f"{next(iter(limit))} is .* it must be .* from 0 to"):
        Tracing(**limit)


def test_a_huge_image_is_refused_before_it_is_decoded(tmp_path):
    path = tmp_path / "huge.pgm"
    path.write_bytes(b"P5 60000 60000 255\n")
    with pytest.raises(FloorPlanError, match="25,000,000"):
        import_map(path, resolution=0.05)


@pytest.mark.parametrize(
    ("name", "text", "words"),
    [
        ("bad.csv", "0,0,1,0\n1,2\n", "line 2: has 2 values, not 4; each line has x1, y1, x2, y2"),
        ("bad.json", '{"a": 1}', "not a vector map (no list of objects); it must be a list of"),
        ("bad.json", '["x"]', "not a vector map (no list of objects); it must be a list of"),
        ("empty.dxf", "", "is empty; give a DXF drawing"),
    ],
)
def test_what_holds_something_else_is_said_in_words_of_the_file(
    name: str, text: str, words: str, tmp_path: Path
) -> None:
    (tmp_path / name).write_text(text)
    with pytest.raises(FloorPlanError, match=re.escape(words)):
        import_map(tmp_path / name)
