"""Ways to drive a world in tests."""

from __future__ import annotations

import numpy as np

from semnav_env.robots import WHEELCHAIR, RobotSpec
from semnav_env.world.physics import World
from semnav_features.frames import Pose
from tests.support.small_plans import empty_hall


def at_the_wall(robot: RobotSpec = WHEELCHAIR) -> World:
    """A world in which the robot leans on a wall at x = 10, at an angle."""
    world = World(empty_hall(10.0, 6.0), robot)
    world.reset((8.0, 3.0, 0.3))
    for _ in range(60):
        world.step((1.0, 0.0, 0.0))
    assert world.in_contact
    return world


def random_commands(seed: int, count: int) -> list[Pose]:
    """Held for half a second each, often at full speed."""
    rng = np.random.default_rng(seed)
    held = rng.uniform((-2.0, -1.0, -2.0), (3.0, 1.0, 2.0), (count // 8 + 1, 3))
    return [tuple(row) for row in held.repeat(8, axis=0)[:count].tolist()]


def trace(world: World, commands: list[Pose]) -> list[Pose]:
    poses = []
    for command in commands:
        world.step(command)
        poses += [world.pose, world.velocity]
    return poses
