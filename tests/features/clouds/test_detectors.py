"""Detectors of doors in clouds that no simulator made."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from semnav_features import Door, Scene
from semnav_features.clouds import (
    MesDetector,
    MesStep,
    PointCloud,
    door_in_scene,
    expect_door,
    find_door,
    fused,
)
from semnav_features.frames import compose
from tests.support.door_clouds import DOOR, door_cloud, turned, turned_door

SEEDS = st.integers(0, 2**32 - 1)


def off(found, truth):
    return math.dist(found.start, truth.start), math.dist(found.end, truth.end)


def hers(cloud, expected, sigma=0.0, seed=0, **settings):
    return MesDetector(**settings).find_door(cloud, expected, sigma, np.random.default_rng(seed))


@given(SEEDS, st.floats(-3.1, 3.1), st.floats(-0.15, 0.15), st.floats(-0.15, 0.15))
@settings(max_examples=40)
def test_jambs_are_found_to_three_centimetres(seed, turn, along, across):
    """From any direction, and with an expected door that is some way off."""
    cloud = door_cloud(np.random.default_rng(seed))
    truth = turned_door(DOOR, turn)
    expected = turned_door(Door((2.0 + across, 0.45 + along), (2.0 + across, along - 0.45)), turn)
    found = find_door(PointCloud(turned(cloud.points_robot, turn)), expected)
    assert found is not None
    assert found.is_whole
    assert max(off(found, truth)) < 0.03
    assert found.confidence > 0.5


@given(SEEDS, st.floats(0.75, 1.15))
@settings(max_examples=20)
def test_the_width_of_a_door_is_measured(seed, width):
    truth = Door((2.0, 0.5 * width), (2.0, -0.5 * width))
    expected = Door((2.0, 0.48 * width), (2.0, -0.48 * width))
    found = find_door(door_cloud(np.random.default_rng(seed), width), expected)
    assert found is not None
    assert found.width == pytest.approx(truth.width, abs=0.05)


def test_start_and_end_are_those_of_the_expected_door():
    cloud = door_cloud(np.random.default_rng(0))
    other = Door(DOOR.end, DOOR.start)
    for found in (find_door(cloud, other), hers(cloud, other)):
        assert found is not None
        assert max(off(found, other)) < 0.1


@pytest.mark.parametrize("jambs", [(True, False), (False, True)])
def test_one_jamb_is_found_alone_and_the_other_put_beside_it(jambs):
    found = find_door(door_cloud(np.random.default_rng(0), jambs=jambs), DOOR)
    assert found is not None
    assert (found.start_seen, found.end_seen) == jambs
    deviations = np.sqrt(np.diag(found.covariance))
    seen, unseen = (deviations[1], deviations[3]) if jambs[0] else (deviations[3], deviations[1])
    assert seen < 0.04 < unseen
    assert max(off(found, DOOR)) < 0.1


def test_the_covariance_turns_with_the_door():
    cloud = door_cloud(np.random.default_rng(0))
    here = find_door(cloud, DOOR)
    points = turned(cloud.points_robot, 0.5 * math.pi)
    there = find_door(PointCloud(points), turned_door(DOOR, 0.5 * math.pi))
    assert here is not None
    assert there is not None
    swap = [1, 0, 3, 2]
    assert np.allclose(np.diag(there.covariance), np.diag(here.covariance)[swap], rtol=0.1)
    assert (np.linalg.eigvalsh(here.covariance) > 0).all()


@given(SEEDS)
@settings(max_examples=15)
def test_a_wall_without_a_door_has_no_jambs(seed):
    rng = np.random.default_rng(seed)
    wall = np.column_stack((np.full(4000, 2.0), rng.uniform(-2, 2, 4000), rng.uniform(0, 1, 4000)))
    assert find_door(PointCloud(wall + rng.normal(0, 0.01, wall.shape)), DOOR) is None


def test_her_pipeline_finds_the_door_when_the_crop_is_right():
    found = hers(door_cloud(np.random.default_rng(1)), DOOR)
    assert found is not None
    assert found.is_whole
    assert max(off(found, DOOR)) < 0.1


@pytest.mark.parametrize("step", MesStep)
def test_each_step_of_hers_can_be_left_out(step):
    hers(door_cloud(np.random.default_rng(1)), DOOR, without=frozenset({step}))


def test_clouds_are_fused_in_the_frame_of_the_last_pose():
    here, before = (0.5, 0.2, 0.3), (0.1, 0.0, 0.0)
    now, then = PointCloud(np.array([[1.0, 2.0, 0.5]])), PointCloud(np.array([[2.0, 1.0, 0.7]]))
    both = fused([then, now], [before, here]).points_robot
    assert np.allclose(both[1], now.points_robot[0])
    for pose, point in ((before, then.points_robot[0]), (here, both[0])):
        assert np.allclose(compose(pose, (*point[:2], 0.0))[:2], (2.1, 1.0))


def test_the_expected_door_is_less_certain_the_farther_it_is():
    covariance = np.diag([0.01, 0.01, 0.02**2])
    near, near_sigma = expect_door(DOOR, (1.0, 0.0, 0.0), covariance)
    _, far_sigma = expect_door(DOOR, (-8.0, 0.0, 0.0), covariance)
    assert near.start == pytest.approx((1.0, 0.45))
    assert near_sigma == pytest.approx(math.hypot(0.1, 0.02 * math.hypot(1.0, 0.45)), rel=0.05)
    assert far_sigma > near_sigma


def test_of_a_scene_the_nearest_door_is_taken_within_a_gate():
    near, far = Door((2.05, -0.45), (2.05, 0.45)), Door((2.0, 2.5), (2.0, 1.6))
    found = door_in_scene(Scene(doors=(far, near)), DOOR, 0.05)
    assert found is not None
    assert found.start == near.end  # in the order of the expected door
    assert door_in_scene(Scene(doors=(far,)), DOOR, 0.05) is None
    assert door_in_scene(Scene(), DOOR, 0.05) is None


ODD = {
    "empty": np.zeros((0, 3)),
    "one point": np.array([[2.0, 0.45, 0.5]]),
    "all alike": np.tile([2.0, 0.45, 0.5], (500, 1)),
    "NaN": np.full((100, 3), np.nan),
    "infinite": np.full((100, 3), np.inf),
    "on a line": np.outer(np.linspace(0, 1, 300), (4.0, 0.9, 1.8)),
    "no plane": np.random.default_rng(0).uniform((1, -1, 0), (3, 1, 2), (60, 3)),
    "a floor": np.random.default_rng(0).uniform((1, -1, 0), (3, 1, 0.01), (5000, 3)),
    "far away": np.random.default_rng(0).uniform(1e8, 2e8, (500, 3)),
}


@pytest.mark.parametrize("name", ODD)
def test_odd_clouds_show_no_door(name):
    cloud = PointCloud(ODD[name])
    assert find_door(cloud, DOOR) is None
    found = hers(cloud, DOOR, 0.1)
    assert found is None or not found.is_whole


def test_points_that_are_not_finite_change_nothing():
    cloud = door_cloud(np.random.default_rng(0))
    holes = np.full((500, 3), np.nan)
    mixed = PointCloud(np.concatenate((holes, cloud.points_robot, holes)))
    assert np.array_equal(mixed.points_robot, cloud.points_robot)
    a, b = find_door(cloud, DOOR), find_door(mixed, DOOR)
    assert a is not None
    assert b is not None
    assert (a.start, a.end) == (b.start, b.end)


def test_a_million_points_give_the_same_door():
    points = door_cloud(np.random.default_rng(0)).points_robot
    many = np.repeat(points, math.ceil(1_000_000 / len(points)), axis=0)
    many = many + np.random.default_rng(1).normal(0.0, 0.003, many.shape)
    found = find_door(PointCloud(many), DOOR)
    assert found is not None
    assert max(off(found, DOOR)) < 0.04
    hers(PointCloud(many), DOOR, 0.1)


@pytest.mark.parametrize("width", [0.3, 3.0])
def test_a_door_that_is_narrower_or_wider_than_doors_is_not_found(width):
    cloud = door_cloud(np.random.default_rng(0), width=0.5 * width)
    assert find_door(cloud, Door((2.0, 0.5 * width), (2.0, -0.5 * width)), 0.02) is None


def test_arrays_that_are_no_clouds_are_named():
    for wrong, named in (
        (np.zeros((5, 2)), r"shape \(5, 2\)"),
        (np.zeros((2, 5, 3)), r"shape \(2, 5, 3\)"),
        (np.zeros(6), r"shape \(6,\)"),
        ("a door", "array of numbers"),
        ([[1, 2, None], [1, "x", 2]], "array of numbers"),
    ):
        with pytest.raises(ValueError, match=named):
            PointCloud(wrong)
    with pytest.raises(ValueError, match="3 origins for 5 points"):
        PointCloud(np.zeros((5, 3)), np.zeros((3, 3)))
    with pytest.raises(ValueError, match="one pose for each"):
        fused([PointCloud()], [])


def test_expected_doors_that_are_none_are_named():
    cloud = door_cloud(np.random.default_rng(0))
    for door in (Door((2.0, 0.0), (2.0, 0.0)), Door((math.nan, 0.0), (2.0, 0.0))):
        for look in (find_door, hers):
            with pytest.raises(ValueError, match="no finite, wide opening"):
                look(cloud, door, 0.1)
        with pytest.raises(ValueError, match="no finite, wide opening"):
            door_in_scene(Scene(), door, 0.1)
    assert find_door(cloud, DOOR, 1e9) is not None
    with pytest.raises(ValueError, match="sigma is -1"):
        find_door(cloud, DOOR, -1.0)
