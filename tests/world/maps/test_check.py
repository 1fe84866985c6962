"""The check of floor plans: each fault is found, and named with its place."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import shapely
import shapely.affinity
from hypothesis import given, settings
from hypothesis import strategies as st
from matplotlib.figure import Figure
from shapely import LineString, Point, Polygon, box

from semnav_env.robots import SPOT, WHEELCHAIR
from semnav_env.world.maps import FloorPlan, Material, PlanDoor, Region, Surface, save_floor_plan
from semnav_env.world.maps.check import check
from semnav_env.world.maps.draw import save_picture
from semnav_env.world.maps.placement import footprint
from semnav_env.world.maps.plan_fault import PlanFault
from semnav_env.world.maps.reach import reach
from semnav_scripts.main import main
from studies.__main__ import STUDIES


def line(*points: tuple[float, float], material: Material = Material.WALL) -> Surface:
    return Surface(points, material)


def cabinet(west: float, south: float, east: float, north: float) -> Surface:
    return Surface(tuple(box(west, south, east, north).exterior.coords), Material.FURNITURE)


def room_at_a_corridor(width: float = 0.9, *more: Surface, depth: float = 4.0) -> FloorPlan:
    """A corridor 2 m wide and 8 m long below, a room 4 m wide above, a door between them."""
    west, east = 4.0 - width / 2, 4.0 + width / 2
    surfaces = (
        line((0, 0), (8, 0), (8, 2), (east, 2)),
        line((west, 2), (0, 2), (0, 0)),
        line((2, 2), (2, 2 + depth), (6, 2 + depth), (6, 2)),
        *more,
    )
    outline = Polygon(
        [(0, 0), (8, 0), (8, 2), (6, 2), (6, 2 + depth), (2, 2 + depth), (2, 2), (0, 2)]
    )
    room, corridor = Region("room", box(2, 2, 6, 2 + depth)), Region("hall", box(0, 0, 8, 2))
    doors = (PlanDoor("door", (east, 2), (west, 2)),)
    return FloorPlan("small", surfaces, doors, (room,), (corridor,), (), outline)


def found(plan: FloorPlan, robot=WHEELCHAIR) -> list[str]:
    return [str(fault) for fault in check(plan, robot)]


def test_nothing_is_wrong_with_a_room_at_a_corridor() -> None:
    assert found(room_at_a_corridor()) == []


def test_a_narrow_door_is_a_fault_for_the_wheelchair_only() -> None:
    plan = room_at_a_corridor(0.62)
    assert found(plan) == [
        "door: this open door leaves 0.62 m; a wheelchair (1.1 m x 0.65 m) needs more"
    ]
    assert found(plan, SPOT) == []


@pytest.mark.parametrize("depth", [0.8, 0.6])
def test_a_room_too_shallow_for_the_body_is_found(depth: float) -> None:
    """In the shallower one there is no place left where a body could be."""
    assert found(room_at_a_corridor(depth=depth)) == [
        "room: a wheelchair (1.1 m x 0.65 m) cannot get into this room"
    ]


def test_a_room_the_robot_must_back_out_of_counts_as_reached() -> None:
    shelves = cabinet(2.01, 2.01, 3.5, 5.9), cabinet(4.5, 2.01, 5.99, 5.9)
    assert found(room_at_a_corridor(0.9, *shelves)) == []


def test_a_turn_without_space_is_found_where_a_disc_would_pass() -> None:
    """A passage 0.8 m wide with a square bend in it: a body 1.1 m long cannot turn there."""
    right, above = cabinet(4.45, 2.01, 5.99, 2.8), cabinet(2.01, 3.6, 5.1, 5.99)
    plan = room_at_a_corridor(0.9, cabinet(2.01, 2.01, 3.55, 3.59), right, above)
    deep = Point(5.55, 5.0)
    assert reach(plan, 0.65, 0.65).near(deep, 0.2)
    assert not reach(plan, 1.1, 0.65).near(deep, 0.2)


def test_a_corridor_that_is_blocked_is_found_with_the_place() -> None:
    plan = room_at_a_corridor(0.9, cabinet(6.0, 0.01, 6.5, 1.6))
    (fault,) = check(plan)
    assert (
        str(fault) == "hall: a wheelchair (1.1 m x 0.65 m) cannot get to this end of the corridor"
    )
    assert fault.where == pytest.approx((7.0, 1.0))


def bent_corridor(*more: Surface) -> FloorPlan:
    """A corridor 2 m wide, 12 m to the east and from there 8 m to the north."""
    ring = (0, 0), (12, 0), (12, 10), (10, 10), (10, 2), (0, 2), (0, 0)
    hall = Region("hall", Polygon(ring))
    return FloorPlan("bent", (line(*ring), *more), (), (), (hall,), (), hall.polygon)


@pytest.mark.parametrize("angle", [0.0, 30.0, 90.0, 135.0])
def test_both_ends_of_a_bent_corridor_are_reached(angle: float) -> None:
    (surface,), (hall,) = bent_corridor().surfaces, bent_corridor().corridors
    ring = shapely.affinity.rotate(hall.polygon, angle, (0, 0))
    walls = replace(surface, points=tuple(ring.exterior.coords))
    turned = FloorPlan("bent", (walls,), (), (), (Region("hall", ring),), (), ring)
    assert found(turned) == []


def test_a_bent_corridor_that_is_blocked_is_found_with_the_end() -> None:
    for block, end in (((10.01, 7, 11.6, 7.5), (11.5, 9.5)), ((3, 0.01, 3.5, 1.6), (0.5, 0.5))):
        (fault,) = check(bent_corridor(cabinet(*block)))
        assert fault.problem.endswith("cannot get to this end of the corridor")
        assert fault.where == pytest.approx(end, abs=1.1)


@pytest.mark.parametrize("angle", [0.0, 40.0])
def test_both_ends_of_a_corridor_that_turns_back_are_its_legs(angle: float) -> None:
    """A U of legs 2 m wide, 6 m apart and 20 m long: blocking either leg cuts off its end."""
    ring = (0, 0), (10, 0), (10, 20), (8, 20), (8, 2), (2, 2), (2, 20), (0, 20), (0, 0)
    walls = line(*ring)
    for blocks in ([], [(0.01, 12, 1.6, 12.5)], [(8.4, 12, 9.99, 12.5)]):
        surfaces = (walls, *(cabinet(*block) for block in blocks))
        turned = [
            replace(
                s, points=tuple(shapely.affinity.rotate(LineString(s.points), angle, (0, 0)).coords)
            )
            for s in surfaces
        ]
        hall = shapely.affinity.rotate(Polygon(ring), angle, (0, 0))
        plan = FloorPlan("u", tuple(turned), (), (), (Region("hall", hall),), (), hall)
        ends = [shapely.affinity.rotate(Point(*f.where), -angle, (0, 0)) for f in check(plan)]
        assert len(ends) == len(blocks)
        for end, block in zip(ends, blocks, strict=True):
            assert block[0] - 0.1 < end.x < block[2] + 0.1
            assert end.y > 18.0


def test_what_stands_in_a_doorway_is_found() -> None:
    plan = room_at_a_corridor(0.9, cabinet(3.95, 2.1, 4.05, 2.2))
    assert "door: furniture at (4.05, 2.20) stands in this doorway" in found(plan)


def test_rooms_that_overlap_are_found() -> None:
    plan = room_at_a_corridor()
    both = (*plan.rooms, Region("other", box(5, 3, 6, 5)))
    assert "room: overlaps other by 2.00 m2; part the two" in found(replace(plan, rooms=both))


@pytest.mark.parametrize(("width", "count"), [(0.3, 0), (0.6, 1)])
def test_rooms_overlap_only_where_a_robot_has_space_in_both(width: float, count: int) -> None:
    """Outlines that cross by less, such as those of OpenStreetMap floors, leave nothing open."""
    plan = room_at_a_corridor()
    both = (*plan.rooms, Region("other", box(6.0 - width, 3, 6, 5)))
    assert str(found(replace(plan, rooms=both))).count("overlaps") == count


def test_a_door_between_cabinets_does_not_lie_in_a_wall() -> None:
    pair = cabinet(3.0, 3.9, 3.5, 4.1), cabinet(4.4, 3.9, 4.9, 4.1)
    plan = room_at_a_corridor(0.9, *pair)
    odd = PlanDoor("odd", (3.5, 4.0), (4.4, 4.0))
    faults = found(replace(plan, doors=(*plan.doors, odd)))
    assert "odd: this door does not lie in a wall at (3.50, 4.00); draw one" in faults
    assert "odd: this door leads from room to itself; put it in a wall" in faults


def test_furniture_outside_is_found() -> None:
    plan = room_at_a_corridor(0.9, cabinet(0.5, 3.0, 1.0, 4.0))
    assert any("reaches out of the building" in fault for fault in found(plan))


def test_a_plan_in_which_the_robot_cannot_stand_gets_one_fault() -> None:
    plan = room_at_a_corridor(0.9, cabinet(3.7, 0.8, 4.3, 1.2))
    assert found(plan) == [
        "small: a wheelchair (1.1 m x 0.65 m) cannot stand in the middle of the largest corridor"
    ]


@given(st.integers(0, 2**32 - 1))
@settings(max_examples=20, deadline=None)
def test_where_a_body_reaches_it_fits_in_some_heading(seed: int) -> None:
    rng = np.random.default_rng(seed)
    corners = rng.uniform((2.2, 2.2), (5.2, 5.2), (4, 2))
    things = [cabinet(x, y, x + 0.4, y + 0.4) for x, y in corners.tolist()]
    plan = room_at_a_corridor(1.0, *things)
    way = reach(plan, WHEELCHAIR.length, WHEELCHAIR.width)
    solid = shapely.union_all([LineString(surface.points) for surface in plan.surfaces])
    points = way.grid.points(np.argwhere(way.cells))
    for x, y in points[rng.integers(len(points), size=20)].tolist():
        headings = np.linspace(0, math.pi, 12, endpoint=False)
        bodies = [footprint(WHEELCHAIR, (x, y, heading)) for heading in headings]
        assert any(not body.intersects(solid) for body in bodies)


@pytest.mark.parametrize("turned", [0.3, math.pi / 2, 2.0])
def test_turning_the_plan_changes_nothing(turned: float) -> None:
    def turn(geometry):
        return shapely.affinity.rotate(geometry, turned, (0, 0), use_radians=True)

    def points(ends):
        return tuple(turn(LineString(ends)).coords)

    for width, wrong in ((0.62, 1), (0.9, 0)):
        plan = room_at_a_corridor(width)
        moved = FloorPlan(
            plan.name,
            tuple(replace(s, points=points(s.points)) for s in plan.surfaces),
            tuple(PlanDoor(d.name, *points((d.start, d.end))) for d in plan.doors),
            tuple(replace(r, polygon=turn(r.polygon)) for r in plan.rooms),
            tuple(replace(r, polygon=turn(r.polygon)) for r in plan.corridors),
            (),
            turn(plan.boundary),
        )
        assert len(check(moved)) == wrong


def test_a_picture_marks_the_faults(tmp_path: Path) -> None:
    plan = room_at_a_corridor(0.62)
    save_picture(plan, tmp_path / "clean.png")
    save_picture(plan, tmp_path / "marked.png", faults=check(plan))
    clean, marked = ((tmp_path / f"{name}.png").read_bytes() for name in ("clean", "marked"))
    assert marked.startswith(b"\x89PNG")
    assert marked != clean


@pytest.fixture
def drawn(monkeypatch: pytest.MonkeyPatch) -> list[Figure]:
    """The figures that are saved."""
    saved: list[Figure] = []
    save = Figure.savefig
    monkeypatch.setattr(Figure, "savefig", lambda f, *a, **k: (saved.append(f), save(f, *a, **k)))
    return saved


def test_the_faults_stand_below_the_axis_whose_label_stays_black(
    drawn: list[Figure], tmp_path: Path
) -> None:
    plan = room_at_a_corridor(0.62)
    save_picture(plan, tmp_path / "marked.png", faults=check(plan))
    (label,) = [axes.xaxis.label for axes in drawn[0].axes]
    assert (label.get_text(), label.get_color()) == ("x, m", "black")
    (listed,) = drawn[0].subfigs[1].texts
    assert "this open door leaves 0.62 m" in listed.get_text()
    assert listed.get_window_extent().y1 < label.get_window_extent().y0


@pytest.mark.parametrize("count", [1, 40])
def test_many_faults_neither_shrink_the_plan_nor_overlap(
    count: int, drawn: list[Figure], tmp_path: Path
) -> None:
    """The plan keeps its size, and no mark or number lies on another."""
    plan = room_at_a_corridor(0.62)
    west, south, east, north = plan.boundary.bounds
    corners = ((west, south), (east, north), (west + 0.1, north), (east, south))
    faults = [PlanFault("kitchen", f"is wrong {'and ' * k}", corners[k % 4]) for k in range(count)]
    for shown in ((), faults):
        save_picture(plan, tmp_path / "plan.png", faults=shown)
    clean, marked = (figure.axes[0].get_window_extent() for figure in drawn)
    assert marked.width > 0.9 * clean.width
    (ax,) = drawn[1].axes
    listed = [text.get_window_extent() for text in drawn[1].subfigs[1].texts]
    numbers = [
        t.get_window_extent() for t in ax.texts if t.get_visible() and t.get_color() == "red"
    ]
    boxes = [*listed, *numbers, ax.title.get_window_extent()]
    assert all(box.count_overlaps(boxes) == 1 for box in boxes)  # with itself
    assert all(box.x0 > 0 and box.x1 < drawn[1].bbox.width and box.y0 > 0 for box in boxes)
    text = "\n".join(text.get_text() for text in drawn[1].subfigs[1].texts)
    assert all(f"{number}  kitchen" in text for number in range(1, count + 1))


def test_the_command_says_what_is_wrong_and_exits_with_1(tmp_path: Path, capsys) -> None:
    save_floor_plan(room_at_a_corridor(0.62), tmp_path / "plan.geojson")
    words = ["map", "check", str(tmp_path / "plan.geojson")]
    assert main([*words, "--plot", str(tmp_path / "faults.png")]) == 1
    assert "door: this open door leaves 0.62 m" in capsys.readouterr().out
    assert (tmp_path / "faults.png").exists()
    assert main([*words, "--robot", "spot"]) == 0
    assert "nothing is wrong" in capsys.readouterr().out
    assert main(["map", "check", "office:medum:3"]) == 2
    assert "did you mean medium" in capsys.readouterr().err


def test_the_commands_generate_and_measure_offices(tmp_path: Path, capsys) -> None:
    out = tmp_path / "plan.geojson"
    assert (
        main(["map", "generate", "--distribution", "small", "--seed", "4", "--out", str(out)]) == 0
    )
    assert main(["map", "check", str(out)]) == 0
    options = ["--distributions", "small", "--count", "2", "--out", str(tmp_path / "offices.jsonl")]
    assert STUDIES.main(["offices", *options]) == 0
    assert "100.0 %" in capsys.readouterr().out
    assert len((tmp_path / "offices.jsonl").read_text().splitlines()) == 2
