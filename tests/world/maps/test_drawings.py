"""Floor plans from drawings: DXF, SVG and the houses of HouseExpo."""

from __future__ import annotations

import json
import math
import sys
import tempfile
from pathlib import Path

import ezdxf
import numpy as np
import pytest
import shapely
from ezdxf.enums import InsertUnits
from hypothesis import given, settings
from hypothesis import strategies as st

from semnav_env.world.maps import FloorPlan, load_floor_plan
from semnav_env.world.maps.importers import Drawing, import_map
from semnav_env.world.maps.rules import FloorPlanError
from semnav_scripts import main as cli

WALLS = ((0, 0), (4, 0), (4, 3), (0, 3), (0, 0)), ((2, 0), (2, 1)), ((2, 2), (2, 3))
"""Two rooms of 2 m by 3 m with a doorway of 1 m at (2, 1) to (2, 2)."""

SVG = '<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" {}>{}</svg>'  # noqa: E501


def geometry(plan: FloorPlan) -> shapely.Geometry:
    return shapely.union_all(shapely.linestrings(plan.segments.reshape(-1, 2, 2)))


def is_as_drawn(plan: FloorPlan) -> bool:
    """Whether the walls are `WALLS` within 0.1 mm."""
    walls = shapely.union_all([shapely.LineString(line) for line in WALLS])
    found = geometry(plan)
    apart = shapely.hausdorff_distance(walls, found, densify=0.05)
    return bool(apart < 1e-4 and abs(walls.length - found.length) < 1e-3)


def dxf(path: Path, unit: InsertUnits = InsertUnits.Meters, metres: float = 1.0) -> Path:
    """The walls as a line, polylines and a block, a swing on another layer, and a text."""
    document = ezdxf.new(units=unit)
    space = document.modelspace()
    outline, first, second = ([(x / metres + 7, y / metres - 9) for x, y in line] for line in WALLS)
    space.add_lwpolyline(outline, dxfattribs={"layer": "A-WALL"})
    space.add_line(*first, dxfattribs={"layer": "A-WALL"})
    block = document.blocks.new("partition")
    block.add_polyline2d([(0, 0), (0, second[1][1] - second[0][1])])
    space.add_blockref("partition", second[0], dxfattribs={"layer": "A-WALL"})
    hinge = (2 / metres + 7, 1 / metres - 9)
    space.add_arc(hinge, 1 / metres, 0, 90, dxfattribs={"layer": "A-DOOR"})
    leaf = (3 / metres + 7, 1 / metres - 9)
    space.add_line(hinge, leaf, dxfattribs={"layer": "A-DOOR"})
    space.add_text("kitchen", dxfattribs={"layer": "A-TEXT"})
    document.saveas(path)
    return path


LAYERS = Drawing(walls=("A-WALL",), doors=("A-DOOR",))


@pytest.mark.parametrize(
    ("unit", "metres"),
    [(InsertUnits.Meters, 1.0), (InsertUnits.Millimeters, 0.001), (InsertUnits.Inches, 0.0254)],
)
def test_lines_polylines_and_blocks_are_walls_in_header_units(
    unit: InsertUnits, metres: float, tmp_path: Path
) -> None:
    plan, report = import_map(dxf(tmp_path / "a.dxf", unit, metres), drawing=LAYERS)
    assert is_as_drawn(plan)
    assert report.left_out == ("layer A-DOOR: 1 of 2 lines give no door", "1 TEXT")


def test_a_hinge_and_the_facing_jamb_make_a_door(tmp_path: Path) -> None:
    plan, _ = import_map(dxf(tmp_path / "a.dxf"), drawing=LAYERS)
    (door,) = plan.doors
    assert door.open
    assert {door.start, door.end} == {(2.0, 1.0), (2.0, 2.0)}


def test_each_layer_has_doors_from_its_arcs_or_from_its_lines(tmp_path: Path) -> None:
    """Swinging doors on one layer, a sliding door and a line that is too long on another."""
    path = dxf(tmp_path / "a.dxf")
    document = ezdxf.readfile(path)
    for start in ((8.5, -9), (7, -8)):
        document.modelspace().add_line(start, (9.5, -9), dxfattribs={"layer": "A-SLIDE"})
    document.saveas(path)
    both = Drawing(walls=("A-WALL",), doors=("A-DOOR", "A-SLIDE"))
    plan, report = import_map(path, drawing=both)
    assert [{door.start, door.end} for door in plan.doors] == [
        {(2.0, 1.0), (2.0, 2.0)},
        {(1.5, 0.0), (2.5, 0.0)},
    ]
    assert report.left_out == (
        "layer A-DOOR: 1 of 2 lines give no door",
        "layer A-SLIDE: 1 of 2 lines give no door",
        "1 TEXT",
    )


@given(st.floats(-math.pi, math.pi), st.floats(0.5, 2.0), st.sampled_from((1, -1)))
@settings(max_examples=20)
def test_a_transformed_block_is_drawn_where_it_is_placed(
    turn: float, size: float, mirror: int
) -> None:
    document = ezdxf.new(units=InsertUnits.Meters)
    block = document.blocks.new("outline")
    block.add_lwpolyline([(0, 0), (4, 0), (4, 3), (0, 1)], close=True)
    told = {"rotation": math.degrees(turn), "xscale": size * mirror, "yscale": size}
    document.modelspace().add_blockref("outline", (5, -2), dxfattribs=told)
    with tempfile.TemporaryDirectory() as folder:
        document.saveas(Path(folder) / "block.dxf")
        plan, _ = import_map(Path(folder) / "block.dxf")
    ring = geometry(plan)
    area = shapely.polygonize([ring]).area
    assert area == pytest.approx(8.0 * size**2)
    assert ring.length == pytest.approx((4 + 3 + math.hypot(4, 2) + 1) * size)


def test_a_block_that_holds_itself_is_refused(tmp_path: Path) -> None:
    document = ezdxf.new(units=InsertUnits.Meters)
    block = document.blocks.new("endless")
    block.add_blockref("endless", (1, 0))
    document.modelspace().add_blockref("endless", (0, 0))
    document.saveas(tmp_path / "endless.dxf")
    with pytest.raises(FloorPlanError, match="blocks within blocks"):
        import_map(tmp_path / "endless.dxf")


def test_circles_become_lines_within_a_centimetre(tmp_path: Path) -> None:
    document = ezdxf.new(units=InsertUnits.Millimeters)
    document.modelspace().add_circle((3000, 2000), 1500)
    document.saveas(tmp_path / "round.dxf")
    plan, _ = import_map(tmp_path / "round.dxf")
    middles = plan.segments.reshape(-1, 2, 2).mean(axis=1)
    assert np.abs(np.hypot(*(middles - 1.5).T) - 1.5).max() < 0.0101


def test_layers_that_are_off_are_left_out_unless_they_are_named(tmp_path: Path) -> None:
    path = dxf(tmp_path / "a.dxf")
    document = ezdxf.readfile(path)
    document.layers.add("A-FURN").off()
    document.modelspace().add_line((7, -9), (8, -8), dxfattribs={"layer": "A-FURN"})
    document.saveas(path)
    plan, report = import_map(path, drawing=Drawing(doors=("A-DOOR",)))
    assert is_as_drawn(plan)
    assert "1 lines on layer A-FURN, which is off" in report.left_out
    named, _ = import_map(path, drawing=Drawing(walls=("A-WALL", "A-FURN")))
    assert len(named.segments) == len(plan.segments) + 1


def svg(path: Path, body: str, head: str = "") -> Path:
    path.write_text(SVG.format(head, body))
    return path


SHAPES = """
<g id="walls"><rect x="0" y="0" width="400" height="300"/>
<g transform="translate(200,0)"><line x1="0" y1="300" x2="0" y2="200"/><path d="M0,100 V0"/></g></g>
<g inkscape:label="doors" id="layer2"><path d="M200,100 A100,100 0 0 1 300,200"/></g>
<text x="9" y="9">kitchen</text>
<g style="display:none"><line x1="0" y1="0" x2="900" y2="900"/></g>
"""


@pytest.mark.parametrize(
    "head", ["", 'viewBox="0 0 400 300"', 'width="80mm" height="60mm" viewBox="0 0 400 300"']
)
def test_shapes_are_walls_with_y_upward_in_units_of_the_view_box(head: str, tmp_path: Path) -> None:
    drawing = Drawing(scale=0.01, doors=("doors",))
    plan, report = import_map(svg(tmp_path / "a.svg", SHAPES, head), drawing=drawing)
    assert is_as_drawn(plan)
    assert report.left_out == ("1 text",)
    (door,) = plan.doors
    assert door.open
    assert sorted((door.start, door.end)) == [
        pytest.approx((2.0, 1.0), abs=1e-4),
        pytest.approx((2.0, 2.0), abs=1e-4),
    ]


HOUSE = {
    "id": "house",
    "verts": [[0, 0], [6, 0], [6, 4], [0, 4]],
    "room_category": {"Bedroom": [[0, 0, 3, 4], [3, 0, 5, 4]], "Hallway": [[5, 0, 6, 4]]},
}


def house(path: Path, **changes: object) -> Path:
    path.write_text(json.dumps(HOUSE | changes))
    return path


def test_a_house_has_its_outline_and_its_categories_as_rooms(tmp_path: Path) -> None:
    plan, report = import_map(house(tmp_path / "a.json"))
    assert shapely.polygonize([geometry(plan)]).area == pytest.approx(24.0)
    assert plan.room_names == ("bedroom 1", "bedroom 2")
    assert [corridor.name for corridor in plan.corridors] == ["hallway 1"]
    assert report.taken == {"segments": 4, "rooms": 2, "corridors": 1}
    half, _ = import_map(house(tmp_path / "a.json"), drawing=Drawing(scale=0.5))
    assert half.region("bedroom 1").polygon.area == pytest.approx(3.0)


@pytest.mark.parametrize(
    ("name", "content", "drawing", "said"),
    [
        ("a.svg", "walls", Drawing(scale=1.0), "no SVG drawing"),
        ("a.svg", "<html></html>", Drawing(scale=1.0), "no SVG drawing"),
        ("a.svg", SVG.format("", SHAPES), Drawing(), "give the scale"),
        (
            "a.svg",
            SVG.format("", SHAPES),
            Drawing(0.01, ("wall",)),
            r"no layer 'wall'.*walls \(3\)",
        ),
        ("a.svg", SVG.format("", SHAPES), Drawing(10.0), "at most 1,000 m"),
        ("a.svg", SVG.format("", "<text>a</text>"), Drawing(1.0), "no line that could be a wall"),
        ("a.svg", '<!DOCTYPE a [<!ENTITY b "c">]>' + SVG.format("", ""), Drawing(1.0), "entities"),
        ("a.svg", '<g xmlns="http://www.w3.org/2000/svg"/>', Drawing(1.0), "no SVG drawing"),
        ("a.dxf", "walls", Drawing(), "no DXF drawing"),
        ("a.json", '{"verts": 3}', None, "verts"),
        ("a.json", '{"verts": [[0, 0], [1, 1]]}', None, "at least three"),
        ("a.json", '{"verts": [[0, 0], [9e9, 1], [0, 1]]}', None, "give the scale"),
        ("a.json", '{"verts": [[0, 0], [NaN, 1], [0, 1]]}', None, "not finite"),
        ("a.json", '{"verts": [[0, 0], [1, 1], [0, 1]], "room_category": [3]}', None, "category"),
    ],
)
def test_each_kind_of_bad_file_gets_one_clear_error(
    name: str, content: str, drawing: Drawing | None, said: str, tmp_path: Path
) -> None:
    path = tmp_path / name
    path.write_text(content)
    with pytest.raises(FloorPlanError, match=said) as error:
        import_map(path, drawing=drawing)
    assert "\n" not in str(error.value)
    assert name in str(error.value)


def test_missing_units_ask_for_the_scale(
    tmp_path: Path,
) -> None:
    """A wrong layer is answered with the layers there are."""
    path = dxf(tmp_path / "a.dxf", InsertUnits.Unitless)
    with pytest.raises(FloorPlanError, match=r"INSUNITS.*0\.001 for millimetres"):
        import_map(path)
    plan, _ = import_map(path, drawing=Drawing(1.0, ("A-WALL",)))
    assert is_as_drawn(plan)
    with pytest.raises(FloorPlanError, match=r"no layer 'WALL'.*A-DOOR \(2\), A-WALL \(3\)"):
        import_map(path, drawing=Drawing(1.0, ("WALL",)))


def test_a_reader_error_without_text_is_named_by_its_kind(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fails(path: Path) -> None:
        raise TypeError

    (tmp_path / "a.dxf").write_text("0")
    monkeypatch.setattr("ezdxf.recover.readfile", fails)
    with pytest.raises(FloorPlanError, match="no DXF drawing: TypeError"):
        import_map(tmp_path / "a.dxf")


def test_missing_files_and_libraries_are_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("a.dxf", "a.svg"):
        with pytest.raises(FloorPlanError, match="cannot be read"):
            import_map(tmp_path / name)
    monkeypatch.setitem(sys.modules, "svgelements", None)
    monkeypatch.setitem(sys.modules, "ezdxf", None)
    for name in ("a.dxf", "a.svg"):
        with pytest.raises(FloorPlanError, match=r"pip install 'semnav-env\[import\]'"):
            import_map(tmp_path / name)


def test_the_command_takes_scale_and_layers(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "plan.geojson"
    words = ["map", "import", str(dxf(tmp_path / "a.dxf")), "--out", str(out)]
    layers = ["--drawing.walls", "A-WALL", "--drawing.doors", "A-DOOR"]
    assert cli.main([*words, *layers]) == 0
    assert ", 1 door" in capsys.readouterr().out
    assert [door.name for door in load_floor_plan(str(out)).doors] == ["door 1"]
    assert cli.main([*words, "--drawing.walls", "nowhere"]) == 2
