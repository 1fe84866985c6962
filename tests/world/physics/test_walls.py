"""Walls that are made all at once are those of Pymunk, and go with their space."""

import gc
import weakref

import numpy as np
import pymunk
import pytest
from pymunk import cp

from semnav_env.robots import SPOT, WHEELCHAIR, RobotSpec
from semnav_env.world.maps import load_floor_plan
from semnav_env.world.physics import World, chipmunk, walls
from semnav_env.world.physics.bodies import solid_space
from semnav_env.world.physics.spare_spaces import SpareSpaces
from semnav_features.frames import FloatArray

PLAN = load_floor_plan("office:medium:3")


def walls_of_pymunk(space: pymunk.Space, segments: FloatArray) -> None:
    """The same, one by one."""
    for x1, y1, x2, y2 in segments.tolist():
        shape = pymunk.Segment(space.static_body, (x1, y1), (x2, y2), 0.0)
        shape.friction = walls.WALL_FRICTION
        space.add(shape)


def driven(robot: RobotSpec, monkeypatch: pytest.MonkeyPatch) -> bytes:
    """The motion and contacts of a robot that is driven into walls and along them."""
    monkeypatch.setattr("semnav_env.world.physics.world.SPARE_SPACES", SpareSpaces())
    world, told = World(PLAN, robot), []
    corridor = PLAN.corridors[0].polygon.centroid
    world.reset((corridor.x, corridor.y, 0.3))
    for k in range(400):
        world.step((1.0, 0.3 * robot.max_sideways_speed, 0.5 if k % 40 < 15 else -0.4))
        told.append((*world.pose, *world.velocity, world.contacts.count, world.contacts.impulse))
    assert sum(row[6] for row in told) > 100, "the robot hardly touched anything"
    return np.array(told).tobytes()


@pytest.mark.parametrize("robot", [WHEELCHAIR, SPOT])
@pytest.mark.parametrize("compiled", [True, False])
def test_a_robot_meets_them_as_it_meets_walls_of_pymunk(
    robot: RobotSpec, compiled: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    if not compiled:
        monkeypatch.setattr("semnav_env.world.physics.world.chipmunk_can_be_called", lambda: False)
    at_once = driven(robot, monkeypatch)
    monkeypatch.setattr("semnav_env.world.physics.bodies.add_walls", walls_of_pymunk)
    assert driven(robot, monkeypatch) == at_once


def test_compiled_and_plain_calls_agree_on_them() -> None:
    assert chipmunk._meet_a_wall(compiled=True) == chipmunk._meet_a_wall(compiled=False)


def test_walls_are_freed_with_their_space(monkeypatch: pytest.MonkeyPatch) -> None:
    freed: list[object] = []
    gc.collect()  # of other spaces
    monkeypatch.setattr(walls, "cp", _Counting(freed))
    space = solid_space(PLAN.segments)
    gone = weakref.ref(space)
    space.step(0.01)
    del space
    gc.collect()
    assert gone() is None
    assert len(freed) == len(PLAN.segments)


class _Counting:
    """Chipmunk, which notes the shapes that are freed."""

    def __init__(self, freed: list[object]) -> None:
        self._freed = freed

    def __getattr__(self, name: str) -> object:
        if name == "cpShapeFree":
            return lambda shape: (self._freed.append(shape), cp.cpShapeFree(shape))
        return getattr(cp, name)
