"""Which room a robot searches that is told to, and where it turns to look around."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from semnav_agents.searching.finding_tasks import LookTask, Percepts
from semnav_agents.searching.house_plan import HousePlan, numbers_of, room_entered
from semnav_agents.searching.settings import SearchSettings
from semnav_agents.searching.views import Looker
from semnav_env.robots import SPOT, WHEELCHAIR, RobotSpec
from semnav_env.world.maps import load_floor_plan
from semnav_features.frames import Pose

VILLA = load_floor_plan("villa_hall")
CHART = HousePlan(VILLA, (0.0, 0.0, 0.0)).chart(SearchSettings())
[KITCHEN] = numbers_of(VILLA, "kitchen")
LIVING_ROOM = VILLA.room_names.index("living room")
ALL = numbers_of(VILLA, None)
AHEAD, BACKWARD, STANDS = (0.4, 0.0, 0.0), (-0.4, 0.0, 0.0), (0.0, 0.0, 0.0)
LEFT = (0.0, 0.4, 0.0)


@pytest.mark.parametrize(
    ("heading", "velocity"),
    [(-90.0, AHEAD), (90.0, BACKWARD), (180.0, LEFT), (-90.0, STANDS)],
)
def test_a_robot_in_a_doorway_is_in_the_room_into_which_it_drives(
    heading: float, velocity: tuple[float, float, float]
) -> None:
    in_door: Pose = (1.35, -0.1, math.radians(heading))
    assert room_entered(CHART, ALL, in_door, velocity, WHEELCHAIR.width) == KITCHEN


def test_a_robot_that_backs_into_a_named_room_searches_that_room() -> None:
    inside: Pose = (2.75, 1.66, math.pi)
    for velocity in (AHEAD, BACKWARD, STANDS):
        found = room_entered(CHART, [LIVING_ROOM], inside, velocity, WHEELCHAIR.width)
        assert found == LIVING_ROOM


@given(st.floats(-math.pi, math.pi), st.sampled_from([AHEAD, BACKWARD, LEFT, STANDS]))
def test_a_robot_beside_a_wall_is_not_in_the_room_behind_it(
    heading: float, velocity: tuple[float, float, float]
) -> None:
    """Its side is 5 cm from the wall to the living room."""
    pose: Pose = (2.4 - WHEELCHAIR.width / 2 - 0.05, 3.0, heading)
    assert room_entered(CHART, ALL, pose, velocity, WHEELCHAIR.width) != LIVING_ROOM


@given(
    st.floats(2.8, 6.8),
    st.floats(0.5, 4.4),
    st.floats(-math.pi, math.pi),
    st.sampled_from([SPOT, WHEELCHAIR]),
)
def test_a_body_that_turns_where_it_goes_to_look_around_touches_no_wall(
    x: float, y: float, heading: float, robot: RobotSpec
) -> None:
    looker = Looker(robot, math.radians(120.0), 6.0)
    pose: Pose = (x, y, heading)
    step = LookTask(CHART, looker, pose).next_step(pose, Percepts([]))
    assume(step.target is not None)
    assert step.target is not None
    place_x, place_y, turned = step.target
    axle = place_x + robot.axle * math.cos(turned), place_y + robot.axle * math.sin(turned)
    walls = CHART.grid.points(np.argwhere(CHART.solid))
    reach = math.hypot(robot.length / 2 + abs(robot.axle), robot.width / 2)
    assert np.hypot(*(walls - axle).T).min() > reach + 0.2


def test_a_robot_that_something_holds_up_looks_around_to_the_other_side() -> None:
    """It can turn to the left by 100 degrees, and to the right by all the others."""
    looker = Looker(WHEELCHAIR, math.radians(120.0), 6.0)
    x, y, turned, least = 4.8, 2.4, 0.0, 0.0
    task = LookTask(CHART, looker, (x, y, 0.0))
    for _ in range(400):
        step = task.next_step((x, y, turned), Percepts([]))
        turned = min(turned + step.yaw_rate / 15.0, math.radians(100.0))
        least = min(least, turned)
    assert least <= math.radians(100.0) - math.tau
    assert step.yaw_rate == 0.0


def test_a_robot_that_cannot_turn_at_all_stops_trying() -> None:
    pose: Pose = (4.8, 2.4, 0.0)
    task = LookTask(CHART, Looker(WHEELCHAIR, math.radians(120.0), 6.0), pose)
    for _ in range(100):
        step = task.next_step(pose, Percepts([]))
    assert step.target is None
    assert step.yaw_rate == 0.0
