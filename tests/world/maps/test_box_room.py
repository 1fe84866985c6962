"""A robot has room where exact geometry says so."""

from __future__ import annotations

import math

from hypothesis import given
from hypothesis import strategies as st

from semnav_env.robots import ROBOTS, WHEELCHAIR, RobotSpec
from semnav_env.world.maps import load_floor_plan
from semnav_env.world.maps.box_room import HAS_NO_ROOM, IS_DOUBTFUL, SolidEdges
from semnav_env.world.maps.placement import _problem, has_room
from tests.support.small_plans import empty_hall

NAMES = ("office_cross", "heidelberg_hallway", "office:hard:3")
SHARES = st.floats(-0.05, 1.05)


@given(
    name=st.sampled_from(NAMES),
    robot=st.sampled_from(list(ROBOTS.values())),
    place=st.tuples(SHARES, SHARES),
    heading=st.floats(-math.pi, math.pi) | st.sampled_from((0.0, math.pi / 2)),
    margin=st.sampled_from((0.0, 0.05)),
    rounded=st.booleans(),
)
def test_a_robot_has_room_where_exact_geometry_finds_nothing_wrong(
    name: str,
    robot: RobotSpec,
    place: tuple[float, float],
    heading: float,
    margin: float,
    rounded: bool,
) -> None:
    plan = load_floor_plan(name)
    west, south, east, north = plan.boundary.bounds
    x, y = west + place[0] * (east - west), south + place[1] * (north - south)
    pose = (round(x, 1), round(y, 1), heading) if rounded else (x, y, heading)
    assert has_room(plan, robot, pose, margin) == (_problem(plan, robot, pose, margin) is None)


def test_a_robot_that_all_but_touches_a_wall_is_left_to_exact_geometry() -> None:
    hall, half = empty_hall(), WHEELCHAIR.width / 2
    edges, halves = hall.derived(SolidEdges.of), (WHEELCHAIR.length / 2, half)
    for gap, answer in ((-1e-3, HAS_NO_ROOM), (-1e-9, IS_DOUBTFUL), (1e-9, IS_DOUBTFUL), (1e-3, 0)):
        pose = (5.0, half + gap, 0.0)
        assert edges.room(pose, *halves) == answer
        assert has_room(hall, WHEELCHAIR, pose) == (_problem(hall, WHEELCHAIR, pose, 0.0) is None)
