"""A robot that is carried to another place while an episode runs."""

from __future__ import annotations

import math
import pickle
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from semnav_env.env import SemNavEnv
from semnav_env.robots import ROBOTS
from semnav_env.world.dynamics import Dynamics
from semnav_env.world.dynamics.boxes import BOX_CLEARANCE
from semnav_env.world.maps import load_floor_plan
from semnav_env.world.physics import World
from semnav_env.world.simulator import EXACT, RobotSetup, Simulator
from semnav_features.frames import Pose, relative
from tests.support.episodes import actions, digest, rollout
from tests.support.moving_worlds import deepest_overlap

HALLWAY = load_floor_plan("heidelberg_hallway")
START = (-2.5, -0.6, 0.0)
THERE = (1.0, 0.3, 0.24)
AHEAD = (0.5, 0.0, 0.0)


def begun(robot: str = "wheelchair", **dynamics: Any) -> World:
    world = World(HALLWAY, ROBOTS[robot], dynamics=Dynamics(**dynamics))
    world.reset(START)
    return world


@pytest.mark.parametrize("robot", ["wheelchair", "spot"])
def test_a_carried_robot_stands_there_and_drives_on_as_one_that_began_there(robot: str) -> None:
    carried, fresh = begun(robot), begun(robot)
    for _ in range(10):
        carried.step(AHEAD)
    carried.place_robot(THERE)
    fresh.reset(THERE)
    np.testing.assert_allclose(carried.pose, THERE)
    assert carried.velocity == (0.0, 0.0, 0.0)
    assert not carried.in_contact
    for _ in range(20):
        carried.step(AHEAD)
        fresh.step(AHEAD)
        assert carried.pose == fresh.pose


def test_odometry_feels_that_the_robot_is_carried() -> None:
    simulator = Simulator(HALLWAY, RobotSetup(odometry=EXACT))
    simulator.reset(START, np.random.default_rng(0))
    simulator.step(AHEAD)
    simulator.world.place_robot(THERE)
    sensed = simulator.step((0.0, 0.0, 0.0))
    np.testing.assert_allclose(sensed.odometry, relative(START, THERE), atol=1e-9)


def test_the_belief_of_a_carried_robot_keeps_its_place_in_the_world() -> None:
    """What it remembers stays true, so that the drive can go on."""
    env = SemNavEnv(odometry=EXACT)
    env.reset(seed=0, options={"pose": START, "command": "go down the hallway"})
    list(rollout(env, actions(10, 2)))
    env.world.place_robot(THERE)
    env.step(np.zeros(2, np.float32))
    np.testing.assert_allclose(env.belief.pose, relative(START, env.world.pose), atol=0.05)


def test_the_way_of_a_carried_robot_counts_as_driven_in_a_straight_line() -> None:
    env = SemNavEnv()
    env.reset(seed=0, options={"pose": START, "command": "go down the hallway"})
    env.world.place_robot(THERE)
    info = env.step(np.zeros(2, np.float32))[-1]
    assert info["path_length"] == pytest.approx(math.dist(START[:2], THERE[:2]), abs=0.01)


@pytest.mark.parametrize("by_hand", [0, 1])
def test_a_copy_repeats_that_the_robot_was_carried(by_hand: int) -> None:
    """Also where only the robot moves, and compiled code drives alone."""
    env = SemNavEnv(observation="all", dynamics=Dynamics(by_hand=by_hand))
    steps, seen = actions(60, 2), []
    for copied in (False, True):
        env.reset(seed=3, options={"pose": START})
        list(rollout(env, steps[:30]))
        env.world.place_robot(THERE)
        list(rollout(env, steps[30:40]))
        twin = pickle.loads(pickle.dumps(env)) if copied else env
        seen.append(digest(rollout(twin, steps[40:])))
    assert seen[0] == seen[1]


@pytest.mark.parametrize(
    ("pose", "why"),
    [
        ((500.0, 0.0, 0.0), "outside"),
        ((2.5, -0.16, 0.0), "overlaps wall"),
        ((1.0, 0.3), "three finite numbers"),
        ((math.nan, 0.0, 0.0), "three finite numbers"),
        ((0.8, 0.2, 0.0), "no person, leaf or box"),
        ((-1.0, -0.5, 0.24), "no person, leaf or box"),
    ],
)
def test_a_robot_is_carried_to_free_floor_only(pose: Pose, why: str) -> None:
    world = begun(by_hand=1)
    world.add_box((-1.0, -0.6))
    world.add_person((1.0, 0.4))
    before = pickle.dumps(world)
    with pytest.raises(ValueError, match=why):
        world.place_robot(pose)
    assert pickle.dumps(world) == before


def test_before_an_episode_there_is_nothing_to_carry() -> None:
    with pytest.raises(RuntimeError, match="reset"):
        World(HALLWAY, ROBOTS["spot"]).place_robot(THERE)


@pytest.fixture(scope="module")
def busy() -> World:
    return begun(pedestrians=3, changing_doors=1.0)


@settings(max_examples=40, deadline=None)
@given(
    pose=st.tuples(st.floats(-5.0, 10.0), st.floats(-6.0, 8.0), st.floats(-math.pi, math.pi)),
    turn=st.floats(-0.5, 0.5),
)
def test_wherever_a_robot_is_carried_nothing_overlaps_it(
    busy: World, pose: Pose, turn: float
) -> None:
    busy.reset(START)
    busy.step(AHEAD)
    try:
        busy.place_robot(pose)
    except ValueError:
        return
    assert busy.moving is not None
    assert busy.moving.clearance(busy.pose) > BOX_CLEARANCE
    for _ in range(15):
        busy.step((0.3, 0.0, turn))
        assert deepest_overlap(busy) < 0.01
