"""The fifth door of the hall: nothing cuts the square before it, so no other pose is needed."""

from __future__ import annotations

import math

import numpy as np
import pytest
from shapely import Point

from semnav_agents.door_exit import DoorExit
from semnav_env.approach import THESIS_SETTINGS, ApproachPlan, Surroundings, plan_approach
from semnav_env.approach.in_plan import side_towards
from semnav_env.robots import ROBOTS, RobotSpec
from semnav_env.world.maps.check import check
from semnav_env.world.simulator import RobotSetup, Simulator
from tests.approach.test_thesis_tables import TABLE_7_1
from tests.support.villa import DOOR, villa_with_five_doors

PLAN = villa_with_five_doors()
AROUND = Surroundings.of_plan(PLAN)


def planned(name: str) -> ApproachPlan:
    return plan_approach(side_towards(PLAN, PLAN.door(name)), AROUND, settings=THESIS_SETTINGS)


@pytest.mark.parametrize("robot", ROBOTS.values(), ids=lambda robot: robot.name)
def test_nothing_is_wrong_with_the_plan(robot: RobotSpec) -> None:
    assert check(PLAN, robot) == []
    assert len(PLAN.doors) == len(PLAN.rooms) == 5


def test_the_square_before_the_fifth_door_alone_is_free() -> None:
    assert [door.name for door in PLAN.doors if planned(door.name).square_is_free] == [DOOR.name]


@pytest.mark.parametrize("robot", ROBOTS.values(), ids=lambda robot: robot.name)
def test_before_the_fifth_door_one_stands_straight(robot: RobotSpec) -> None:
    """The pose is the scripted one, 1 m before the door and facing it."""
    best = plan_approach(side_towards(PLAN, DOOR), AROUND, robot).best
    assert best is not None
    assert best[:2] == pytest.approx((1.0, 2.45))
    assert abs(best[2]) == pytest.approx(math.pi)


@pytest.mark.parametrize("name", TABLE_7_1)
def test_the_fifth_door_changes_no_row_of_table_7_1(name: str) -> None:
    plan = planned(name)
    assert (len(plan.ranked), plan.clear_count, len(plan.safe)) == TABLE_7_1[name]


@pytest.mark.parametrize("robot", ROBOTS.values(), ids=lambda robot: robot.name)
def test_a_robot_leaves_the_hall_by_the_fifth_door(robot: RobotSpec) -> None:
    start = (1.2, 3.6, -math.pi / 2)
    leaving = DoorExit.named(PLAN, DOOR.name, start, robot)
    simulator = Simulator(PLAN, RobotSetup(robot, exact=True))
    sensed = simulator.reset(start, np.random.default_rng(0))
    for _ in range(60 * 15):
        sensed = simulator.step(leaving.twist(sensed.motion.pose, sensed.velocity))
        if leaving.is_out(sensed.motion.pose):
            break
    assert PLAN.region(DOOR.name).polygon.contains(Point(sensed.motion.pose[:2]))
