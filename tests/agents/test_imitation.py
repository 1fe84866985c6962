"""What a policy imitates, and how."""

import numpy as np
import pytest

pytest.importorskip("torch", reason='needs the extra "rl"')

from semnav_agents.learning.compact import COMPACT_SIZE, VELOCITY
from semnav_agents.learning.imitation import pauses
from semnav_agents.learning.mirrored import mirrored_actions, mirrored_observations
from semnav_env.mind.observations import GOAL
from semnav_features.frames import points_to_parent
from tests.support.compact_observations import LIDAR, compact, observation


def goal(x, y, heading, jambs):
    values = np.zeros(GOAL.size, np.float32)
    values[2], values[4:6], values[-1] = 1.0, (x, y), 1.0
    values[6:8] = np.cos(heading), np.sin(heading)
    values[8:12] = np.ravel(jambs)
    return values


def test_a_mirrored_observation_is_that_of_a_mirrored_world():
    scan = np.full(LIDAR.beams, LIDAR.range_max)
    (a, b), velocity = (
        points_to_parent((2.0, 0.5, 0.3), np.array([(0, -0.5), (0, 0.5)])),
        (0.3, 0, 0.2),
    )
    flip = np.array((1.0, -1.0))
    seen = compact(observation(scan, goal(2.5, 0.7, 0.3, (a, b)), velocity))
    other = goal(2.5, -0.7, -0.3, (b * flip, a * flip))
    expected = compact(observation(scan, other, (0.3, 0, -0.2)))
    assert np.allclose(mirrored_observations(seen[None])[0], expected, atol=1e-4)


@pytest.mark.parametrize("size", [2, 3])
def test_mirroring_twice_changes_nothing(size):
    rng = np.random.default_rng(size)
    observations, actions = rng.normal(size=(5, COMPACT_SIZE)), rng.normal(size=(5, size))
    assert np.array_equal(mirrored_observations(mirrored_observations(observations)), observations)
    assert np.array_equal(mirrored_actions(mirrored_actions(actions)), actions)


def test_who_stands_and_waits_is_not_imitated():
    observations, actions = np.zeros((3, COMPACT_SIZE), np.float32), np.zeros((3, 3), np.float32)
    observations[1, VELOCITY] = 0.3
    actions[2, 0] = 0.5
    found = pauses({"observations": observations, "actions": actions, "returns": actions[:, 0]})
    assert found.tolist() == [True, False, False]
