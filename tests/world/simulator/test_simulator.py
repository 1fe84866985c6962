from __future__ import annotations

import copy
import pickle
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from semnav_env.robots import ROBOTS, SPOT, RobotSpec
from semnav_env.world.dynamics import NO_DYNAMICS, Dynamics
from semnav_env.world.physics import world
from semnav_env.world.simulator import EXACT, RobotSetup, Sensed, Simulator
from semnav_env.world.simulator.sensing import TOUCHED, sense
from tests.support.driving import random_commands
from tests.support.small_plans import furnished_hall

USUAL = RobotSetup()
COMMANDS = random_commands(5, 300)
robots = pytest.mark.parametrize("robot", ROBOTS.values(), ids=lambda robot: robot.name)


def started(setup: RobotSetup = USUAL, dynamics: Dynamics = NO_DYNAMICS) -> Simulator:
    simulator = Simulator(furnished_hall(), setup, dynamics)
    simulator.reset((3.0, 2.0, 0.5), np.random.default_rng(7))
    return simulator


def kept(sensed: Sensed) -> tuple[object, ...]:
    return (sensed.ranges.tobytes(), *sensed[1:])


def driven(simulator: Simulator, commands: list[tuple[float, float, float]]) -> list[object]:
    return [kept(simulator.step(command)) for command in commands]


@robots
@pytest.mark.parametrize("people", [0, 3])
def test_pymunk_leads_to_the_same_sensations(
    robot: RobotSpec, people: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    setup, dynamics = RobotSetup(robot), Dynamics(people)
    compiled = driven(started(setup, dynamics), COMMANDS)
    monkeypatch.setattr(world, "chipmunk_can_be_called", lambda: False)
    assert driven(started(setup, dynamics), COMMANDS) == compiled


def test_a_step_is_demand_sense_and_sensed() -> None:
    whole, parts = started(), started()
    for command in COMMANDS:
        parts.demand(command)
        events = sense(parts.arrays)
        assert bool(events & TOUCHED) == parts.world.in_contact
        assert kept(parts.sensed(events)) == kept(whole.step(command))
    assert parts.steps == whole.steps == len(COMMANDS)


def test_what_is_sensed_is_what_the_world_and_odometry_say() -> None:
    simulator = started()
    for command in COMMANDS:
        sensed, real = simulator.step(command), simulator.world
        assert sensed.odometry == simulator.odometry.pose
        assert (sensed.motion.pose, sensed.velocity) == (real.pose, real.velocity)
        assert sensed.motion.speed == pytest.approx(np.hypot(*real.velocity[:2]))
        assert (sensed.motion.in_contact, sensed.bumps) == (real.in_contact, real.touches)


def test_threads_sense_what_one_after_the_other_does() -> None:
    """Also where robots touch something."""
    commands = random_commands(6, 400)
    with ThreadPoolExecutor(4) as pool:
        together = list(pool.map(lambda _: driven(started(), commands), range(4)))
    assert together == [driven(started(), commands)] * 4


def test_an_exact_robot_knows_its_true_pose() -> None:
    simulator = started(RobotSetup(SPOT, odometry=EXACT, exact=True))
    for command in COMMANDS[:40]:
        sensed = simulator.step(command)
        assert sensed.odometry == sensed.motion.pose
        exact = simulator.lidar.exact_ranges(sensed.motion.pose)
        assert sensed.ranges == pytest.approx(exact, abs=1e-9)


@pytest.mark.parametrize("duplicate", [copy.deepcopy, lambda s: pickle.loads(pickle.dumps(s))])
@pytest.mark.parametrize("people", [0, 2])
def test_a_copy_goes_on_as_the_original_and_apart_from_it(
    people: int, duplicate: Callable[[Simulator], Simulator]
) -> None:
    original = started(dynamics=Dynamics(people))
    driven(original, COMMANDS[:100])
    twin = duplicate(original)
    assert twin.steps == original.steps
    assert driven(twin, COMMANDS[100:]) == driven(original, COMMANDS[100:])


def test_a_twist_that_is_refused_changes_nothing() -> None:
    refused, untouched = started(), started()
    with pytest.raises(ValueError, match="three finite numbers"):
        refused.step((0.0, float("nan"), 0.0))
    assert refused.steps == 0
    assert driven(refused, COMMANDS[:20]) == driven(untouched, COMMANDS[:20])


def test_a_simulator_must_be_reset_first() -> None:
    with pytest.raises(RuntimeError, match="reset"):
        Simulator(furnished_hall()).step((0.0, 0.0, 0.0))
