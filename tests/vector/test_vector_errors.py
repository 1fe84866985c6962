"""What a vector refuses: bad arguments, bad actions, and calls out of turn."""

import numpy as np
import pytest
from gymnasium.error import ClosedEnvironmentError

from semnav_env.vector import SemNavVectorEnv


@pytest.mark.parametrize(
    ("bad", "message"),
    [
        (np.zeros((2, 3)), "shape"),
        (np.full((2, 2), np.nan), "finite"),
    ],
)
def test_bad_actions_are_refused(bad, message):
    envs = SemNavVectorEnv(2)
    envs.reset(seed=0)
    with pytest.raises(ValueError, match=message):
        envs.step(bad)


def test_a_step_before_the_first_reset_is_refused():
    with pytest.raises(RuntimeError, match="reset"):
        SemNavVectorEnv(2).step(np.zeros((2, 2)))


@pytest.mark.parametrize("name", ["num_envs", "threads", "repeat"])
def test_numbers_below_one_are_refused(name):
    with pytest.raises(ValueError, match=f"{name} is 0"):
        SemNavVectorEnv(**{name: 0})


def test_robots_of_different_shapes_are_refused():
    with pytest.raises(ValueError, match="action"):
        SemNavVectorEnv(2, each=[{"robot": "spot"}, {"robot": "wheelchair"}])


@pytest.mark.parametrize(
    ("each", "message"),
    [
        ([None, {"command": "fly"}], "robot 1: .*fly"),
        ([None, {"comand": "stop"}], "robot 1: no option 'comand'"),
        ([None, "stop"], r"each\[1\] is 'stop'; it must be a dict"),
    ],
)
def test_a_bad_option_is_named_with_its_robot(each, message):
    with pytest.raises(ValueError, match=message):
        SemNavVectorEnv(2).reset(seed=0, options={"each": each})


@pytest.mark.parametrize(
    "wrong",
    [
        lambda envs: envs.call("reset"),
        lambda envs: envs.call("step", np.zeros(2)),
        lambda envs: envs.envs[0].reset(seed=0),
        lambda envs: envs.envs[1].step(np.zeros(2)),
    ],
)
def test_no_robot_of_a_vector_begins_or_drives_alone(wrong):
    envs = SemNavVectorEnv(2)
    envs.reset(seed=0)
    with pytest.raises(RuntimeError, match="with the others"):
        wrong(envs)


def test_a_closed_vector_refuses_to_go_on():
    envs = SemNavVectorEnv(2)
    envs.reset(seed=0)
    envs.close()
    for call in (lambda: envs.step(np.zeros((2, 2))), envs.reset):
        with pytest.raises(ClosedEnvironmentError, match="closed"):
            call()


def test_after_a_refused_reset_no_step_is_possible():
    envs = SemNavVectorEnv(2)
    envs.reset(seed=0)
    with pytest.raises(ValueError, match="fly"):
        envs.reset(options={"each": [{}, {"command": "fly"}]})
    with pytest.raises(RuntimeError, match="reset"):
        envs.step(np.zeros((2, 2)))


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"threads": 0}, "threads"),
        ({"threads": 1.5}, "threads"),
        ({"repeat": 1.5}, "repeat"),
        ({"num_envs": 0}, "num_envs"),
        ({"each": [{}]}, "each has 1 entries for 2 robots"),
        ({"each": {"robot": "spot"}}, "each has 1 entries"),
        ({"each": [{}, {"robot": "sopt"}]}, "robot 1: no robot named 'sopt'"),
        ({"each": [{}, {"floorplan": "office_cross"}]}, r"each\[1\].*mean 'floor_plan'"),
        ({"each": [{}, "office_cross"]}, r"each\[1\] is 'office_cross'; it must be a dict"),
    ],
)
def test_bad_arguments_are_named(options, message):
    with pytest.raises(ValueError, match=message):
        SemNavVectorEnv(**{"num_envs": 2} | options)
