from __future__ import annotations

import copy
import gc
import pickle
import subprocess
import sys

import numpy as np
import pytest

from semnav_env.robots import ROBOTS, SPOT, WHEELCHAIR, RobotSpec
from semnav_env.world.maps import load_floor_plan
from semnav_env.world.maps.placement import sample_pose
from semnav_env.world.physics import World
from tests.support.driving import at_the_wall, random_commands, trace
from tests.support.small_plans import empty_hall, furnished_hall

robots = pytest.mark.parametrize("robot", ROBOTS.values(), ids=lambda robot: robot.name)


@robots
def test_the_same_commands_give_the_same_poses_bit_for_bit(robot: RobotSpec) -> None:
    commands = random_commands(3, 600)
    worlds = [World(furnished_hall(), robot) for _ in range(3)]
    for world in worlds:
        world.reset((3.0, 2.0, 0.5))
    first, *others = [trace(world, commands) for world in worlds]
    assert all(other == first for other in others)


def test_what_came_before_a_reset_does_not_matter() -> None:
    used, fresh = at_the_wall(), World(empty_hall(10.0, 6.0), WHEELCHAIR)
    commands = random_commands(4, 300)
    for world in (used, fresh):
        world.reset((3.0, 2.0, 0.5))
    assert trace(used, commands) == trace(fresh, commands)


@robots
def test_a_cleared_space_is_as_good_as_a_new_one(robot: RobotSpec) -> None:
    """One world is reset again and again in contact; each time a new one drives beside it."""
    plan, rng, contacts = load_floor_plan("office_cross"), np.random.default_rng(0), 0
    used = World(plan, robot)
    for episode in range(12):
        pose, fresh = sample_pose(plan, robot, rng), World(plan, robot)
        used.reset(pose)
        fresh.reset(pose)
        for command in random_commands(episode, 30) + [(1.0, 0.1, 0.2)] * 60:
            for world in (used, fresh):
                world.step(command)
            assert (used.pose, used.velocity) == (fresh.pose, fresh.velocity)
            assert (used.contacts, used.touches) == (fresh.contacts, fresh.touches)
            contacts += used.in_contact
    assert contacts > 200


@robots
@pytest.mark.parametrize("duplicate", [copy.deepcopy, lambda w: pickle.loads(pickle.dumps(w))])
def test_a_copy_made_in_contact_goes_on_as_the_original(
    robot: RobotSpec, duplicate: object
) -> None:
    """The robot pushes a wall when the copy is made."""
    world = at_the_wall(robot)
    twin = duplicate(world)  # type: ignore[operator]
    assert (twin.pose, twin.velocity, twin.contacts) == (world.pose, world.velocity, world.contacts)
    commands = [(1.0, 0.2, 0.5)] * 30 + random_commands(6, 200)
    assert trace(twin, commands) == trace(world, commands)


def test_a_world_that_was_never_reset_can_be_pickled() -> None:
    world = pickle.loads(pickle.dumps(World(empty_hall(), WHEELCHAIR)))
    world.reset((3.0, 2.0, 0.5))
    assert world.pose == pytest.approx((3.0, 2.0, 0.5))


def test_another_process_gives_the_same_poses_bit_for_bit() -> None:
    world, commands = at_the_wall(), random_commands(8, 300)
    code = "import pickle, sys; world, run, commands = pickle.load(sys.stdin.buffer); "
    code += "[world.step(c) for c in run + commands]; print(world.pose, world.velocity)"
    fresh = World(world.floor_plan, world.robot)
    fresh.reset((8.0, 3.0, 0.3))
    message = pickle.dumps((fresh, [(1.0, 0.0, 0.0)] * 60, commands))
    done = subprocess.run([sys.executable, "-c", code], input=message, capture_output=True)
    trace(world, commands)
    assert done.stdout.decode().strip() == f"{world.pose} {world.velocity}", done.stderr.decode()


def test_worlds_do_not_influence_each_other() -> None:
    alone, commands = World(empty_hall(), WHEELCHAIR), random_commands(9, 200)
    alone.reset((3.0, 2.0, 0.5))
    expected = trace(alone, commands)
    first, second = World(empty_hall(), WHEELCHAIR), World(furnished_hall(), SPOT)
    first.reset((3.0, 2.0, 0.5))
    second.reset((3.0, 2.0, 0.0))
    found = []
    for command in commands:
        found += trace(first, [command])
        second.step(command)
    assert found == expected


def test_a_copy_in_contact_outlives_its_original() -> None:
    """The physics writes contacts into memory of the world itself."""
    world, commands = at_the_wall(), [(1.0, 0.2, 0.5)] * 30
    expected = trace(copy.deepcopy(world), commands)
    twin = copy.deepcopy(world)
    del world
    gc.collect()
    assert trace(twin, commands) == expected
    assert twin.contacts.count > 0
