"""A robot at rest is got going."""

from types import SimpleNamespace

import numpy as np

from semnav_agents.learning.compact import COMPACT_SIZE, VELOCITY
from semnav_agents.learning.inertia import PUSH_DECISIONS, REST_DECISIONS, Inertia
from semnav_env.robots import ROBOTS

HERE = (0.0, 0.0, 0.0)
SEEN = np.zeros(COMPACT_SIZE, np.float32)
LAZY = SimpleNamespace(act=lambda values: values[VELOCITY])
"""A policy that goes on as it moves."""

CONTENT = SimpleNamespace(act=lambda values: np.array([values[VELOCITY][0] - 1.0, 0.0, 0.0]))
"""A policy that moves back, whatever it is asked."""


def actions(policy, poses):
    inertia = Inertia(ROBOTS["spot"])
    return np.array([inertia.act(policy, SEEN, pose) for pose in poses])


def test_a_robot_that_rests_is_pushed_and_asked_again():
    found = actions(LAZY, [HERE] * (REST_DECISIONS + PUSH_DECISIONS))
    pushed = np.abs(found).max(axis=1) > 0.0
    assert not pushed[: REST_DECISIONS - 1].any()
    assert pushed[REST_DECISIONS - 1 : REST_DECISIONS + PUSH_DECISIONS - 1].all()
    assert not pushed[REST_DECISIONS + PUSH_DECISIONS - 1 :].any()


def test_it_is_pushed_to_where_the_policy_wants_to_go():
    assert actions(CONTENT, [HERE] * REST_DECISIONS)[-1, 0] < -0.5


def test_every_push_is_another_one():
    found = actions(LAZY, [HERE] * (3 * REST_DECISIONS))
    pushes = {tuple(action) for action in found if np.abs(action).max() > 0.0}
    assert len(pushes) == 3


def test_a_robot_on_its_way_is_left_alone():
    poses = [(0.05 * k, 0.0, 0.0) for k in range(60)]
    assert not actions(LAZY, poses).any()
