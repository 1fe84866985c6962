"""The check of a learned action against remembered obstacles."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from semnav_agents.learning.shield import Shield
from semnav_env.robots import ROBOTS

HERE = (0.0, 0.0, 0.0)
STILL = (0.0, 0.0, 0.0)
ALONG = np.arange(-3.0, 3.0, 0.02)
SHARE = st.floats(-1.0, 1.0, width=32)


def wall_ahead(robot, gap):
    return np.stack((np.full_like(ALONG, robot.length / 2 + gap), ALONG), axis=1)


@pytest.mark.parametrize("robot", ROBOTS)
@given(data=st.data())
def test_in_the_open_every_action_is_kept(robot, data):
    spec = ROBOTS[robot]
    action = np.array([data.draw(SHARE) for _ in range(spec.action_size)], np.float32)
    kept = Shield(spec).checked(action, np.empty((0, 2)), HERE, STILL)
    assert np.allclose(kept, action)


@pytest.mark.parametrize("robot", ROBOTS)
def test_a_robot_slows_down_in_front_of_a_wall(robot):
    spec = ROBOTS[robot]
    action = np.zeros(spec.action_size, np.float32)
    action[0] = 1.0
    fast = (1.0, 0.0, 0.0)
    assert Shield(spec).checked(action, wall_ahead(spec, 2.0), HERE, fast)[0] == 1.0
    assert Shield(spec).checked(action, wall_ahead(spec, 0.6), HERE, fast)[0] < 1.0


@pytest.mark.parametrize("robot", ROBOTS)
def test_at_a_wall_it_does_not_drive_on_but_may_back_out(robot):
    spec = ROBOTS[robot]
    wall, shield = wall_ahead(spec, 0.0), Shield(spec)
    ahead, back = (np.eye(spec.action_size, dtype=np.float32)[0] * sign for sign in (0.5, -0.5))
    assert shield.checked(ahead, wall, HERE, STILL)[0] <= 0.0
    assert np.array_equal(shield.checked(back, wall, HERE, STILL), back)


@pytest.mark.parametrize("robot", ROBOTS)
@pytest.mark.parametrize("gap", [0.005, 0.02, 0.2])
@pytest.mark.parametrize("share", [1.0, 0.1, 0.02, 0.01])
def test_a_robot_that_insists_does_not_creep_onto_a_wall(robot, gap, share):
    """Ten seconds of driving on: many small steps lead to no contact."""
    spec, period, pose = ROBOTS[robot], 1.0 / 15.0, HERE
    wall, shield = wall_ahead(spec, gap), Shield(spec)
    action, speed = share * np.eye(spec.action_size, dtype=np.float32)[0], 0.0
    for _ in range(150):
        seen = wall - (pose[0], 0.0)
        wanted = float(shield.checked(action, seen, HERE, (speed, 0.0, 0.0))[0]) * spec.max_speed
        change = spec.max_acceleration * period
        speed += min(max(wanted - speed, -change), change)
        pose = (pose[0] + speed * period, 0.0, 0.0)
        assert pose[0] < gap


def test_what_it_chooses_does_not_depend_on_the_frame():
    spec = ROBOTS["wheelchair"]
    points = wall_ahead(spec, 0.1)
    moved = points @ np.array([[0.0, 1.0], [-1.0, 0.0]]) + (3.0, 4.0)
    action = np.array([1.0, 0.4], np.float32)
    here = Shield(spec).checked(action, points, HERE, (0.3, 0.0, 0.0))
    there = Shield(spec).checked(action, moved, (3.0, 4.0, np.pi / 2), (0.3, 0.0, 0.0))
    assert np.allclose(here, there)
