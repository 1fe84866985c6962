"""Buildings of OpenStreetMap: doors that are points become openings in walls of two rooms."""

import math
from itertools import pairwise
from statistics import median

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from semnav_env.world.maps import FloorPlanError, load_floor_plan, save_floor_plan
from semnav_env.world.maps.importers import Drawing, import_map
from semnav_env.world.maps.importers.osm import levels_of, on_plane
from semnav_env.world.maps.importers.osm_ring import RingPoint, edges_of
from tests.support.osm_floors import building, hall_and_rooms, node, real_building, way

HINGED = {"door": "hinged"}


@pytest.fixture
def read(tmp_path):
    def read(text, level=None):
        (tmp_path / "a.osm").write_text(text)
        return import_map(tmp_path / "a.osm", drawing=Drawing(level=level))

    return read


def test_a_door_of_two_rooms_is_an_opening_around_its_point(read):
    plan, report = read(hall_and_rooms())
    (door,) = plan.doors
    assert door.open
    assert door.name == "F1 - R1"
    assert sorted((*door.start, *door.end)) == pytest.approx([1.55, 2.0, 2.0, 2.45], abs=0.01)
    assert [hall.name for hall in plan.corridors] == ["F1"]
    assert [room.name for room in plan.rooms] == ["R1"]
    assert report.taken["open doors"] == 1


@pytest.mark.parametrize(
    ("tags", "width"),
    [
        ({"width": "1.2"}, 1.2),
        ({"width": "1.2 m"}, 1.2),
        ({"width": "2", "door:width": "0.8"}, 0.8),
        ({"width": "wide"}, 0.9),
        ({"width": "0.1"}, 0.9),
    ],
)
def test_a_door_has_the_width_that_is_tagged(read, tags, width):
    plan, _ = read(hall_and_rooms([HINGED | tags]))
    assert plan.doors[0].width == pytest.approx(width, abs=0.01)


def test_doors_close_to_each_other_end_half_way_between_them():
    ring = [RingPoint((1.5, 0.0), 2.0), RingPoint((2.5, 0.0), 2.0)]
    corners = [RingPoint(place) for place in ((4.0, 0.0), (4.0, 3.0), (0.0, 3.0), (0.0, 0.0))]
    doors = [edge for edge in edges_of([*ring, *corners]) if edge.is_door]
    assert [(edge.start[0], edge.end[0]) for edge in doors] == [(0.5, 2.0), (2.0, 3.5)]


def test_a_door_in_a_corner_lies_on_the_longer_wall():
    ring = [
        RingPoint((0.0, 0.0), 0.9),
        *(RingPoint(p) for p in ((5.0, 0.0), (5.0, 2.0), (0.0, 2.0))),
    ]
    (door,) = (edge for edge in edges_of(ring) if edge.is_door)
    assert (*door.start, *door.end) == pytest.approx((0.0, 0.0, 0.9, 0.0))


@given(
    st.lists(st.sampled_from([0.0, 0.9, 1.5]), min_size=3, max_size=9),
    st.integers(0, 2**32 - 1),
)
def test_the_edges_around_a_room_are_closed_and_follow_each_other(widths, seed):
    rng = np.random.default_rng(seed)
    angles = np.sort(rng.uniform(0.0, math.tau, len(widths)))
    places = [(6.0 * math.cos(a), 4.0 * math.sin(a)) for a in angles.tolist()]
    edges = list(edges_of([RingPoint(*each) for each in zip(places, widths, strict=True)]))
    for edge, following in pairwise([*edges, *edges[:1]]):
        assert math.dist(edge.end, following.start) < 0.06


def test_a_door_of_one_room_is_closed(read):
    text = hall_and_rooms([HINGED, {}]).replace('<nd ref="14"/>', "", 1)
    plan, report = read(text)
    assert [door.open for door in plan.doors] == [False]
    assert any("without a partner" in note for note in report.notes)


@pytest.mark.parametrize("tags", [{"stairs": "yes"}, {"highway": "elevator"}])
def test_no_robot_enters_stairs_and_lifts(read, tags):
    plan, _ = read(hall_and_rooms(room=tags))
    assert [door.open for door in plan.doors] == [False]


@pytest.mark.parametrize("turned", [-2.5, -0.7, 0.02, 0.3, 1.4])
def test_a_building_is_turned_onto_its_walls(read, turned):
    plan, _ = read(hall_and_rooms([HINGED, HINGED], turned=turned))
    steps = np.abs(np.diff(plan.segments.reshape(-1, 2, 2), axis=1)[:, 0])
    assert steps.min(axis=1).max() < 0.01
    assert [door.width for door in plan.doors] == pytest.approx([0.9, 0.9], abs=0.01)


@pytest.mark.parametrize("latitude", [0.0, 51.0, -33.9, 69.6])
def test_degrees_are_as_long_as_on_the_ellipsoid(latitude):
    """Radii of curvature of WGS84, in the meridian and across it."""
    a, e2 = 6_378_137.0, 0.00669437999014
    root = 1.0 - e2 * math.sin(math.radians(latitude)) ** 2
    north, across = a * (1.0 - e2) / root**1.5, a / math.sqrt(root)
    degree = 1e-3
    places = np.array(((latitude - degree, 7.0 - degree), (latitude + degree, 7.0 + degree)))
    east, up = np.ptp(on_plane(places), axis=0) / math.radians(2 * degree)
    assert up == pytest.approx(north, rel=1e-6)
    assert east == pytest.approx(across * math.cos(math.radians(latitude)), rel=1e-6)


@pytest.mark.parametrize(
    ("level", "repeat_on", "levels"),
    [
        ("0", "", {0}),
        ("0;1", "", {0, 1}),
        ("0-3", "", {0, 1, 2, 3}),
        ("-1-1", "", {-1, 0, 1}),
        ("-1", "2;3", {-1, 2, 3}),
        ("0.5", "", {0.5}),
        ("roof", "", set()),
        ("0-999999999", "", set(range(201))),
    ],
)
def test_levels_are_numbers_lists_and_ranges(level, repeat_on, levels):
    assert levels_of({"level": level, "repeat_on": repeat_on}) == levels


def test_one_level_is_read_and_the_others_are_named(read):
    lower = hall_and_rooms()
    text = lower.replace("</osm>", way([1, 2, 3], {"indoor": "room", "level": "1"}) + "</osm>")
    assert len(read(text, "1").plan.rooms) == 1
    assert len(read(text, "0").plan.doors) == 1
    for level, words in ((None, "several levels"), ("2", "no level '2'")):
        with pytest.raises(FloorPlanError, match=words) as error:
            read(text, level)
        assert "0 (2 spaces), 1 (1 space)" in str(error.value)


def test_what_has_no_walls_is_told_and_left_out(read):
    area = way([1, 2, 3], {"indoor": "area", "level": "0"})
    plan, report = read(hall_and_rooms().replace("</osm>", area + "</osm>"))
    assert len(plan.regions) == 2
    assert report.left_out == ("indoor=area, 1 way",)


ROOM = {"indoor": "room", "level": "0"}
CORNERS = [node(k, place) for k, place in enumerate([(0.0, 0.0), (4.0, 0.0), (4.0, 4.0)])]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("<osm>", ("no XML", "<node>")),
        (building(), ("no room and no corridor", "Simple Indoor Tagging")),
        ("<!DOCTYPE osm><osm/>", ("document type",)),
        (building(*CORNERS, way([0, 1, 2], {"indoor": "room"})), ("no room", "on a level")),
        (building(*CORNERS, way([0, 1, 7], ROOM)), ("node 7", "missing")),
        (building(*CORNERS, "<node id='9' lat='nan' lon='1'/>"), ("node 9", "not finite")),
        (building(*CORNERS, "<node id='9' lon='1'/>"), ("node 9",)),
        (building(*CORNERS, node(8, (9e3, 0.0)), way([0, 8, 2], ROOM)), ("at most 1,000 m",)),
    ],
)
def test_a_faulty_building_is_refused_in_one_line(read, text, words):
    with pytest.raises(FloorPlanError) as error:
        read(text)
    assert "\n" not in str(error.value)
    assert all(word in str(error.value) for word in ("a.osm", *words)), error.value


@pytest.mark.skipif(not real_building.exists(), reason="the real building is not here")
@pytest.mark.parametrize("level", ["0", "1", "2", "3"])
def test_a_level_of_a_real_building_keeps_the_rules_of_plans(level, tmp_path):
    plan, report = import_map(real_building, drawing=Drawing(level=level))
    save_floor_plan(plan, tmp_path / "plan.geojson")
    assert len(load_floor_plan(tmp_path / "plan.geojson").doors) == len(plan.doors)
    assert all("indoor=" in line for line in report.left_out)
    assert median(door.width for door in plan.doors) == pytest.approx(0.9, abs=0.001)
    assert sum(door.open for door in plan.doors) > 80
