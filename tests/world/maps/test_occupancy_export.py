"""A floor plan that is exported as a map and imported again is the same within a pixel."""

from __future__ import annotations

import json
import tempfile
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from PIL import Image

from semnav_env.world.maps import (
    FloorPlan,
    PlanDoor,
    Region,
    Surface,
    bundled_names,
    load_floor_plan,
)
from semnav_env.world.maps.check import check
from semnav_env.world.maps.doorways import DoorState, door_state
from semnav_env.world.maps.importers import Tracing, import_map
from semnav_env.world.maps.importers.building_doors import without_leaves
from semnav_env.world.maps.importers.imported import ImportedPlan
from semnav_env.world.maps.occupancy_export import draw_pixels, export_map
from semnav_env.world.maps.rules import FloorPlanError
from semnav_scripts import main as cli
from tests.support.small_plans import closed

EXACT = Tracing(mend=0, simplify=0.0, straighten=0.0)


def there_and_back(plan: FloorPlan, folder: Path, resolution: float, image: str) -> ImportedPlan:
    path = folder / "map.yaml"
    export_map(plan, path, resolution, image)
    return import_map(path, tracing=EXACT)


def walls(plan: FloorPlan) -> shapely.MultiLineString:
    return shapely.multilinestrings(shapely.linestrings(plan.segments.reshape(-1, 2, 2)))


def farthest(a: FloorPlan, b: FloorPlan, step: float) -> float:
    """How far a wall of one plan lies from those of the other, metres."""
    points = shapely.points(shapely.get_coordinates(shapely.segmentize(walls(a), step)))
    return float(shapely.distance(walls(b), points).max())


@st.composite
def storeys(draw: st.DrawFn, *, slanted: bool = True) -> FloorPlan:
    """Rooms beside each other, with a doorway or none in each partition, and a slanted wall."""
    cm = st.integers(0, 99).map(lambda value: value / 100)
    corners = [draw(st.integers(-20, 20)) + draw(cm)]
    for _ in range(draw(st.integers(1, 4))):
        corners.append(corners[-1] + 2.5 + 3 * draw(cm))
    west, east = corners[0], corners[-1]
    south, depth = draw(st.integers(-20, 20)) + draw(cm), 3.0 + 2 * draw(cm)
    north = south + depth
    surfaces = [closed((west, south), (east, south), (east, north), (west, north))]
    if slanted:
        wall = (west + 0.3, north - 1.0), (west + 1.0, north - draw(cm) - 0.3)
        surfaces.append(Surface(wall))
    doors = []
    for k, x in enumerate(corners[1:-1]):
        width, near = 0.7 + 0.5 * draw(cm), south + 0.5 + draw(cm)
        shut = draw(st.booleans())
        surfaces.append(Surface(((x, south), (x, near))))
        surfaces.append(Surface(((x, near + width), (x, north))))
        if shut:
            surfaces.append(Surface(((x, near), (x, near + width))))
        doors.append(PlanDoor(f"{k}", (x, near), (x, near + width), not shut))
    rooms = tuple(
        Region(f"room {k}", shapely.box(a, south, b, north))
        for k, (a, b) in enumerate(pairwise(corners))
    )
    boundary = shapely.box(west - 1, south - 1, east + 1, north + 1)
    return FloorPlan("storey", tuple(surfaces), tuple(doors), rooms, (), (), boundary)


@given(storeys(), st.sampled_from((0.02, 0.05, 0.1)), st.sampled_from((".pgm", ".png")))
@settings(max_examples=40)
def test_a_round_trip_keeps_walls_to_a_pixel_and_all_names(
    plan: FloorPlan, resolution: float, image: str
) -> None:
    with tempfile.TemporaryDirectory() as folder:
        back, report = there_and_back(plan, Path(folder), resolution, image)
    assert report.left_out == ()
    assert farthest(plan, back, resolution) <= 1.001 * resolution
    assert farthest(back, plan, resolution) <= np.sqrt(0.5) * resolution + 0.5001 * resolution
    assert {d.name: d.open for d in back.doors} == {d.name: d.open for d in plan.doors}
    for door in plan.doors:
        assert back.door(door.name).midpoint == pytest.approx(door.midpoint, abs=2 * resolution)
    assert back.room_names == plan.room_names
    for room in plan.rooms:
        ours = back.region(room.name).polygon
        assert ours.hausdorff_distance(room.polygon) < 0.01 * resolution


def off_axis(ends: NDArray[np.float64]) -> NDArray[np.float64]:
    """How far segments, rows of x1, y1, x2, y2, lead off the nearer axis, metres."""
    return np.asarray(np.abs(ends[:, 2:] - ends[:, :2]).min(axis=1))


@given(storeys(slanted=False), st.sampled_from((0.02, 0.05, 0.1)))
@settings(max_examples=40, deadline=None)
def test_an_orthogonal_plan_stays_orthogonal_after_a_round_trip(
    plan: FloorPlan, resolution: float
) -> None:
    with tempfile.TemporaryDirectory() as folder:
        export_map(plan, Path(folder) / "map.yaml", resolution)
        back = import_map(Path(folder) / "map.yaml").plan
    assert off_axis(without_leaves(back).segments).max() < 1e-9
    assert farthest(plan, back, resolution) <= 2.0 * resolution
    doors = np.array([(*door.start, *door.end) for door in back.doors]).reshape(-1, 4)
    opened = np.array([door.open for door in back.doors], dtype=bool)
    assert (off_axis(doors) <= np.where(opened, 1e-5, 0.5 * resolution)).all()


def test_the_bundled_office_does_not_lean_after_a_round_trip(tmp_path: Path) -> None:
    """A leaf that stood half open before a jamb is a wall there: that jamb is the leaf's."""
    plan = load_floor_plan("office_cross")
    export_map(plan, tmp_path / "map.yaml", 0.05)
    back = import_map(tmp_path / "map.yaml").plan
    long = np.linalg.norm(back.segments[:, 2:] - back.segments[:, :2], axis=1) > 0.6
    assert off_axis(back.segments[long]).max() < 1e-9
    doors = np.array([(*door.start, *door.end) for door in back.doors])
    leaning = [back.doors[k].name for k in np.flatnonzero(off_axis(doors) > 1e-5)]
    assert leaning == ["west_north_2"]


@pytest.mark.parametrize("name", bundled_names())
def test_bundled_plans_come_back_with_all_names(name: str, tmp_path: Path) -> None:
    plan = load_floor_plan(name)
    back, report = there_and_back(plan, tmp_path, 0.02, ".png")
    assert report.left_out == ()
    assert {door.name for door in back.doors} == {door.name for door in plan.doors}
    assert {r.name for r in back.corridors} == {r.name for r in plan.corridors}
    assert {r.name for r in back.intersections} == {r.name for r in plan.intersections}
    assert farthest(plan, back, 0.05) <= 0.02 + 1e-6


def test_pixels_are_solid_free_and_unknown() -> None:
    wall = Surface(((0.0, 0.0), (1.0, 0.0)))
    plan = FloorPlan("wall", (wall,), (), (), (), (), shapely.box(-0.5, -0.5, 1.5, 0.5))
    pixels = draw_pixels(plan, 0.1)
    rows, columns = np.nonzero(pixels.grey == 0)
    assert len(set(rows)) == 1
    assert len(columns) == 11
    assert pixels.grey[0, 0] == 205
    column, row = pixels.to_pixels((0.5, 0.0))
    assert pixels.grey[int(row), int(column)] == 0
    assert pixels.grey[int(row) + 2, int(column)] == 254


@pytest.mark.parametrize("resolution", [0.0, -0.05, float("nan"), 20.0, 0.001])
def test_a_bad_resolution_is_refused(resolution: float) -> None:
    with pytest.raises(FloorPlanError, match="resolution"):
        draw_pixels(load_floor_plan("office_cross"), resolution)


def test_labels_of_another_map_are_left_alone(tmp_path: Path) -> None:
    plan = replace(load_floor_plan("villa_hall"), name="villa")
    (tmp_path / "doors.yaml").write_text("[]")
    with pytest.raises(FloorPlanError, match="folder of its own"):
        export_map(plan, tmp_path / "villa.yaml")
    with pytest.raises(FloorPlanError, match=r"\.yaml"):
        export_map(plan, tmp_path / "villa.png")
    assert (tmp_path / "doors.yaml").read_text() == "[]"


def test_the_command_exports_what_import_reads(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "office" / "map.yaml"
    words = ["map", "export", "office_cross", "--resolution", "0.05", "--image", "png"]
    assert cli.main([*words, "--out", str(out), "--json"]) == 0
    report = json.loads(capsys.readouterr().out)
    assert report["written"]["doors"] == 22
    with Image.open(out.with_suffix(".png")) as image:
        assert image.size == (report["written"]["columns"], report["written"]["rows"])
    back = tmp_path / "back.geojson"
    assert cli.main(["map", "import", str(out), "--out", str(back)]) == 0
    assert len(load_floor_plan(str(back)).doors) == 22
    assert cli.main([*words[:3], "--out", str(tmp_path / "map.pgm")]) == 2


def test_the_export_says_what_becomes_a_wall(tmp_path: Path) -> None:
    """A leaf that was half open is then a wall in its doorway, and found as such."""
    plan = load_floor_plan("office_cross")
    said = export_map(plan, tmp_path / "map.yaml").left_out
    assert said[0] == "1 panes of glass; they are walls in the map"
    assert "leaves of doors" in said[1]
    assert "pieces of furniture" in said[2]
    findings = check(import_map(tmp_path / "map.yaml")[0])
    assert [finding.part for finding in findings] == ["west_north_2"]
    assert door_state(plan.door("west_north_2"), plan) is DoorState.HALF_OPEN
