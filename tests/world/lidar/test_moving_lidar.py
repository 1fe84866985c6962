"""No beam passes what stops a body, and the other way round, also where things move."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pymunk
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import LineString, Point

from semnav_env.robots import SPOT
from semnav_env.world.dynamics import Dynamics, PlanSource
from semnav_env.world.lidar import Lidar, LidarSpec
from semnav_env.world.maps import load_floor_plan
from semnav_env.world.maps.placement import sample_pose
from semnav_env.world.physics import World
from semnav_features.frames import Pose
from tests.support.small_plans import plan_of
from tests.world.physics.test_one_geometry import physics_ranges, without_glass

AROUND = LidarSpec("around", 360, -math.pi, math.tau / 360)
AHEAD = 180
PROBE = replace(
    SPOT,
    name="probe",
    lidar_mount=(0.0, 0.0, 0.0),
    length=0.04,
    width=0.04,
    mass=1.0,
    max_speed=0.9,
    max_acceleration=100.0,
)
numbers = st.floats(-8.0, 8.0)
discs_drawn = st.lists(st.tuples(numbers, numbers, st.floats(0.1, 0.5)), max_size=4)
leaves_drawn = st.lists(
    st.tuples(numbers, numbers, numbers, numbers).filter(lambda e: math.dist(e[:2], e[2:]) > 0.1),
    max_size=3,
)


@given(discs_drawn, leaves_drawn, st.tuples(numbers, numbers, st.floats(-3.1, 3.1)))
@settings(max_examples=60, deadline=None)
def test_a_beam_ends_at_the_nearest_disc_or_segment(
    discs: list[tuple[float, ...]], leaves: list[tuple[float, ...]], pose: Pose
) -> None:
    if any(math.dist(disc[:2], pose[:2]) < disc[2] + 1e-3 for disc in discs):
        return
    if any(_distance(leaf, pose) < 1e-3 for leaf in leaves):
        return
    space = pymunk.Space()
    for x, y, radius in discs:
        space.add(pymunk.Circle(space.static_body, radius, (x, y)))
    for a, b, c, d in leaves:
        space.add(pymunk.Segment(space.static_body, (a, b), (c, d), 0.0))
    moving = np.array(discs).reshape(-1, 3), np.array(leaves).reshape(-1, 4)
    found = Lidar(plan_of(), AROUND, moving=moving).exact_ranges(pose)
    expected = np.array(physics_ranges(space, pose, AROUND))
    expected[expected >= AROUND.range_max - 1e-9] = math.inf
    apart = np.abs(np.nan_to_num(found, posinf=20.0) - np.nan_to_num(expected, posinf=20.0))
    assert np.count_nonzero(apart > 1e-6) <= 2, "but for beams that graze an end or a rim"


def _distance(leaf: tuple[float, ...], pose: Pose) -> float:
    return float(LineString([leaf[:2], leaf[2:]]).distance(Point(pose[:2])))


def test_what_is_seen_follows_what_moves() -> None:
    discs = np.array([[3.0, 0.0, 0.25]])
    lidar = Lidar(plan_of(), AROUND, moving=(discs, np.zeros((0, 4))))
    assert lidar.exact_ranges((0.0, 0.0, 0.0))[AHEAD] == pytest.approx(2.75)
    discs[0, 0] = 5.0
    assert lidar.exact_ranges((0.0, 0.0, 0.0))[AHEAD] == pytest.approx(4.75)
    discs[0, 1] = 3.0
    assert lidar.exact_ranges((0.0, 0.0, 0.0))[AHEAD] == math.inf


def crowded(plan: str) -> tuple[World, Lidar]:
    """A world of people and swinging doors without glass, after which the lidar looks."""
    dynamics = Dynamics(pedestrians=8, changing_doors=1.0)
    staged = PlanSource(without_glass(load_floor_plan(plan)), dynamics, PROBE).plan()
    world = World(staged, PROBE, dynamics=dynamics)
    return world, Lidar(world.still, AROUND, moving=world.moving_shapes)


@pytest.mark.parametrize("plan", ["office_cross", "villa_hall"])
def test_a_beam_ends_where_the_physics_has_somebody_or_a_leaf(plan: str) -> None:
    world, lidar = crowded(plan)
    rng, met = np.random.default_rng(3), 0
    for _ in range(6):
        world.reset(sample_pose(world.floor_plan, PROBE, rng), rng)
        for _ in range(60):
            world.step((0.0, 0.0, 0.0))
        here = world.pose
        for shape in world._body.shapes:
            world._space.remove(shape)
        found = lidar.exact_ranges(here)
        expected = physics_ranges(world._space, here, AROUND)
        np.testing.assert_allclose(found, expected, rtol=0, atol=1e-6)
        met += np.count_nonzero(found < Lidar(world.still, AROUND).exact_ranges(here))
    assert met > 20


def test_a_body_stops_before_the_person_that_its_beam_meets() -> None:
    """It is pushed along the beam."""
    world, lidar = crowded("office_cross")
    rng, stopped = np.random.default_rng(6), 0
    for _ in range(12):
        world.reset(sample_pose(world.floor_plan, PROBE, rng), rng)
        for _ in range(90):
            free = lidar.exact_ranges(world.pose)[AHEAD]
            before = world.pose
            world.step((PROBE.max_speed, 0.0, 0.0))
            way = math.dist(before[:2], world.pose[:2])
            assert way <= free + 0.01, "further than the beam of that moment, people aside"
            stopped += world.in_contact
    assert stopped > 10
