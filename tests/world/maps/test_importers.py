"""Other people's maps as floor plans: what is taken, and what is refused in one line."""

import json
import math
from dataclasses import asdict
from pathlib import Path

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image

from semnav_env.world.lidar import Lidar
from semnav_env.world.maps import Material, load_floor_plan, save_floor_plan
from semnav_env.world.maps.check import check
from semnav_env.world.maps.importers import (
    OccupancyMap,
    OccupancySpec,
    Tracing,
    import_map,
    read_occupancy,
    trace,
)
from semnav_env.world.maps.importers.outlines import outlines
from semnav_scripts import main as cli
from tests.support.drawn_maps import DOORS, FREE, PLACES, SOLID, UNKNOWN, two_rooms, write_map
from tests.support.paths import DATA

EXACT = Tracing(mend=0, simplify=0.0, straighten=0.0)


def pixels_of(solid, resolution=1.0):
    grey = np.where(solid, SOLID, FREE).astype(float)
    return OccupancyMap(("m.pgm",), OccupancySpec(Path("m.pgm"), resolution), grey)


def lines_of(plan):
    return shapely.union_all(shapely.linestrings(plan.segments.reshape(-1, 2, 2)))


@st.composite
def rectilinear(draw):
    """The union of some rectangles, as pixels, and the same made by shapely."""
    corners = st.tuples(st.integers(1, 18), st.integers(1, 14))
    sizes = st.tuples(st.integers(1, 8), st.integers(1, 8))
    solid = np.zeros((24, 28), dtype=bool)
    boxes = []
    for (x, y), (w, h) in draw(st.lists(st.tuples(corners, sizes), min_size=1, max_size=6)):
        solid[y : y + h, x : x + w] = True
        boxes.append(shapely.box(x, 24 - y - h, x + w, 24 - y))
    return solid, shapely.union_all(boxes)


@given(rectilinear(), st.floats(0.01, 0.5))
@settings(max_examples=60)
def test_outlines_of_pixels_are_those_of_the_drawn_walls(drawn, resolution):
    solid, truth = drawn
    lines = lines_of(trace(pixels_of(solid, resolution), EXACT).plan)
    wanted = shapely.transform(truth.boundary, lambda points: resolution * points)
    assert lines.hausdorff_distance(wanted) < 1e-9
    assert lines.length == pytest.approx(wanted.length)


@given(rectilinear(), st.floats(-0.4, 0.4), st.floats(-0.4, 0.4))
@settings(max_examples=60)
def test_a_rasterised_plan_comes_back_to_a_pixel(drawn, dx, dy):
    """Walls four pixels and more apart, anywhere between the pixels' edges."""
    truth = shapely.transform(drawn[1], lambda points: 4.0 * points + (dx, dy))
    columns, rows = np.meshgrid(np.arange(112) + 0.5, 96 - np.arange(96) - 0.5)
    solid = shapely.contains_xy(truth, columns, rows)
    lines = lines_of(trace(pixels_of(solid), Tracing(mend=0)).plan)
    corners = shapely.points(shapely.get_coordinates(lines))
    assert shapely.distance(corners, truth.boundary).max() < 1.0
    assert lines.hausdorff_distance(truth.boundary) < 1.5


@given(rectilinear())
@settings(max_examples=60)
def test_an_outline_runs_round_its_solid_side_counter_clockwise(drawn):
    solid, _ = drawn
    rings = [shapely.Polygon(ring * (1, -1)) for ring in outlines(solid)]
    areas = [(1 if ring.exterior.is_ccw else -1) * ring.area for ring in rings if ring.is_valid]
    if len(areas) == len(rings):
        assert sum(areas) == pytest.approx(solid.sum())


@pytest.mark.parametrize("flip", [1, -1])
def test_no_beam_passes_a_slanted_wall_of_single_pixels(flip):
    solid = np.eye(60, dtype=bool)[:, ::flip]
    plan = trace(pixels_of(solid, 0.1), Tracing(mend=0)).plan
    x, y = (4.5, 4.5 if flip == 1 else 1.5)
    facing = math.atan2(3.0 - y, 3.0 - x)
    ranges = Lidar(plan).exact_ranges((x, y, facing))
    assert np.isfinite(ranges[305:506]).all()  # 33 degrees either way


def test_the_gaps_of_a_perforated_wall_are_mended():
    solid = np.zeros((20, 30), dtype=bool)
    solid[10, ::3] = True
    solid[10, 20:24] = False
    holes = len(trace(pixels_of(solid), EXACT).plan.surfaces)
    whole = trace(pixels_of(solid), Tracing(mend=2, simplify=0.0, straighten=0.0)).plan
    assert (holes, len(whole.surfaces)) == (9, 2)


def test_a_map_is_placed_by_its_origin(tmp_path):
    grey = np.full((4, 5), FREE)
    grey[3, 0] = SOLID
    turned = write_map(tmp_path, grey, origin=[10.0, 20.0, math.pi / 2], resolution=0.5)
    plan, _ = trace(read_occupancy(turned), EXACT)
    west, south, east, north = lines_of(plan).bounds
    np.testing.assert_allclose((west, south, east, north), (9.5, 20.0, 10.0, 20.5), atol=1e-12)


@pytest.mark.parametrize(("negate", "shade"), [(0, 50), (1, 250)])
def test_thresholds_and_negation_are_those_of_map_server(tmp_path, negate, shade):
    grey = np.full((3, 3), UNKNOWN if not negate else 50)
    grey[1, 1] = shade
    path = write_map(tmp_path, grey, negate=negate, occupied_thresh=0.65, free_thresh="1e-2")
    pixels = read_occupancy(path)
    assert pixels.solid.sum() == 1
    assert not pixels.free.any()


@pytest.mark.parametrize("mode", ["1", "L", "RGB", "RGBA", "P", "I;16"])
def test_images_of_every_kind_are_read(tmp_path, mode):
    image = Image.new("L", (6, 4), 255)
    image.paste(0, (2, 1, 3, 2))
    if mode == "I;16":
        image = Image.fromarray(np.asarray(image, dtype=np.uint16) * 257)
    else:
        image = image.convert(mode)
    path = tmp_path / "map.png"
    image.save(path)
    plan, report = import_map(path, resolution=0.2, tracing=EXACT)
    assert lines_of(plan).bounds == pytest.approx((0.4, 0.4, 0.6, 0.6))
    assert report.taken["outlines"] == 1


def test_labels_give_doors_with_the_maps_own_jambs_and_rooms(tmp_path):
    path = write_map(tmp_path, two_rooms())
    (tmp_path / "doors.yaml").write_text(DOORS)
    (tmp_path / "locations.yaml").write_text(PLACES)
    plan, report = import_map(path)
    load_floor_plan(plan)
    between, south = plan.doors
    assert between.open
    assert sorted(y for _, y in (between.start, between.end)) == pytest.approx([1.3, 2.2], abs=0.05)
    assert not south.open
    assert [s.material for s in plan.surfaces].count(Material.LEAF) == 1
    assert [room.name for room in plan.rooms] == ["west", "east"]
    assert plan.region("west").polygon.area == pytest.approx(9.0)
    assert report.left_out == ("door 'nowhere': no wall beside one of its jambs",)
    assert "1 open door, 1 closed door, 2 rooms" in str(report)


def test_a_door_has_the_corridor_on_its_left(tmp_path):
    path = write_map(tmp_path, two_rooms())
    (tmp_path / "doors.yaml").write_text(DOORS)
    for side in ("west", "east"):
        columns = (2, 32) if side == "west" else (35, 65)
        ring = [columns[0], 12, columns[1], 12, columns[1], 19, columns[0], 19]
        (tmp_path / "locations.yaml").write_text(f"locations: [hall]\npolygons: [{ring}]")
        plan, _ = import_map(path)
        (x1, y1), (_, y2) = plan.door("between").start, plan.door("between").end
        assert [hall.name for hall in plan.corridors] == ["hall"]
        assert (y2 > y1) is (side == "west")
        assert x1 == pytest.approx(3.35, abs=0.2)


def test_an_imported_plan_is_saved_and_read_back(tmp_path):
    plan, _ = import_map(write_map(tmp_path, two_rooms()))
    save_floor_plan(plan, tmp_path / "plan.geojson")
    assert load_floor_plan(tmp_path / "plan.geojson") == plan


def test_a_list_of_segments_needs_no_heading(tmp_path):
    path = tmp_path / "walls.csv"
    rows = "0, 0, 4, 0\n# a comment\n\n4,0,4,3\n4,3,4,0\n1,1,1,1\n"
    plans = []
    for heading in ("", "x1,y1,x2,y2\n"):
        path.write_text(heading + rows)
        plan, report = import_map(path)
        plans.append(plan)
        assert report.left_out == ("1 segments shorter than 1 mm", "1 segments repeated")
    assert plans[0] == plans[1]
    np.testing.assert_array_equal(plans[0].segments, [[0, 0, 4, 0], [4, 0, 4, 3]])


def test_the_command_imports_a_map_and_reports(tmp_path, capsys):
    path = write_map(tmp_path, two_rooms())
    (tmp_path / "doors.yaml").write_text(DOORS)
    out, picture = tmp_path / "out" / "plan.geojson", tmp_path / "plan.png"
    words = ["map", "import", str(path), "--out", str(out)]
    assert cli.main([*words, "--picture", str(picture)]) == 0
    said = capsys.readouterr().out
    assert f"wrote {out}" in said
    assert "left out: door 'nowhere'" in said
    last = said.splitlines()[-1]
    assert last.startswith(f"next: `semnav serve`, and drop {out} there")
    assert ("mend the faults" in last) == ("fault: " in said)
    assert len(load_floor_plan(out).doors) == 2
    assert picture.stat().st_size > 0
    assert cli.main([*words, "--json", "--tracing.mend", "0"]) == 0
    reported = json.loads(capsys.readouterr().out)
    assert reported["taken"]["open doors"] == 1
    assert (tmp_path / "out" / "plan_plan.png").stat().st_size > 0


def test_the_command_says_what_is_wrong_with_the_imported_plan(tmp_path, capsys):
    walls = tmp_path / "walls.csv"
    walls.write_text("0,0,8,0\n8,0,8,2\n8,2,0,2\n0,2,0,0\n")
    out = tmp_path / "plan.geojson"
    assert cli.main(["map", "import", str(walls), "--out", str(out), "--json"]) == 0
    faults = json.loads(capsys.readouterr().out)["faults"]
    assert faults == [asdict(fault) for fault in check(load_floor_plan(out))]


def test_a_doorway_between_two_places_needs_no_label(tmp_path):
    path = write_map(tmp_path, two_rooms())
    (tmp_path / "locations.yaml").write_text(PLACES)
    plan, report = import_map(path)
    (door,) = plan.doors
    assert (door.name, door.open) == ("east - west", True)
    assert sorted(y for _, y in (door.start, door.end)) == pytest.approx([1.3, 2.2], abs=0.06)
    assert report.taken["of them without a label"] == 1


def test_a_gap_that_nothing_passes_is_no_doorway(tmp_path):
    grey = two_rooms()
    grey[12:21, 38:40] = SOLID
    path = write_map(tmp_path, grey)
    (tmp_path / "locations.yaml").write_text(PLACES)
    assert import_map(path).plan.doors == ()


@pytest.mark.parametrize(("floor", "doors", "places"), [("2", 11, 14), ("3ne", 24, 39)])
def test_a_real_floor_keeps_all_its_labels(floor, doors, places):
    path = DATA / "gdc_floors" / floor / f"{floor}.yaml"
    if not path.exists():
        pytest.skip("the labelled floors are not here")
    plan, report = import_map(path)
    assert load_floor_plan(plan) is plan
    further = report.taken["of them without a label"]
    assert (len(plan.doors) - further, len(plan.regions)) == (doors, places)
    assert report.left_out == ()
