"""Drawn floors of the KTH and MIT data sets: two faces make one door in a thick wall."""

import math
from statistics import median

import pytest
import shapely

from semnav_env.world.maps import FloorPlanError, Material, load_floor_plan, save_floor_plan
from semnav_env.world.maps.importers import import_map
from tests.support.kth_floors import UNITS, floor, hall, real_floors, room, space


@pytest.fixture
def read(tmp_path):
    def read(text, name="a.xml"):
        (tmp_path / name).write_text(text)
        return import_map(tmp_path / name)

    return read


def test_two_faces_are_one_door_in_the_middle_of_the_wall(read):
    plan, report = read(floor(hall(), room()))
    (door,) = plan.doors
    assert door.open
    assert door.name == "1 - 2"
    assert sorted((door.start, door.end)) == [(2.0, 2.15), (2.9, 2.15)]
    assert report.taken["open doors"] == 1


def test_both_regions_reach_the_line_of_their_door(read):
    plan, _ = read(floor(hall(), room()))
    middle = shapely.Point(plan.doors[0].midpoint)
    assert all(region.polygon.distance(middle) < 0.02 for region in plan.regions)
    assert plan.rooms[0].polygon.intersection(plan.corridors[0].polygon).area < 0.05


def test_nothing_leads_into_a_thick_wall(read):
    """The reveals join both faces, also where one face is wider than the other."""
    plan, _ = read(floor(hall(), room(door=(2.0, 2.7))))
    inside_wall = shapely.box(3.05, 2.02, 9.9, 2.28)
    solid = shapely.union_all(shapely.linestrings(plan.segments.reshape(-1, 2, 2)))
    way = shapely.LineString([(2.35, 1), (2.35, 2.15), (9, 2.15)])
    assert way.intersects(solid)
    assert not inside_wall.intersects(solid)


def test_a_face_without_a_partner_is_a_closed_door(read):
    plan, report = read(floor(hall(doors=((2, 3), (6, 7))), room()))
    shut = [door for door in plan.doors if not door.open]
    assert [(door.name, door.start, door.end) for door in shut] == [("1", (7.0, 2.0), (6.0, 2.0))]
    assert any(surface.material is Material.LEAF for surface in plan.surfaces)
    assert any("without a partner" in note for note in report.notes)


def test_a_wall_between_two_faces_parts_them(read):
    between = space("3", "", (0, 2.1, 5, 2.1), (5, 2.1, 5, 2.2), (5, 2.2, 0, 2.2), (0, 2.2, 0, 2.1))
    plan, _ = read(floor(hall(), room(), between))
    assert all(not door.open for door in plan.doors)


@pytest.mark.parametrize("kind", ["HISS", "HISSMASKIN", "elevator"])
def test_no_robot_enters_a_lift(read, kind):
    plan, _ = read(floor(hall(), room(kind=kind)))
    assert [door.open for door in plan.doors] == [False]


def test_a_long_space_with_many_doors_is_a_corridor_without_being_called_one(read):
    doors = [(4.2 * k + 0.2, 4.2 * k + 1.1) for k in range(2, 6)]
    hallway = hall(doors, kind="", length=26)
    rooms = [room(str(k), door=(4.2 * k + 0.2, 4.2 * k + 1.1), west=4.2 * k) for k in range(2, 6)]
    plan, _ = read(floor(hallway, *rooms))
    assert [region.name for region in plan.corridors] == ["1"]
    assert len(plan.rooms) == 4


def test_a_scale_that_halves_all_doors_is_corrected_and_told(read):
    half = f'PixelDistance="{2 * UNITS}" RealDistance="1"'
    plan, report = read(floor(hall(), room(), scale=half))
    assert plan.doors[0].width == pytest.approx(0.9)
    assert any("2 times this scale" in note for note in report.notes)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("<floor>", ("no XML", "<space>")),
        ("<floor><Scale/></floor>", ("no space", "linesegment")),
        ("<!DOCTYPE floor><floor/>", ("document type",)),
        (floor(hall(), scale='PixelDistance="-1"'), ("Scale", "--drawing.scale")),
        (floor(hall()).replace('x1="0.0"', 'x1="nan"', 1), ("B_1", "not finite")),
        (floor(hall()).replace('x1="0.0"', 'y7="0"', 1), ("B_1",)),
        (floor(hall(), scale='PixelDistance="1" RealDistance="90"'), ("at most 1,000 m",)),
    ],
)
def test_a_faulty_plan_is_refused_in_one_line(read, text, words):
    with pytest.raises(FloorPlanError) as error:
        read(text)
    assert "\n" not in str(error.value)
    assert all(word in str(error.value) for word in ("a.xml", *words)), error.value


@pytest.mark.skipif(not real_floors, reason="the drawn floors are not here")
@pytest.mark.parametrize("path", real_floors[::6], ids=lambda path: path.stem)
def test_a_real_floor_keeps_the_rules_of_plans(path, tmp_path):
    plan, report = import_map(path)
    save_floor_plan(plan, tmp_path / "plan.geojson")
    assert len(load_floor_plan(tmp_path / "plan.geojson").doors) == len(plan.doors)
    assert report.left_out == ()
    assert 0.7 < median(door.width for door in plan.doors) < 1.2


@pytest.mark.skipif(not real_floors, reason="the drawn floors are not here")
def test_most_faces_of_real_doors_find_their_partner():
    plans = [import_map(path).plan for path in real_floors[::10]]
    doors = [door for plan in plans for door in plan.doors]
    assert len(doors) > 100
    assert sum(door.open for door in doors) / len(doors) > 0.9
    assert all(math.dist(door.start, door.end) >= 0.5 for door in doors)
