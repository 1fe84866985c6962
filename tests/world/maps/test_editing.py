"""Rooms, corridors and doors that are drawn on a map without any."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest
from shapely import Polygon

from semnav_env.world.maps import FloorPlan, FloorPlanError, load_floor_plan
from semnav_env.world.maps.check import check
from semnav_env.world.maps.door_drawing import with_door
from semnav_env.world.maps.editing import (
    scaled,
    with_corridor,
    with_room,
    with_wall,
    without_part,
)
from semnav_env.world.maps.importers import load_csv

WALLS = "0,0,8,0\n8,0,8,2\n8,2,4,2\n3,2,0,2\n0,2,0,0\n0,2,0,5\n0,5,8,5\n8,5,8,2\n"
"""A corridor along x, 2 m wide, with an opening of 1 m to a room behind it."""


@pytest.fixture
def walls(tmp_path) -> FloorPlan:
    path = tmp_path / "walls.csv"
    path.write_text(WALLS)
    return load_csv(path).plan


@pytest.fixture
def drawn(walls) -> FloorPlan:
    hall = with_corridor(with_door(walls, (3.1, 2.1), (3.9, 1.9), "office"), (1, 0.8), (7, 1.2))
    return with_room(hall, (5.0, 4.0), "library")


def test_what_is_drawn_roughly_has_nothing_wrong_with_it(drawn):
    assert check(drawn) == []


def test_a_door_takes_its_jambs_from_the_gap(drawn):
    door = drawn.door("office")
    assert {door.start, door.end} == {(3.0, 2.0), (4.0, 2.0)}


def test_the_corridor_lies_to_the_left_of_its_doors(drawn):
    (x1, y1), (x2, y2) = drawn.door("office").start, drawn.door("office").end
    assert (x1 - x2, y1 - y2) == (1.0, 0.0)


def test_a_room_and_a_corridor_take_their_outlines_from_the_walls(drawn):
    room, hall = drawn.region("library").polygon, drawn.region("corridor_1").polygon
    assert room.symmetric_difference(Polygon([(0, 2), (8, 2), (8, 5), (0, 5)])).area < 0.05
    assert hall.symmetric_difference(Polygon([(0, 0), (8, 0), (8, 2), (0, 2)])).area < 0.05


def test_a_door_in_a_wall_cuts_it_open(walls):
    cut = with_door(walls, (5.0, 2.05), (6.0, 1.95), "new")
    door = cut.door("new")
    assert door.open
    assert door.width == pytest.approx(1.0, abs=0.02)
    assert cut.opaque_segments.shape[0] == walls.opaque_segments.shape[0] + 1


def test_a_door_in_a_thick_wall_gets_two_jambs(walls):
    thick = [(0.0, 2.0), (0.0, 2.2), (3.0, 2.2), (3.0, 2.0), (0.0, 2.0)]
    surfaces = (*walls.surfaces, replace(walls.surfaces[0], points=tuple(thick)))
    cut = with_door(replace(walls, surfaces=surfaces), (1.0, 2.1), (2.0, 2.1), "new")
    ends = [
        sorted(surface.points)
        for surface in cut.surfaces
        if len(surface.points) == 2 and surface.points[0][0] == surface.points[1][0]
    ]
    assert [end for end in ends if end[0][0] in (1.0, 2.0)] == [
        [(1.0, 2.0), (1.0, 2.2)],
        [(2.0, 2.0), (2.0, 2.2)],
    ]


def test_corridors_that_cross_have_an_intersection(tmp_path):
    path = tmp_path / "cross.csv"
    path.write_text(
        "0,4,4,4\n4,4,4,0\n4,0,6,0\n6,0,6,4\n6,4,10,4\n10,4,10,6\n10,6,6,6\n6,6,6,10\n"
        "6,10,4,10\n4,10,4,6\n4,6,0,6\n0,6,0,4\n"
    )
    plan = with_corridor(load_csv(path).plan, (1.0, 5.0), (9.0, 5.0))
    plan = with_corridor(plan, (5.0, 1.0), (5.0, 9.0))
    (crossing,) = plan.intersections
    assert (
        crossing.polygon.symmetric_difference(Polygon([(4, 4), (6, 4), (6, 6), (4, 6)])).area < 0.1
    )
    assert check(plan) == []


def test_a_click_into_a_room_that_has_a_name_renames_it(drawn):
    renamed = with_room(drawn, (5.0, 4.0), "lab")
    assert renamed.room_names == ("lab",)
    assert renamed.rooms[0].polygon == drawn.rooms[0].polygon


def test_what_is_removed_can_be_drawn_again(drawn):
    bare = without_part(without_part(drawn, (3.5, 2.0)), (5.0, 4.0))
    assert (bare.doors, bare.rooms) == ((), ())
    again = with_room(with_door(bare, (3, 2), (4, 2), "office"), (5.0, 4.0), "library")
    assert again == drawn


def test_a_known_length_scales_everything(drawn):
    twice = scaled(drawn, (0.0, 0.0), (8.0, 0.0), 16.0)
    assert twice.door("office").width == pytest.approx(2.0)
    assert twice.region("library").polygon.area == pytest.approx(
        4.0 * drawn.region("library").polygon.area
    )
    back = scaled(twice, (0.0, 0.0), (16.0, 0.0), 8.0)
    assert math.isclose(back.boundary.area, drawn.boundary.area)


def test_a_wall_closes_a_gap(walls):
    closed = with_wall(walls, (3.0, 2.0), (4.0, 2.0))
    assert with_room(closed, (5.0, 4.0), "library").rooms[0].polygon.area > 23.0


@pytest.mark.parametrize(
    ("draw", "why"),
    [
        (lambda plan: with_door(plan, (1.0, 1.0), (2.0, 1.0)), "no wall"),
        (lambda plan: with_door(plan, (3.0, 2.0), (3.1, 2.0)), "at least 0.5 m wide"),
        (lambda plan: with_door(plan, (3.0, 2.0), (4.0, 2.0), "office"), "unique|named"),
        (lambda plan: with_room(plan, (8.03, 3.0), "wall"), "lies in a wall"),
        (lambda plan: with_room(plan, (-0.5, -0.5), "garden"), "leads out of the building"),
        (lambda plan: with_corridor(plan, (-0.9, -0.5), (-0.9, -0.5)), "no length"),
        (lambda plan: with_wall(plan, (3.0, 2.0), (4.0, 2.0)), "office"),
        (lambda plan: without_part(plan, (-0.5, -0.5)), "neither a door nor a region"),
        (lambda plan: scaled(plan, (0.0, 0.0), (0.0, 0.0), 3.0), "a known length"),
        (lambda plan: scaled(plan, (0.0, 0.0), (1.0, 0.0), 999.0), "metres|unit"),
    ],
)
def test_what_cannot_be_drawn_is_refused(drawn, draw, why):
    with pytest.raises(FloorPlanError, match=why):
        draw(drawn)


def test_a_room_whose_opening_has_no_door_is_refused(walls):
    hall = with_corridor(walls, (1.0, 1.0), (7.0, 1.0))
    with pytest.raises(FloorPlanError, match="draw a door between"):
        with_room(hall, (5.0, 4.0), "library")


def test_every_bundled_plan_can_be_drawn_on():
    for name in ("heidelberg_hallway", "office_cross", "villa_hall"):
        plan = load_floor_plan(name)
        room = plan.rooms[0]
        at = room.polygon.representative_point()
        assert with_room(plan, (at.x, at.y), "mine").room_names[0] == "mine"
