"""The bundled floor plans: watertight, and wide enough for the robots."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
import shapely
from matplotlib.figure import Figure
from shapely import LineString, Point, box

from semnav_env.robots import ROBOTS, WHEELCHAIR
from semnav_env.world.maps import Material, Surface, bundled_names, load_floor_plan
from semnav_env.world.maps.check import check
from semnav_env.world.maps.document import parse_document
from semnav_env.world.maps.doorways import DoorState, door_state
from semnav_env.world.maps.draw import draw_floor_plan, leave_out_overlapping, save_picture
from semnav_env.world.maps.library import BUNDLED_FOLDER
from semnav_env.world.maps.schema import check_schema
from tests.support.plan_geometry import inward, lane, reachable, solid

every_plan = pytest.mark.parametrize("name", bundled_names())


def test_there_are_three_plans() -> None:
    assert bundled_names() == ("heidelberg_hallway", "office_cross", "villa_hall")


@every_plan
def test_a_bundled_plan_follows_the_schema(name: str) -> None:
    text = (BUNDLED_FOLDER / f"{name}.geojson").read_text("utf-8")
    check_schema(parse_document(text, name), name)


@every_plan
def test_nothing_is_wrong_with_a_bundled_plan(name: str) -> None:
    plan = load_floor_plan(name)
    assert check(plan) == []
    assert plan.name == name
    assert plan.source


@every_plan
def test_a_plan_is_read_once(name: str) -> None:
    assert load_floor_plan(name) is load_floor_plan(name)


@every_plan
def test_rooms_do_not_overlap_each_other_or_a_corridor(name: str) -> None:
    plan = load_floor_plan(name)
    corridors = shapely.union_all([region.polygon for region in plan.corridors])
    for i, room in enumerate(plan.rooms):
        others = [other.polygon for other in plan.rooms[i + 1 :]]
        assert room.polygon.intersection(shapely.union_all([corridors, *others])).area < 0.01


@every_plan
def test_intersections_lie_in_the_corridors_they_join(name: str) -> None:
    plan = load_floor_plan(name)
    corridors = shapely.union_all([region.polygon for region in plan.corridors])
    for region in plan.intersections:
        assert corridors.intersection(region.polygon).area > 0.3 * region.polygon.area
        assert sum(c.polygon.dwithin(region.polygon, 1e-6) for c in plan.corridors) >= 2


@every_plan
def test_every_door_leads_from_its_left_side_into_a_room(name: str) -> None:
    """A corridor is on the left of start-end, as for a perceived door; a room on the right."""
    plan = load_floor_plan(name)
    for door in plan.doors:
        heading = inward(door)
        x, y = door.midpoint
        behind = Point(x + 0.3 * math.cos(heading), y + 0.3 * math.sin(heading))
        before = Point(x - 0.3 * math.cos(heading), y - 0.3 * math.sin(heading))
        assert any(room.polygon.contains(behind) for room in plan.rooms), door.name
        sides = plan.rooms if door.name == "inner" else plan.corridors + plan.intersections
        assert any(region.polygon.contains(before) for region in sides), door.name


@every_plan
@pytest.mark.parametrize("robot", ROBOTS.values(), ids=str)
def test_a_disc_as_wide_as_a_robot_reaches_all_open_doors(name: str, robot: Any) -> None:
    plan = load_floor_plan(name)
    way = reachable(plan, robot.width)
    for door in plan.doors:
        assert way.intersects(LineString((door.start, door.end))) == door.open, door.name


@every_plan
def test_every_open_door_is_free_for_two_metres_behind_it(name: str) -> None:
    plan = load_floor_plan(name)
    walls = solid(plan)
    for door in plan.doors:
        if door_state(door, plan) is DoorState.OPEN:
            assert not lane(door.midpoint, inward(door), 2.0, WHEELCHAIR.width).intersects(walls)


@every_plan
def test_pictures_are_drawn(name: str, tmp_path: Path) -> None:
    save_picture(load_floor_plan(name), tmp_path / "plan.png")
    assert (tmp_path / "plan.png").read_bytes().startswith(b"\x89PNG")


def test_a_removed_wall_is_a_gap() -> None:
    plan = load_floor_plan("villa_hall")
    findings = [
        [f for f in check(replace(plan, surfaces=plan.surfaces[:i] + plan.surfaces[i + 1 :])) if f]
        for i in range(len(plan.surfaces))
    ]
    assert all(findings)
    assert any("walk out of the building" in str(f) for found in findings for f in found)
    assert any("other than through a door" in str(f) for found in findings for f in found)


def test_a_blocked_door_is_one_fault_that_names_the_furniture() -> None:
    plan = load_floor_plan("villa_hall")
    crate = box(0.8, 0.4, 1.9, 0.6)
    blocked = Surface(tuple(crate.exterior.coords), Material.FURNITURE)
    (fault,) = check(replace(plan, surfaces=(*plan.surfaces, blocked)))
    assert fault.part == "kitchen"
    assert "cannot get through this open door; furniture at (" in fault.problem


def test_a_plan_that_breaks_a_rule_gets_one_finding() -> None:
    plan = load_floor_plan("villa_hall")
    found = check(replace(plan, doors=plan.doors * 2))
    assert [str(f) for f in found] == [
        "villa_hall: 2 doors are named 'parents'; door names are unique"
    ]


@pytest.mark.parametrize("name", [*bundled_names(), "office:large:3"])
def test_pictures_name_all_rooms_and_doors_without_overlap(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """No name lies on another one."""
    drawn: list[Figure] = []
    save = Figure.savefig
    monkeypatch.setattr(Figure, "savefig", lambda f, *a, **k: (drawn.append(f), save(f, *a, **k)))
    plan = load_floor_plan(name)
    save_picture(plan, tmp_path / "plan.png")
    (ax,) = drawn[0].axes
    shown = [text for text in ax.texts if text.get_visible()]
    boxes = [text.get_window_extent() for text in shown]
    assert all(box.count_overlaps(boxes) == 1 for box in boxes)  # with itself
    names = {text.get_text() for text in shown}
    assert {part.name for part in (*plan.rooms, *plan.doors)} <= names


def test_of_too_many_names_those_of_rooms_are_kept() -> None:
    figure = Figure(figsize=(4.0, 4.0))
    ax = figure.add_subplot()
    plan = load_floor_plan("office_cross")
    draw_floor_plan(plan, ax)
    leave_out_overlapping(ax)
    shown = [text.get_text() for text in ax.texts if text.get_visible()]
    hidden = [text.get_text() for text in ax.texts if not text.get_visible()]
    rooms = {room.name for room in plan.rooms}
    assert len(rooms & set(shown)) > 10
    assert {door.name for door in plan.doors} & set(hidden)
