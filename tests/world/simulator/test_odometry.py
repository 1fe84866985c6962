from __future__ import annotations

import math
import pickle
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from semnav_env.env import SemNavEnv
from semnav_env.robots import SPOT, WHEELCHAIR, RobotSpec
from semnav_env.world.simulator import (
    ODOMETRIES,
    SPOT_ODOMETRY,
    WHEELCHAIR_ODOMETRY,
    RobotSetup,
    Simulator,
)
from semnav_env.world.simulator.odometry import EXACT, Odometry, OdometrySettings
from semnav_features.frames import Pose, compose, relative
from tests.support.small_plans import empty_hall

START: Pose = (3.0, -2.0, 0.7)
moves = st.tuples(st.floats(-0.2, 0.2), st.floats(-0.2, 0.2), st.floats(-0.3, 0.3))


def drive(errors: OdometrySettings, moves: list[Pose], seed: int = 0) -> Pose:
    """The odometry pose after `moves`, each in the robot frame."""
    odometry, pose = Odometry(errors), START
    odometry.reset(pose, np.random.default_rng(seed))
    for move in moves:
        pose = compose(pose, move)
        odometry.update(pose)
    return odometry.pose


def ends(errors: OdometrySettings, moves: list[Pose], episodes: int = 400) -> np.ndarray:
    return np.array([drive(errors, moves, seed) for seed in range(episodes)])


@given(st.lists(moves, max_size=30))
@settings(deadline=None)
def test_error_free_odometry_is_the_pose_in_the_odom_frame(moves: list[Pose]) -> None:
    true = START
    for move in moves:
        true = compose(true, move)
    expected = relative(START, true)
    found = drive(EXACT, moves)
    assert found[:2] == pytest.approx(expected[:2], abs=1e-9)
    assert math.cos(found[2] - expected[2]) == pytest.approx(1.0, abs=1e-12)


@given(st.lists(moves, max_size=60), st.integers(0, 100))
@settings(deadline=None)
def test_the_heading_stays_in_one_turn(moves: list[Pose], seed: int) -> None:
    assert abs(drive(OdometrySettings(), moves, seed)[2]) <= math.pi + 1e-12


def test_a_robot_that_stands_still_does_not_drift() -> None:
    assert drive(OdometrySettings(), [(0.0, 0.0, 0.0)] * 1000) == (0.0, 0.0, 0.0)


@pytest.mark.parametrize("axis", [0, 1])
def test_distance_bias_scales_the_way_forward_and_sideways(axis: int) -> None:
    move = (0.1, 0.0, 0.0) if axis == 0 else (0.0, 0.1, 0.0)
    found = ends(replace(EXACT, distance_bias=0.02), [move] * 100)[:, axis]
    assert abs(found.mean() - 10.0) < 0.04
    assert abs(found.std() - 0.2) < 0.03


def test_turn_bias_scales_turns() -> None:
    found = ends(replace(EXACT, turn_bias=0.05), [(0.0, 0.0, 0.1)] * 20)[:, 2]
    assert abs(found.mean() - 2.0) < 0.02
    assert abs(found.std() - 0.1) < 0.015


@pytest.mark.parametrize("updates", [10, 1000])
def test_distance_noise_grows_with_the_root_of_the_way(
    updates: int,
) -> None:
    """It does not matter how often odometry is read."""
    moves = [(4.0 / updates, 0.0, 0.0)] * updates
    found = ends(replace(EXACT, distance_noise=0.03), moves)[:, 0]
    assert abs(found.mean() - 4.0) < 0.01
    assert abs(found.std() - 0.06) < 0.01


@pytest.mark.parametrize("updates", [10, 1000])
def test_turn_noise_grows_with_the_root_of_the_turn(updates: int) -> None:
    moves = [(0.0, 0.0, -1.0 / updates)] * updates
    found = ends(replace(EXACT, turn_noise=0.02), moves)[:, 2]
    assert abs(found.mean() + 1.0) < 0.005
    assert abs(found.std() - 0.02) < 0.003


def test_veer_noise_turns_a_straight_way() -> None:
    found = ends(replace(EXACT, veer_noise=0.01), [(0.1, 0.0, 0.0)] * 90)[:, 2]
    assert abs(found.mean()) < 0.005
    assert abs(found.std() - 0.03) < 0.005


def test_drift_depends_on_the_generator_only() -> None:
    way = [(0.1, 0.02, 0.05)] * 50
    assert drive(OdometrySettings(), way, 1) == drive(OdometrySettings(), way, 1)
    assert drive(OdometrySettings(), way, 1) != drive(OdometrySettings(), way, 2)


def test_what_came_before_a_reset_does_not_matter() -> None:
    used, fresh = Odometry(), Odometry()
    used.reset(START, np.random.default_rng(9))
    used.update((9.0, 9.0, 0.0))
    for odometry in (used, fresh):
        odometry.reset(START, np.random.default_rng(1))
        odometry.update((3.1, -2.0, 0.8))
    assert used.pose == fresh.pose


def test_a_pickled_copy_goes_on_as_the_original_does() -> None:
    odometry = Odometry()
    odometry.reset(START, np.random.default_rng(1))
    odometry.update((3.1, -2.0, 0.8))
    copy = pickle.loads(pickle.dumps(odometry))
    assert copy.update((3.3, -1.9, 0.9)) == odometry.update((3.3, -1.9, 0.9))


@pytest.mark.parametrize("value", [-0.1, math.nan, math.inf])
@pytest.mark.parametrize("name", ["distance_bias", "turn_bias", "turn_noise", "veer_noise"])
def test_impossible_settings_are_named(name: str, value: float) -> None:
    with pytest.raises(ValueError, match=f"{name} is .*; it must be a number from 0 to"):
        OdometrySettings(**{name: value})


def test_updating_before_a_reset_is_an_error() -> None:
    with pytest.raises(RuntimeError, match="reset"):
        Odometry().update(START)


def test_a_veer_bias_turns_by_the_distance() -> None:
    found = ends(replace(EXACT, veer_bias=0.01), [(0.1, 0.0, 0.0)] * 90)[:, 2]
    assert found.std() == pytest.approx(0.09, rel=0.1)


def test_scaled_settings_keep_their_slip() -> None:
    assert SPOT_ODOMETRY.scaled(0.0) == replace(EXACT, slip=SPOT_ODOMETRY.slip)
    assert WHEELCHAIR_ODOMETRY.scaled(2.0).veer_bias == 2.0 * WHEELCHAIR_ODOMETRY.veer_bias


def test_slip_is_a_share() -> None:
    with pytest.raises(ValueError, match=r"slip is 1.5; it must be a number from 0 to 1"):
        OdometrySettings(slip=1.5)


@pytest.mark.parametrize("body", [WHEELCHAIR, SPOT], ids=lambda robot: robot.name)
def test_only_a_blocked_robot_slips(body: RobotSpec) -> None:
    """Driven at the wall of a room for three seconds, odometry goes on into the wall."""
    start, travelled = (8.0, 3.0, 0.0), {}
    for slip in (0.0, 1.0):
        simulator = Simulator(empty_hall(), RobotSetup(body, odometry=replace(EXACT, slip=slip)))
        simulator.reset(start, np.random.default_rng(0))
        for _ in range(90):
            sensed = simulator.step((1.0, 0.0, 0.0))
        assert sensed.motion.in_contact
        travelled[slip] = sensed.odometry[0] - relative(start, sensed.motion.pose)[0]
    assert travelled[0.0] == pytest.approx(0.0, abs=1e-9)
    assert 0.05 < travelled[1.0] < 1.0


@pytest.mark.parametrize("name", list(ODOMETRIES))
def test_odometry_has_names(name: str) -> None:
    assert SemNavEnv(odometry=name).usual.odometry == ODOMETRIES[name]


def test_an_unknown_odometry_is_named() -> None:
    with pytest.raises(ValueError, match="no odometry named 'spott'; there are: usual, exact"):
        SemNavEnv(odometry="spott")
