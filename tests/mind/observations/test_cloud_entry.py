"""The cloud of depth cameras in the observation."""

import numpy as np
import pytest

from semnav_env.env import SemNavEnv
from semnav_env.mind.observations import CloudEntry, EntryObservation, Moment
from semnav_env.robots import DepthRig

START = {"command": "go through the first door on the left", "pose": (1.2, 4.3, -1.57)}


def clouded(points=512):
    observation = EntryObservation("semantic", [CloudEntry(DepthRig.spot(), points)])
    return SemNavEnv("spot", "villa_hall", observation)


def test_an_observation_holds_the_cloud():
    env = clouded()
    observation, _ = env.reset(seed=3, options=START)
    assert env.observation_space.contains(observation)
    rows = observation["cloud"].reshape(-1, 4)
    assert (rows[:, 3] == 1.0).all()
    assert np.ptp(rows[:, 0]) > 1.0


def test_rows_that_are_left_over_do_not_count():
    env = clouded(points=40_000)
    observation, _ = env.reset(seed=3, options=START)
    rows = observation["cloud"].reshape(-1, 4)
    assert 0 < rows[:, 3].sum() < 40_000
    assert not rows[rows[:, 3] == 0.0].any()


def test_the_same_seed_gives_the_same_clouds_and_each_step_another():
    runs = []
    for _ in range(2):
        env = clouded()
        first = env.reset(seed=3, options=START)[0]["cloud"]
        runs.append((first, env.step(np.zeros(3))[0]["cloud"]))
    assert np.array_equal(runs[0], runs[1])
    assert not np.array_equal(*runs[0])


def test_asking_for_clouds_changes_nothing_else():
    plain = SemNavEnv("spot", "villa_hall", "semantic")
    others = []
    for env in (plain, clouded()):
        observation, _ = env.reset(seed=3, options=START)
        for _ in range(3):
            observation = env.step(np.array([0.5, 0.0, 0.1]))[0]
        others.append({name: value for name, value in observation.items() if name != "cloud"})
    assert all(np.array_equal(others[0][name], others[1][name]) for name in others[0])


def test_bad_cloud_entries_are_named():
    with pytest.raises(ValueError, match="at least 1"):
        CloudEntry(DepthRig.spot(), 0)
    env = clouded()
    env.reset(seed=3, options=START)
    moment = Moment(env.tracker, env.tokens)
    with pytest.raises(ValueError, match="no depth cameras"):
        CloudEntry(DepthRig.spot()).observe(moment)
