"""No beam passes a wall that stops the body, nor the other way round; glass apart."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pymunk
import pytest
from shapely import LineString

from semnav_env.robots import SPOT
from semnav_env.world.lidar import Lidar, LidarSpec
from semnav_env.world.maps import FloorPlan, Material, bundled_names, load_floor_plan
from semnav_env.world.physics import World
from semnav_features.frames import Pose, to_parent
from tests.support.small_plans import furnished_hall

AROUND = LidarSpec("around", 720, -math.pi, math.tau / 720)
SIDE = 0.04
AHEAD = 360
PROBE = replace(
    SPOT,
    name="probe",
    length=SIDE,
    width=SIDE,
    mass=1.0,
    max_speed=0.9,
    max_acceleration=100.0,
    lidar_mount=(0.0, 0.0, 0.0),
)
REACH = SIDE / math.sqrt(2) + 0.003
"""From the probe's centre to its farthest corner, and how deep it may sink in."""

PLANS = [furnished_hall(), *(load_floor_plan(name) for name in bundled_names())]
plans = pytest.mark.parametrize("plan", PLANS, ids=lambda plan: plan.name)


def without_glass(plan: FloorPlan) -> FloorPlan:
    opaque = tuple(s for s in plan.surfaces if s.material is not Material.GLASS)
    return replace(plan, surfaces=opaque)


def free_poses(world: World, count: int) -> list[Pose]:
    rng = np.random.default_rng(17)
    x1, y1, x2, y2 = world.floor_plan.boundary.bounds
    poses: list[Pose] = []
    while len(poses) < count:
        pose = tuple(rng.uniform((x1, y1, -math.pi), (x2, y2, math.pi)).tolist())
        if world.fits(pose):
            poses.append(pose)
    return poses


def probing(plan: FloorPlan) -> World:
    """A world that reports contacts after every substep."""
    return World(plan, PROBE, control_hz=60, substeps=1)


def push(world: World, start: Pose, metres: float) -> float:
    """How far the probe gets along its heading until it touches something or has come so far."""
    world.reset(start)
    way = 0.0
    while way < metres and not world.in_contact:
        world.step((PROBE.max_speed, 0.0, 0.0))
        way = math.dist(start[:2], world.pose[:2])
    return way


def physics_ranges(space: pymunk.Space, pose: Pose, spec: LidarSpec) -> list[float]:
    ranges = []
    for angle in spec.angles:
        end = to_parent(pose, (spec.range_max * math.cos(angle), spec.range_max * math.sin(angle)))
        hits = space.segment_query(pose[:2], end, 0.0, pymunk.ShapeFilter())
        ranges.append(min((hit.alpha for hit in hits), default=math.inf) * spec.range_max)
    return ranges


@plans
def test_a_beam_ends_where_the_physics_has_something_solid(plan: FloorPlan) -> None:
    plan = without_glass(plan)
    lidar, world = Lidar(plan, AROUND), probing(plan)
    for pose in free_poses(world, 4):
        world.reset(pose)
        for shape in world._body.shapes:
            world._space.remove(shape)
        found = physics_ranges(world._space, pose, AROUND)
        np.testing.assert_allclose(lidar.exact_ranges(pose), found, rtol=0, atol=1e-6)


@plans
def test_a_body_stops_where_its_beam_ends(plan: FloorPlan) -> None:
    """It is pushed along the beam, in random plans."""
    lidar, world = Lidar(plan, AROUND), probing(plan)
    for start in free_poses(world, 25):
        assert push(world, start, AROUND.range_max) <= lidar.exact_ranges(start)[AHEAD]


@plans
def test_a_body_that_goes_on_pushing_never_gets_through(plan: FloorPlan) -> None:
    world = probing(plan)
    for start in free_poses(world, 25):
        push(world, start, AROUND.range_max)
        path = [start[:2]]
        for _ in range(60):
            path.append(world.pose[:2])
            world.step((PROBE.max_speed, 0.0, 0.0))
        assert len(plan.solids.query(LineString(path), predicate="intersects")) == 0


@plans
def test_what_stops_a_body_is_seen_unless_it_is_glass(
    plan: FloorPlan,
) -> None:
    """Beams and contacts use one geometry."""
    plan = without_glass(plan)
    lidar, world = Lidar(plan, AROUND), probing(plan)
    stopped = 0
    for start in free_poses(world, 25):
        if push(world, start, 10.0) < 10.0:
            assert lidar.exact_ranges(world.pose).min() <= REACH
            stopped += 1
    assert stopped > 10


def test_glass_stops_the_body_and_not_the_beam() -> None:
    plan, start = furnished_hall(), (8.0, 1.0, 0.0)
    assert push(probing(plan), start, 3.0) <= 1.0
    assert Lidar(plan, AROUND).exact_ranges(start)[AHEAD] == pytest.approx(4.0)
