"""Boxes and people that are added by hand while an episode runs."""

from __future__ import annotations

import math

import numpy as np
import pytest

from semnav_env.robots import ROBOTS
from semnav_env.world.dynamics import Dynamics
from semnav_env.world.maps import load_floor_plan
from semnav_env.world.simulator import RobotSetup, Simulator
from semnav_features.frames import FloatArray
from tests.support.moving_worlds import deepest_overlap

START = (-2.5, -0.6, 0.0)
AHEAD = (0.5, 0.0, 0.0)
SETUP = RobotSetup(robot=ROBOTS["wheelchair"], exact=True)


def begun(by_hand: int = 2) -> Simulator:
    """A wheelchair at rest in the hallway, where boxes and people can be added."""
    hallway = load_floor_plan("heidelberg_hallway")
    simulator = Simulator(hallway, SETUP, Dynamics(by_hand=by_hand))
    simulator.reset(START, np.random.default_rng(0))
    return simulator


def box(x: float, y: float) -> FloatArray:
    return np.array(
        [(x - 0.25, y - 0.25), (x + 0.25, y - 0.25), (x + 0.25, y + 0.25), (x - 0.25, y + 0.25)]
    )


def ahead(simulator: Simulator) -> float:
    """The range of the beam straight ahead, metres."""
    world, spec = simulator.world, simulator.lidar.spec
    ranges = simulator.lidar.exact_ranges(world.pose)
    return float(ranges[np.argmin(np.abs(spec.angles))])


def test_an_added_box_is_seen_and_stops_the_robot() -> None:
    simulator = begun()
    before = ahead(simulator)
    simulator.world.add_box(box(-1.0, -0.6))
    assert ahead(simulator) < min(before, 1.5)
    for _ in range(90):
        simulator.step(AHEAD)
    assert simulator.world.in_contact
    assert simulator.world.pose[0] + ROBOTS["wheelchair"].length / 2 < -1.24


def test_an_added_person_walks_and_walks_into_nothing() -> None:
    simulator = begun()
    simulator.world.add_box(box(-1.0, -0.6))
    simulator.world.add_person((0.5, -0.6))
    for _ in range(150):
        simulator.step((0.0, 0.0, 0.0))
        assert deepest_overlap(simulator.world) < 0.01
    people, sides = simulator.world.moving_shapes
    assert people.shape == (1, 3)
    assert sides.shape == (4, 4)
    assert math.dist(people[0, :2], (0.5, -0.6)) > 0.5


def test_a_reset_takes_away_what_was_added() -> None:
    simulator = begun()
    before = simulator.lidar.exact_ranges(START)
    simulator.world.add_box(box(-1.0, -0.6))
    simulator.world.add_person((0.5, -0.6))
    simulator.reset(START, np.random.default_rng(0))
    assert [len(shapes) for shapes in simulator.world.moving_shapes] == [0, 0]
    np.testing.assert_array_equal(simulator.lidar.exact_ranges(START), before)


def test_room_for_additions_changes_nothing_until_they_come() -> None:
    one, other = begun(1), begun(20)
    for _ in range(20):
        ranges = one.step(AHEAD).ranges.copy()
        np.testing.assert_array_equal(other.step(AHEAD).ranges, ranges)
        assert one.world.pose == other.world.pose


def test_what_cannot_be_added_is_refused() -> None:
    simulator = begun(1)
    world = simulator.world
    with pytest.raises(ValueError, match="beside the robot"):
        world.add_box(box(-2.5, -0.6))
    with pytest.raises(ValueError, match="inside the floor plan"):
        world.add_box(box(500.0, 0.0))
    with pytest.raises(ValueError, match="from the robot"):
        world.add_person((-2.5, -0.6))
    world.add_box(box(-1.0, -0.6))
    with pytest.raises(ValueError, match="no box"):
        world.add_person((-1.0, -0.6))
    world.add_person((0.5, -0.6))
    with pytest.raises(ValueError, match="at most 1"):
        world.add_person((3.0, -0.6))
    with pytest.raises(ValueError, match="by_hand is 0"):
        begun(0).world.add_person((0.5, -0.6))
