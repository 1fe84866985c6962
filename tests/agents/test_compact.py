"""What a small policy sees: the goal, the velocity and the room around."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from semnav_agents.learning.compact import COMPACT_SIZE, CompactObserver
from semnav_env.mind.observations import GOAL, UNBOUNDED
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
