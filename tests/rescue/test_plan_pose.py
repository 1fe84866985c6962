"""A robot that knows the walls of a house corrects its odometry by those that it sees."""

from __future__ import annotations

import math

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from semnav_agents.searching.house_plan import HousePlan
from semnav_agents.searching.plan_pose import PlanPose, fitted_to_walls
from semnav_env.robots import SPOT
from semnav_env.world.lidar import Lidar
from semnav_env.world.maps import load_floor_plan
from semnav_features.frames import Pose, compose, relative

VILLA = load_floor_plan("villa_hall")
LIDAR = Lidar(VILLA, mount=SPOT.lidar_mount)
START: Pose = (4.8, 2.4, 0.3)
WALLS = HousePlan(VILLA, START).walls
DRIFT: Pose = (0.02, 0.02, math.radians(0.5))


def ranges_at(pose: Pose, number: int = 0) -> np.ndarray:
    """A scan with its noise from a pose in the world."""
    return np.asarray(LIDAR.scan(pose, (7, number, 0)).ranges, np.float64)


def hits_at(pose: Pose) -> np.ndarray:
    """Hits of a scan, robot frame; SPOT's lidar looks along the body."""
    ranges = ranges_at(pose)
    x, y, _ = SPOT.lidar_mount
    near = (ranges > 0.0) & (ranges < 6.0)
    return (ranges[:, None] * LIDAR.spec.directions)[near] + (x, y)


@given(st.floats(-0.05, 0.05), st.floats(-0.05, 0.05), st.floats(-0.02, 0.02))
def test_walls_tell_a_pose_that_is_off_by_little(dx: float, dy: float, turn: float) -> None:
    """Within twice the noise, in a few corrections."""
    hits, pose = hits_at(START), (dx, dy, turn)
    for _ in range(10):
        pose = fitted_to_walls(pose, hits, WALLS, DRIFT)
    assert math.hypot(*pose[:2]) < 0.02
    assert abs(pose[2]) < math.radians(0.3)


def test_without_walls_the_belief_stays() -> None:
    pose = (0.3, -0.2, 0.1)
    assert fitted_to_walls(pose, hits_at(START), np.empty((0, 4)), DRIFT) == pose
    assert fitted_to_walls(pose, np.empty((0, 2)), WALLS, DRIFT) == pose


def test_a_heading_that_drifts_by_five_degrees_is_held_to_one() -> None:
    """The robot goes round the living room; its odometry turns by 0.05 degrees in each step."""
    place, drifted = PlanPose(WALLS, SPOT.lidar_mount, LIDAR.spec.directions), (0.0, 0.0, 0.0)
    true: Pose = START
    for number in range(100):
        place.update(drifted, ranges_at(true, number))
        step = (0.02, 0.0, 0.06)
        true = compose(true, step)
        drifted = compose(drifted, (0.02, 0.0, 0.06 + math.radians(0.05)))
    error = relative(relative(START, true), drifted)
    assert abs(math.degrees(error[2])) > 4.0
    found = place.update(drifted, ranges_at(true, 100))
    off = relative(relative(START, true), found)
    assert abs(math.degrees(off[2])) < 1.0
    assert math.hypot(*off[:2]) < 0.05


def test_furniture_before_a_wall_does_not_draw_a_robot_away_that_stands() -> None:
    """Every hit is 6 cm short of its wall, for as long as a robot may stand."""
    place = PlanPose(WALLS, SPOT.lidar_mount, LIDAR.spec.directions)
    ranges = ranges_at(START) - 0.06
    for _ in range(300):
        found = place.update((0.0, 0.0, 0.0), ranges)
    assert math.hypot(*found[:2]) < 0.01
    assert abs(found[2]) < math.radians(0.3)
