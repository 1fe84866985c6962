"""The room around a robot: clearances, and how far it can move."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from semnav_agents.learning.room_memory import (
    NO_HIT,
    PROBED_MOVES,
    SECTORS,
    RoomMemory,
)
from semnav_env.robots import ROBOTS
from tests.support.compact_observations import LIDAR

HERE = (0.0, 0.0, 0.0)
NOTHING = np.empty((0, 2))
STRAIGHT, BACK, LEFT_TURN = 0, 9, 18
"""Rows of `PROBED_MOVES`."""

CHAIR = ROBOTS["wheelchair"]


def room(points, robot=CHAIR):
    return RoomMemory(robot, LIDAR).room(HERE, np.array(points, float).reshape(-1, 2))


@pytest.mark.parametrize(
    ("beam", "x", "y"), [(405, 1.45, 0.0), (135, 0.45, -1.0), (675, 0.45, 1.0)]
)
def test_a_hit_is_as_near_as_it_is_to_the_footprint(beam, x, y):
    """The lidar is 0.45 m before the centre, beams are 1/3 of a degree apart; beam 405 is ahead."""
    scan = np.full(LIDAR.beams, LIDAR.range_max, np.float32)
    scan[beam] = 1.0
    around = RoomMemory(CHAIR, LIDAR)
    around.take_in(HERE, scan)
    around.take_in(HERE, scan)  # one hit may be noise
    clearances = around.room(HERE, NOTHING).clearances
    [sector] = np.flatnonzero(clearances < NO_HIT)
    sides = max(abs(x) - CHAIR.length / 2, 0.0), max(abs(y) - CHAIR.width / 2, 0.0)
    assert clearances[sector] == pytest.approx(np.hypot(*sides), abs=0.01)
    assert sector == pytest.approx((np.arctan2(y, x) / np.pi + 1) * SECTORS / 2, abs=1)


def test_what_was_ahead_is_remembered_behind():
    scan = np.full(LIDAR.beams, 2.0, np.float32)
    around = RoomMemory(ROBOTS["spot"], LIDAR)
    around.take_in(HERE, scan)
    around.take_in(HERE, scan)
    seen = around.room(HERE, NOTHING).clearances
    turned = around.room((0.0, 0.0, np.pi), NOTHING).clearances
    assert seen[0] == NO_HIT
    assert np.allclose(np.roll(turned, SECTORS // 2)[14:-14], seen[14:-14], atol=0.1)
    around.forget()
    assert (around.room(HERE, NOTHING).clearances == NO_HIT).all()


def test_a_robot_in_the_open_can_make_every_move():
    assert (room(NOTHING).free == 1.0).all()


@given(st.floats(0.05, 1.1))
def test_a_robot_gets_as_far_as_the_obstacle_ahead(gap):
    free = room([(CHAIR.length / 2 + gap, 0.0)]).free
    assert free[STRAIGHT] * PROBED_MOVES[STRAIGHT, 0] == pytest.approx(gap, abs=0.051)
    assert free[BACK] == 1.0


def test_a_wheelchair_swings_out_in_front_as_it_turns():
    """Its axle is 0.18 m behind its middle, so its front corners sweep a wider circle."""
    reach = math.hypot(CHAIR.length / 2 - CHAIR.axle, CHAIR.width / 2)
    beside = [(CHAIR.axle, reach - 0.02)], [(CHAIR.axle, reach + 0.02)]
    assert room(beside[0]).free[LEFT_TURN] < 1.0
    assert room(beside[1]).free[LEFT_TURN] == 1.0


def test_a_robot_may_leave_a_point_that_noise_put_into_it():
    free = room([(CHAIR.length / 2 - 0.01, 0.0)]).free
    assert free[STRAIGHT] == 0.0
    assert free[BACK] == 1.0
