"""A robot that can touch nothing moves as the physics engine would move it, without being asked."""

from __future__ import annotations

import math
import pickle

import numpy as np
import pytest
from shapely import Point

from semnav_env.robots import ROBOTS, SPOT, RobotSpec
from semnav_env.world.dynamics import Dynamics
from semnav_env.world.lidar.culling import cell_of
from semnav_env.world.maps import FloorPlan, load_floor_plan
from semnav_env.world.physics import World
from semnav_env.world.physics.free_motion import culling_around
from semnav_features.frames import Pose, wrap_angle
from tests.support.driving import random_commands
from tests.support.moving_worlds import world_of
from tests.support.small_plans import empty_hall, furnished_hall

PLANS = [
    (empty_hall(40.0, 40.0), (20.0, 20.0, 0.3)),
    (furnished_hall(), (3.0, 2.0, 0.5)),
    (load_floor_plan("office_cross"), (3.0, 9.1, 0.0)),
]


def asking_always(plan: FloorPlan, robot: str) -> World:
    """A world in which the joints are never thought to suffice."""
    world = World(plan, ROBOTS[robot])
    world.record["joint_change"] = 0.0
    return world


def moved_freely(world: World) -> bool:
    return bool(world.record["is_ahead"][0])


def gentle_commands(seed: int, count: int) -> list[Pose]:
    """Changing by less than the joints can change the velocity in a substep."""
    changes = np.random.default_rng(seed).uniform(-0.05, 0.05, (count, 3))
    return [tuple(row) for row in np.clip(changes.cumsum(axis=0), -0.4, 0.4).tolist()]


@pytest.mark.parametrize("robot", ROBOTS)
def test_a_free_robot_moves_as_chipmunk_moves_it_bit_for_bit(robot: str) -> None:
    plan = empty_hall(40.0, 40.0)
    freely, asking = World(plan, ROBOTS[robot]), asking_always(plan, robot)
    for world in (freely, asking):
        world.reset((20.0, 20.0, 0.3))
    for command in gentle_commands(1, 600):
        freely.step(command)
        asking.step(command)
        assert (freely.pose, freely.velocity) == (asking.pose, asking.velocity)
        assert moved_freely(freely)
        assert not moved_freely(asking)


@pytest.mark.parametrize("robot", ROBOTS)
@pytest.mark.parametrize(("plan", "start"), PLANS, ids=lambda each: getattr(each, "name", ""))
def test_until_the_first_contact_the_motion_is_that_of_chipmunk(
    plan: FloorPlan, start: Pose, robot: str
) -> None:
    """Where the physics is asked in between, rounding differs: its joints remember their force.

    In contact with several walls at once the physics takes them in an order of its own.
    """
    freely, asking, count = World(plan, ROBOTS[robot]), asking_always(plan, robot), 0
    for seed in range(5):
        for world in (freely, asking):
            world.reset(start)
        for command in random_commands(seed, 200):
            freely.step(command)
            asking.step(command)
            if asking.in_contact:
                break
            assert np.allclose(freely.pose, asking.pose, rtol=0.0, atol=1e-12)
            assert np.allclose(freely.velocity, asking.velocity, rtol=0.0, atol=1e-12)
            count += moved_freely(freely)
    assert count > 10


@pytest.mark.parametrize("robot", ROBOTS)
def test_where_the_physics_is_not_asked_the_whole_way_is_free(robot: str) -> None:
    """Driven into furniture and along it."""
    world, asked, free = World(furnished_hall(), ROBOTS[robot]), 0, 0
    for seed in range(20):
        world.reset((3.0, 2.0, 0.5))
        for command in random_commands(seed, 100):
            before = np.array(world.pose)
            world.step(command)
            way = np.array(world.pose) - before
            way[2] = wrap_angle(way[2])
            asked += world.in_contact
            free += moved_freely(world)
            if moved_freely(world):
                assert not world.in_contact
                assert all(world.fits(before + share * way) for share in (0.25, 0.5, 0.75, 1.0))
    assert min(asked, free) > 100


def test_the_physics_is_asked_for_more_than_the_joints_can() -> None:
    """SPOT's legs may accelerate by 2 m/s^2 within a period, the joints by less in a substep."""
    world = World(empty_hall(40.0, 40.0), SPOT)
    world.reset((20.0, 20.0, 0.0))
    world.step((1.6, 0.0, 0.0))
    assert not moved_freely(world)
    world.step((0.13, 0.0, 0.0))
    assert moved_freely(world)


def test_the_physics_is_asked_where_people_walk() -> None:
    world = world_of("office_cross", "spot", Dynamics(3))
    world.reset((3.0, 9.1, 0.0), np.random.default_rng(0))
    for _ in range(20):
        world.step((0.1, 0.0, 0.0))
        assert not moved_freely(world)


@pytest.mark.parametrize("robot", ROBOTS.values(), ids=ROBOTS)
def test_near_a_place_all_is_listed_that_a_body_there_can_touch(robot: RobotSpec) -> None:
    """Glass too."""
    plan, period = load_floor_plan("heidelberg_hallway"), 1.0 / 15.0
    culling = culling_around(plan, robot, period)
    reach = math.hypot(robot.length, robot.width) / 2 + period * robot.max_speed
    for x, y in np.random.default_rng(4).uniform((-8.0, -3.0), (8.0, 3.0), (200, 2)):
        cell = cell_of(culling.grid, x, y)
        listed = culling.ends[:, culling.starts[cell] : culling.starts[cell + 1]].T.tolist()
        touched = plan.solids.query(Point(x, y), predicate="dwithin", distance=reach)
        assert {tuple(plan.segments[k]) for k in touched} <= set(map(tuple, listed))


def test_a_pickled_world_goes_on_where_a_free_one_was() -> None:
    world = World(furnished_hall(), SPOT)
    world.reset((3.0, 2.0, 0.5))
    for command in random_commands(2, 100):
        world.step(command)
    copy = pickle.loads(pickle.dumps(world))
    for command in random_commands(3, 100):
        world.step(command)
        copy.step(command)
        assert (world.pose, world.contacts) == (copy.pose, copy.contacts)
