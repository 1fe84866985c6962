"""What a small policy sees: the goal, the velocity and the room around."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from semnav_env.agents.learning.clearance_memory import NO_HIT, SECTORS, ClearanceMemory
from semnav_env.agents.learning.compact import COMPACT_SIZE, CompactObserver
from semnav_env.observations import GOAL, UNBOUNDED
from semnav_env.robots import ROBOTS
from semnav_env.vector import SemNavVectorEnv
from tests.support.compact_observations import LIDAR, compact, observation


@given(
    arrays(np.float32, LIDAR.beams, elements=st.floats(0, 50, width=32)),
    arrays(np.float32, GOAL.size, elements=st.floats(-UNBOUNDED, UNBOUNDED, width=32)),
    st.tuples(*[st.floats(-3, 3)] * 3),
)
def test_every_value_lies_between_minus_one_and_one(scan, goal, velocity):
    goal[:4], goal[6:8], goal[-1] = 0, 1, 1
    values = compact(observation(scan, goal, velocity))
    assert values.shape == (COMPACT_SIZE,)
    assert values.dtype == np.float32
    assert np.abs(values).max() <= 1


@pytest.mark.parametrize(
    ("beam", "x", "y"), [(405, 1.45, 0.0), (135, 0.45, -1.0), (675, 0.45, 1.0)]
)
def test_a_hit_is_as_near_as_it_is_to_the_footprint(beam, x, y):
    """The lidar is 0.45 m before the centre, beams are 1/3 of a degree apart; beam 405 is ahead."""
    scan = np.full((1, LIDAR.beams), LIDAR.range_max, np.float32)
    scan[0, beam] = 1.0
    robot = ROBOTS["wheelchair"]
    room = ClearanceMemory([robot], LIDAR).clearances(np.array([0]), np.zeros((1, 3)), scan)[0]
    [sector] = np.flatnonzero(room < NO_HIT)
    sides = max(abs(x) - robot.length / 2, 0.0), max(abs(y) - robot.width / 2, 0.0)
    assert room[sector] == pytest.approx(np.hypot(*sides), abs=0.01)
    assert sector == pytest.approx((np.arctan2(y, x) / np.pi + 1) * SECTORS / 2, abs=1)


def test_what_was_ahead_is_remembered_behind():
    scan = np.full((1, LIDAR.beams), 2.0, np.float32)
    clear = np.full((1, LIDAR.beams), LIDAR.range_max, np.float32)
    around, here = ClearanceMemory([ROBOTS["spot"]], LIDAR), np.array([0])
    seen = around.clearances(here, np.zeros((1, 3)), scan)[0]
    turned = around.clearances(here, np.array([[0.0, 0.0, np.pi]]), clear)[0]
    assert seen[0] == NO_HIT
    assert np.allclose(np.roll(turned, SECTORS // 2)[14:-14], seen[14:-14], atol=0.1)
    around.forget(np.array([True]))
    assert (around.clearances(here, np.zeros((1, 3)), clear) == NO_HIT).all()


def test_a_place_keeps_its_direction():
    goal = np.zeros(GOAL.size, np.float32)
    goal[4:6] = 30.0, 40.0
    x, y = compact(observation(np.ones(LIDAR.beams), goal))[5:7]
    assert (x, y) == pytest.approx((30 / 51, 40 / 51))


@pytest.mark.parametrize("robot", ROBOTS)
def test_many_observations_become_compact_to_the_bits_of_single_ones(robot):
    envs = SemNavVectorEnv(5, robot=robot, observation="all")
    first, _ = envs.reset(seed=0)
    spec, lidar = envs.envs[0].robot, envs.envs[0].lidar_spec
    together, alone = CompactObserver([spec] * 5, lidar), CompactObserver([spec] * 5, lidar)
    for seen in (first, envs.step(envs.action_space.sample())[0]):
        rows = together.observe(seen)
        assert np.abs(rows).max() <= 1
        for k, row in enumerate(rows):
            of_one = {name: entry[k : k + 1] for name, entry in seen.items()}
            assert row.tobytes() == alone.observe(of_one, [k])[0].tobytes()
