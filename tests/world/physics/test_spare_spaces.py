"""A world in a space that was used before drives as one in a new space, to the last bit."""

import gc
from weakref import ref

import numpy as np
import pytest

from semnav_env.robots import SPOT, WHEELCHAIR, RobotSpec
from semnav_env.world.maps import load_floor_plan
from semnav_env.world.physics import World, spare_spaces
from semnav_env.world.physics.spare_spaces import MOST_SPARE, SpareSpaces
from tests.support.small_plans import empty_hall

PLAN = load_floor_plan("heidelberg_hallway")
START = (0.0, 0.0, 0.3)


def driven(robot: RobotSpec) -> np.ndarray:
    """The poses of a robot that is driven into a wall and along it."""
    world = World(PLAN, robot)
    world.reset(START)
    poses = []
    for k in range(60):
        world.step((1.0, 0.2 * robot.max_sideways_speed, 0.4 if k % 20 < 10 else -0.4))
        poses.append((*world.pose, *world.velocity, world.in_contact))
    return np.array(poses)


@pytest.fixture
def spare(monkeypatch: pytest.MonkeyPatch) -> SpareSpaces:
    found = SpareSpaces()
    monkeypatch.setattr("semnav_env.world.physics.world.SPARE_SPACES", found)
    return found


@pytest.mark.parametrize("robot", [WHEELCHAIR, SPOT])
def test_a_robot_in_a_used_space_moves_as_in_a_new_one(
    robot: RobotSpec, spare: SpareSpaces
) -> None:
    new = driven(robot)
    for other in (SPOT, WHEELCHAIR, robot):
        gc.collect()
        made = spare_spaces.SpareSpaces.take(spare, PLAN)
        assert made is not None, "the space of the last world was not given back"
        spare.give(PLAN, made)
        again = driven(other)
    assert new[:, -1].any(), "the robot touched nothing"
    assert again.tobytes() == new.tobytes()


def test_a_space_is_taken_once_and_only_for_its_own_plan(spare: SpareSpaces) -> None:
    world = World(PLAN, SPOT)
    world.reset(START)
    assert spare.take(PLAN) is None, "a space in use was given"
    del world
    gc.collect()
    assert spare.take(load_floor_plan("office_cross")) is None
    assert spare.take(PLAN) is not None
    assert spare.take(PLAN) is None


def test_a_space_goes_with_its_floor_plan(spare: SpareSpaces) -> None:
    plan, space = empty_hall(), set()
    spare.give(plan, space)
    kept = ref(space)
    del plan, space
    gc.collect()
    assert spare.take(PLAN) is None
    assert kept() is None


def test_no_more_spaces_are_kept_than_a_split_needs(spare: SpareSpaces) -> None:
    given = [object() for _ in range(MOST_SPARE + 5)]
    for space in given:
        spare.give(PLAN, space)
    taken = [spare.take(PLAN) for _ in given]
    assert taken[:MOST_SPARE] == given[5:]
    assert taken[MOST_SPARE:] == [None] * 5
