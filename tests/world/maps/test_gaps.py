"""Leaks of plans, however their walls and boundaries are drawn."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import box

from semnav_env.world.maps import FloorPlan, PlanDoor, Region, Surface, load_floor_plan
from semnav_env.world.maps.gaps import gaps
from semnav_env.world.maps.importers import import_map
from semnav_env.world.maps.importers.imported import boundary_of
from semnav_env.world.maps.occupancy_export import export_map
from tests.support.small_plans import closed

GAPS = st.floats(0.1, 1.8)


def found(plan: FloorPlan) -> list[str]:
    return [str(finding) for finding in gaps(plan)]


def hall_with_a_gap(width: float, at: float = 4.0) -> FloorPlan:
    """10 x 6 m with a gap in its southern wall, the boundary a metre outside the walls."""
    wall = Surface(((at + width, 0), (10, 0), (10, 6), (0, 6), (0, 0), (at, 0)))
    return FloorPlan("hall", (wall,), (), (), (), (), boundary_of((wall,)))


def two_rooms(thickness: float, opening: float = 0.0) -> FloorPlan:
    """Two rooms 4 m wide, every wall drawn with two faces, the rooms as far as their middles.

    The wall between them has an opening through both faces, beside the eastern wall's middle.
    """
    t = thickness / 2
    faces = [closed((-t, -t), (4 + t, -t), (4 + t, 8 + t), (-t, 8 + t))]
    if opening:
        stub = (4 - t, 4 - t), (opening + t, 4 - t), (opening + t, 4 + t), (4 - t, 4 + t)
        faces += [
            Surface((stub[0], *stub[1:], (4 - t, 8 - t), (t, 8 - t), (t, t), (4 - t, t), stub[0]))
        ]
    else:
        faces += [
            closed((t, y + t), (4 - t, y + t), (4 - t, y + 4 - t), (t, y + 4 - t)) for y in (0, 4)
        ]
    rooms = Region("south", box(0, 0, 4, 4)), Region("north", box(0, 4, 4, 8))
    surfaces = tuple(faces)
    return FloorPlan("rooms", surfaces, (), rooms, (), (), boundary_of(surfaces))


def test_closed_walls_with_a_boundary_outside_have_no_gap() -> None:
    wall = closed((0, 0), (10, 0), (10, 6), (0, 6))
    assert found(FloorPlan("hall", (wall,), (), (), (), (), boundary_of((wall,)))) == []


@given(GAPS, st.floats(1.0, 7.0))
@settings(max_examples=20, deadline=None)
def test_a_gap_in_the_walls_is_found_where_it_is(width: float, at: float) -> None:
    (finding,) = gaps(hall_with_a_gap(width, at))
    assert finding.where == pytest.approx((at + width / 2, 0.0), abs=0.02)
    assert "one can walk out of the building" in finding.problem


def test_an_open_end_of_a_corridor_is_found_however_wide() -> None:
    sides = Surface(((0, 0), (9, 0))), Surface(((9, 3), (0, 3), (0, 0)))
    plan = FloorPlan(
        "hall", sides, (), (), (Region("hall", box(0, 0, 9, 3)),), (), boundary_of(sides)
    )
    (finding,) = gaps(plan)
    assert finding.where is not None
    assert finding.where[0] == pytest.approx(9.0, abs=0.01)


def test_a_missing_wall_on_the_boundary_is_found_without_regions() -> None:
    wall = Surface(((5, 0), (0, 0), (0, 6), (10, 6), (10, 0)))
    (finding,) = gaps(FloorPlan("hall", (wall,), (), (), (), (), box(0, 0, 10, 6)))
    assert finding.where == pytest.approx((7.5, 0.0), abs=0.01)


@given(st.floats(0.02, 0.45))
@settings(max_examples=10, deadline=None)
def test_the_hollow_of_a_wall_with_two_faces_is_no_space(thickness: float) -> None:
    assert found(two_rooms(thickness)) == []


@given(st.floats(0.02, 0.45), GAPS)
@settings(max_examples=10, deadline=None)
def test_an_opening_through_a_wall_with_two_faces_is_a_gap(thickness: float, gap: float) -> None:
    south, north = gaps(two_rooms(thickness, gap))
    assert (south.part, north.part) == ("south", "north")
    for finding in (south, north):
        assert finding.where == pytest.approx((thickness / 2 + gap / 2, 4.0), abs=0.05)


def test_a_door_seals_an_opening() -> None:
    plan = two_rooms(0.2, 0.9)
    door = PlanDoor("door", (0.1, 4.0), (1.0, 4.0))
    assert found(replace(plan, doors=(door,))) == []


@pytest.mark.parametrize("name", ["office_cross", "office:small:3", "office:medium:17"])
def test_a_round_trip_adds_no_gaps(name: str, tmp_path: Path) -> None:
    plan = load_floor_plan(name)
    export_map(plan, tmp_path / "map.yaml")
    assert found(plan) == []
    assert found(import_map(tmp_path / "map.yaml").plan) == []
