from __future__ import annotations

import math

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from semnav_agents.planning.collision import footprint_of, is_clear, obstacle_field
from semnav_agents.planning.free import all_clear, clearances
from semnav_agents.planning.nudge import best_nudge, path_clearance
from semnav_env.robots import ROBOTS
from semnav_features.frames import compose
from tests.support.kinematics import footprint

coordinates = st.floats(-2.0, 2.0)
clouds = arrays(np.float64, st.tuples(st.integers(0, 40), st.just(2)), elements=coordinates)
poses = st.tuples(st.floats(-1.0, 1.0), st.floats(-1.0, 1.0), st.floats(-7.0, 7.0))
robots = st.sampled_from(sorted(ROBOTS.values(), key=lambda spec: spec.name))
EDGE = 1e-9


def depth_outside(robot, pose, points):
    """How far each point lies outside the footprint by the larger of both axes; < 0 inside."""
    x, y, heading = pose
    dx, dy = points[:, 0] - x, points[:, 1] - y
    ahead = np.abs(math.cos(heading) * dx + math.sin(heading) * dy) - robot.length / 2
    aside = np.abs(math.cos(heading) * dy - math.sin(heading) * dx) - robot.width / 2
    return np.maximum(ahead, aside)


@given(clouds, poses, robots)
@settings(max_examples=200)
def test_clear_poses_are_those_that_shapely_finds_clear(points, pose, robot):
    body = footprint(robot, pose)
    distance = shapely.distance(shapely.points(points), body.boundary) if len(points) else []
    if np.any(np.asarray(distance) < EDGE):
        return
    inside = any(body.contains(shapely.Point(p)) for p in points)
    field = obstacle_field(points, (0.0, 0.0), 4.0)
    axle = compose(pose, (robot.axle, 0.0, 0.0))
    assert is_clear(field, footprint_of(robot), *axle, 0.0) is not inside
    assert all_clear(points, np.array([pose]), robot.length, robot.width, 0.0) is not inside


@given(clouds, poses, robots, st.floats(0.0, 0.3))
@settings(max_examples=200)
def test_clearance_says_up_to_which_margin_a_pose_is_clear(points, pose, robot, margin):
    outside = depth_outside(robot, pose, points)
    if np.any(np.abs(outside - margin) < EDGE):
        return
    field, body = obstacle_field(points, (0.0, 0.0), 4.0), footprint_of(robot)
    axle = compose(pose, (robot.axle, 0.0, 0.0))
    expected = min(outside.min(initial=math.inf), 0.35)
    clearance = clearances(field, body, np.array([axle]), 0.35)[0]
    assert clearance == pytest.approx(expected, abs=1e-9)
    assert is_clear(field, body, *axle, margin) is bool(outside.min(initial=math.inf) >= margin)


@given(clouds, poses, robots)
def test_the_order_of_the_points_does_not_matter(points, pose, robot):
    axle = compose(pose, (robot.axle, 0.0, 0.0))
    answers = {
        is_clear(obstacle_field(cloud, (0.1, -0.2), 4.0), footprint_of(robot), *axle, 0.05)
        for cloud in (points, points[::-1].copy())
    }
    assert len(answers) == 1


def test_points_outside_the_window_are_left_out():
    field = obstacle_field(np.array([[100.0, 0.0], [0.0, 0.0]]), (0.0, 0.0), 2.0)
    assert field.points.tolist() == [[0.0, 0.0]]


@given(st.floats(-0.018, 0.018), robots)
def test_a_nudge_centres_a_path_that_drift_has_pushed_aside(offset, robot):
    along = np.arange(0.0, 2.0, 0.03)
    side = robot.width / 2 + 0.05
    rows = [np.stack((along, np.full_like(along, y + offset)), axis=1) for y in (side, -side)]
    points = np.concatenate(rows)
    path = np.array([(x, 0.0, 0.0) for x in np.arange(0.0, 1.2, 0.1)])
    size = (robot.length, robot.width)
    before = path_clearance(points, path, *size, 0.0, 0.0, -math.inf)
    left, turn, after = best_nudge(points, path, *size, 0.05)
    assert after >= before
    assert after > 0.04
    assert path_clearance(points, path, *size, left, turn, -math.inf) == pytest.approx(after)


def test_a_path_with_room_is_not_nudged():
    path = np.array([(0.0, 0.0, 0.0), (1.0, 0.0, 0.0)])
    assert best_nudge(np.array([[0.5, 0.6]]), path, 1.1, 0.65, 0.06)[:2] == (0.0, 0.0)
