"""Where robots can stand."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import LineString, Point

from semnav_env.robots import ROBOTS, SPOT, WHEELCHAIR
from semnav_env.world.maps import (
    FloorPlan,
    Material,
    Region,
    Surface,
    bundled_names,
    load_floor_plan,
)
from semnav_env.world.maps.placement import footprint, placement_error, sample_pose, uniform
from tests.support.small_plans import empty_hall, plan_of

angles = st.floats(-10, 10)


@given(st.floats(-50, 50), st.floats(-50, 50), angles)
def test_a_footprint_is_centred_on_its_pose(x: float, y: float, heading: float) -> None:
    body = footprint(WHEELCHAIR, (x, y, heading))
    assert body.area == pytest.approx(1.10 * 0.65)
    assert body.centroid.distance(Point(x, y)) < 1e-9
    nose = Point(x + 0.549 * math.cos(heading), y + 0.549 * math.sin(heading))
    assert body.contains(nose)


@settings(deadline=None)
@given(st.floats(0, 10), st.floats(0, 6), angles)
def test_a_pose_in_a_hall_is_free_iff_all_corners_are_inside(
    x: float, y: float, heading: float
) -> None:
    corners = footprint(SPOT, (x, y, heading)).exterior.coords
    margin = min(min(cx, 10 - cx, cy, 6 - cy) for cx, cy in corners)
    if abs(margin) > 1e-6:
        assert (placement_error(empty_hall(), SPOT, (x, y, heading)) is None) == (margin > 0)


@pytest.mark.parametrize(
    ("pose", "message"),
    [
        ((math.nan, 0.0, 0.0), "the pose is (nan, 0.0, 0.0); give finite x and y"),
        ((1.0, 1.0, math.inf), "give finite"),
        ((1.0, 1.0), "give finite"),
        ((50.0, 1.0, 0.0), "is outside small, which spans x 0.0 to 10.0 and y 0.0 to 6.0"),
        ((1e300, -1e300, 0.0), "is outside small"),
        ((0.1, 3.0, 0.0), "reaches over the boundary of small"),
    ],
)
def test_a_pose_that_cannot_be_says_why(pose: tuple[float, float, float], message: str) -> None:
    assert message in str(placement_error(empty_hall(), WHEELCHAIR, pose))


def with_corridor(plan: FloorPlan) -> FloorPlan:
    return FloorPlan(
        plan.name, plan.surfaces, (), (), (Region("hall", plan.boundary),), (), plan.boundary
    )


def test_an_overlap_names_the_surface_and_a_free_pose() -> None:
    pane = Surface(((5.0, 2.5), (5.0, 3.5)), Material.GLASS)
    plan = with_corridor(plan_of(*empty_hall().surfaces, pane))
    error = str(placement_error(plan, WHEELCHAIR, (5.2, 3.0, 0.0)))
    assert "a wheelchair at (5.2, 3, 0) overlaps glass at (5.00, 3.00)" in error
    written = error.split("; (")[1].split(")")[0]
    x, y, heading = map(float, written.split(","))
    assert placement_error(plan, WHEELCHAIR, (x, y, heading)) is None


def test_a_robot_cannot_stand_inside_a_large_table() -> None:
    corners = ((3.0, 2.0), (7.0, 2.0), (7.0, 4.0), (3.0, 4.0), (3.0, 2.0))
    plan = plan_of(*empty_hall().surfaces, Surface(corners, Material.FURNITURE))
    error = placement_error(plan, WHEELCHAIR, (5.0, 3.0, 0.0))
    assert "overlaps furniture around (5.00, 3.00)" in str(error)


def test_a_margin_is_kept() -> None:
    pose = (1.0, WHEELCHAIR.width / 2 + 0.1, 0.0)
    assert placement_error(empty_hall(), WHEELCHAIR, pose, margin=0.09) is None
    assert placement_error(empty_hall(), WHEELCHAIR, pose, margin=0.11) is not None


@pytest.mark.parametrize("name", bundled_names())
@pytest.mark.parametrize("robot", ROBOTS.values(), ids=list(ROBOTS))
def test_sampled_poses_are_free_and_in_a_corridor(name: str, robot: object) -> None:
    assert robot in (WHEELCHAIR, SPOT)
    spec = WHEELCHAIR if robot is WHEELCHAIR else SPOT
    plan = load_floor_plan(name)
    rng = np.random.default_rng(1)
    walls = [LineString(surface.points) for surface in plan.surfaces]
    for _ in range(20):
        pose = sample_pose(plan, spec, rng)
        body = footprint(spec, pose)
        assert min(body.distance(wall) for wall in walls) >= 0.05 - 1e-9
        assert any(region.polygon.covers(Point(pose[:2])) for region in plan.corridors)


def test_the_same_generator_state_gives_the_same_pose() -> None:
    plan = load_floor_plan("office_cross")
    first, second = (sample_pose(plan, SPOT, np.random.default_rng(7)) for _ in range(2))
    assert first == second


def test_a_region_can_be_asked_for() -> None:
    plan = load_floor_plan("office_cross")
    room = plan.region("room_bend_north_2")
    pose = sample_pose(plan, WHEELCHAIR, np.random.default_rng(0), room)
    assert room.polygon.contains(Point(pose[:2]))


def test_where_nothing_is_free_sampling_ends_with_an_error() -> None:
    cell = with_corridor(empty_hall(0.6, 0.6))
    with pytest.raises(ValueError, match="found no free place in a corridor of small"):
        sample_pose(cell, WHEELCHAIR, np.random.default_rng(0))
    with pytest.raises(ValueError, match="no corridor to start in"):
        sample_pose(empty_hall(), WHEELCHAIR, np.random.default_rng(0))
    assert "; (" not in str(placement_error(cell, WHEELCHAIR, (0.3, 0.3, 0.0)))


def test_a_robot_can_be_given_by_its_name() -> None:
    plan = load_floor_plan("heidelberg_hallway")
    assert placement_error(plan, "wheelchair", (-2.5, -0.3, 0.24)) is None
    with pytest.raises(ValueError, match="no robot named 'car'"):
        placement_error(plan, "car", (-2.5, -0.3, 0.24))


def test_uniform_draws_what_the_generator_would() -> None:
    plain, ours = np.random.default_rng(7), np.random.default_rng(7)
    drawn = [(plain.uniform(-high, high), uniform(ours, -high, high)) for high in (0.2, 3.1, 40.0)]
    assert all(there == here for there, here in drawn)
