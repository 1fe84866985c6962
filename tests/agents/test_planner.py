from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from semnav_agents.planning.doorway import target_behind
from semnav_agents.planning.obstacles import points_of_segments
from semnav_agents.planning.path import joined
from semnav_agents.planning.planner import DriveTarget, PlannerSettings, is_free, plan
from semnav_env.robots import SPOT, WHEELCHAIR
from semnav_features.frames import compose, to_local
from semnav_features.scene import Door
from tests.support.kinematics import (
    HALLWAY_STARTS,
    around,
    corridor_with_door,
    hallway_task,
    room_with_pillar,
)
from tests.support.raycaster import polyline

ROBOTS = pytest.mark.parametrize("robot", [WHEELCHAIR, SPOT], ids=lambda robot: robot.name)
NOTHING = np.empty((0, 2))
BETWEEN = 0.01
"""Metres that corners may swing out between two poses that the planner tests."""

headings = st.floats(-math.pi, math.pi)


def points_of(segments):
    return points_of_segments(segments.reshape(-1, 4))


def meets(path, target):
    x, y, heading = path.end
    near = math.dist((x, y), target.pose[:2]) <= target.position_tolerance + 1e-6
    turned = abs(math.remainder(heading - target.pose[2], 2 * math.pi))
    free = target.heading_tolerance is None or turned <= target.heading_tolerance + 1e-6
    return near and free


@given(st.floats(-5.0, 5.0), st.floats(-5.0, 5.0), headings, headings)
@settings(max_examples=30)
def test_without_obstacles_every_pose_is_reached(x, y, heading, start):
    target = DriveTarget((x, y, heading))
    path = plan(NOTHING, (0.0, 0.0, start), target, WHEELCHAIR)
    assert path.complete
    assert meets(path, target)
    assert path.poses[0] == pytest.approx((0.0, 0.0, start))


@ROBOTS
@pytest.mark.parametrize("name", HALLWAY_STARTS)
def test_each_door_of_the_hallway_is_passed_from_all_starts(robot, name):
    segments, start, target = hallway_task(name)
    points = points_of(segments)
    for seed in range(4):
        path = plan(points, around(start, np.random.default_rng(seed)), target, robot)
        assert path.complete
        assert meets(path, target)
        assert is_free(points, path.poses, robot, path.margin - BETWEEN)
        assert path.clearance.min() >= path.margin - BETWEEN


@ROBOTS
@pytest.mark.parametrize(("width", "door"), [(1.65, 1.0), (1.65, 1.2), (2.2, 0.9)])
def test_a_side_door_is_entered_from_a_narrow_corridor(robot, width, door):
    segments, doorway = corridor_with_door(width, door)
    start = (0.0, width / 2, 0.0)
    target = target_behind(doorway, start[:2])
    path = plan(points_of(segments), start, target, robot)
    assert path.complete
    assert path.margin >= 0.06
    assert is_free(points_of(segments), path.poses, robot, path.margin - BETWEEN)


@given(st.floats(0.8, 1.8), st.floats(0.8, 3.2), headings)
@settings(max_examples=20)
def test_a_pillar_is_driven_around(x, y, heading):
    points = points_of(room_with_pillar())
    target = DriveTarget((5.0, 2.0, 0.0))
    path = plan(points, (x, y, heading), target, SPOT)
    if path.clearance[0] > 0:
        assert path.complete
        assert is_free(points, path.poses, SPOT)


def test_room_is_kept_where_there_is_room():
    walls = np.concatenate((polyline((-4, 0), (10, 0)), polyline((-4, 3.0), (10, 3.0))))
    path = plan(points_of(walls), (0.0, 0.6, 0.0), DriveTarget((6.0, 0.6, 0.0)), WHEELCHAIR)
    assert path.clearance[20:-20].min() > 0.2


def test_a_gap_that_is_too_narrow_is_gone_around():
    wall = np.concatenate((polyline((2, -2.0), (2, -0.30)), polyline((2, 0.30), (2, 8.0))))
    path = plan(points_of(wall), (0.0, 0.0, 0.0), DriveTarget((4.0, 0.0, 0.0)), WHEELCHAIR)
    assert path.complete
    assert path.poses[:, 1].min() < -2.0


@ROBOTS
def test_a_gap_five_centimetres_wider_on_each_side_is_taken(robot):
    half = robot.width / 2 + 0.05
    wall = np.concatenate((polyline((2, -9.0), (2, -half)), polyline((2, half), (2, 9.0))))
    path = plan(points_of(wall), (0.0, 0.8, 0.5), DriveTarget((4.0, 0.5, 0.0)), robot)
    assert path.complete
    assert path.margin == 0.03
    assert is_free(points_of(wall), path.poses, robot, path.margin - BETWEEN)


def test_an_unreachable_target_gives_the_nearest_place():
    box = points_of(np.concatenate((polyline((2, -9), (2, 9)), polyline((4, -9), (4, 9)))))
    path = plan(box, (0.0, 0.0, 0.0), DriveTarget((3.0, 0.0, 0.0)), WHEELCHAIR)
    assert not path.complete
    assert 1.0 < path.end[0] < 2.0 - WHEELCHAIR.width / 2
    assert is_free(box, path.poses, WHEELCHAIR)


def test_a_target_outside_the_window_is_approached():
    wanted = PlannerSettings(half_window=5.0, widest=5.0)
    path = plan(NOTHING, (0.0, 0.0, 0.0), DriveTarget((30.0, 0.0, 0.0)), WHEELCHAIR, wanted)
    assert not path.complete
    assert path.end[0] > 4.0


@ROBOTS
def test_round_the_corner_of_a_long_hallway_is_not_too_far(robot):
    outer, inner = [(-2, -1), (46, -1), (46, 12)], [(-2, 1), (44, 1), (44, 12)]
    walls = points_of(np.concatenate((polyline(*outer), polyline(*inner))))
    target = DriveTarget((45.0, 8.0, math.pi / 2), 0.2, 0.15)
    path = plan(walls, (0.0, 0.0, 0.0), target, robot)
    assert path.complete
    assert meets(path, target)


@pytest.mark.parametrize("gap", [0.02, 0.01, 0.0])
def test_a_robot_that_touches_a_wall_finds_a_way_out(gap):
    wall = points_of(polyline((-5.0, 0.0), (8.0, 0.0)))
    start = (0.0, WHEELCHAIR.width / 2 + gap, 0.0)
    target = DriveTarget((4.0, 1.5, 0.0))
    path = plan(wall, start, target, WHEELCHAIR)
    assert path.complete
    assert path.clearance[-30:].min() > 0.06
    assert path.clearance.min() > gap - 0.02


def test_points_inside_the_robot_are_taken_for_noise():
    path = plan([(0.1, 0.05)], (0.0, 0.0, 0.0), DriveTarget((2.0, 0.0, 0.0)), WHEELCHAIR)
    assert path.complete
    assert path.length == pytest.approx(2.0, abs=0.15)


def test_points_that_are_not_finite_are_left_out():
    points = np.array([(np.nan, 0.0), (1.0, np.inf)])
    assert plan(points, (0.0, 0.0, 0.0), DriveTarget((2.0, 0.0, 0.0)), WHEELCHAIR).complete
    assert is_free(points, np.zeros((1, 3)), WHEELCHAIR)


def test_the_same_question_has_the_same_answer():
    segments, start, target = hallway_task("south_2")
    paths = [plan(points_of(segments), start, target, WHEELCHAIR) for _ in range(2)]
    assert np.array_equal(paths[0].moves, paths[1].moves)


@given(st.floats(-20.0, 20.0), st.floats(-20.0, 20.0))
@settings(max_examples=10)
def test_moving_the_world_does_not_lose_the_way(x, y):
    segments, start, target = hallway_task("south_1")
    frame = (x, y, 0.0)
    moved_target = DriveTarget(compose(frame, target.pose), 0.5, None)
    points = points_of(segments) + np.array((x, y))
    assert plan(points, compose(frame, start), moved_target, WHEELCHAIR).complete


def test_a_path_is_the_sum_of_its_parts():
    segments, start, target = hallway_task("south_1")
    path = plan(points_of(segments), start, target, WHEELCHAIR)
    first = path.part(0, 20, (0.0, 0.0, 0.0))
    again = joined(first, path.part(20, len(path.poses) - 1, (0.0, 0.0, 0.0)))
    assert first.end == pytest.approx(path.poses[20], abs=1e-9)
    assert again.poses == pytest.approx(path.poses, abs=1e-9)
    assert len(again.clearance) == len(again.poses)


def test_bad_questions_are_named():
    here, there = (0.0, 0.0, 0.0), DriveTarget((1.0, 0.0, 0.0))
    with pytest.raises(ValueError, match="three finite numbers"):
        plan(NOTHING, (0.0, math.nan, 0.0), there, WHEELCHAIR)
    with pytest.raises(ValueError, match="target is"):
        plan(NOTHING, here, DriveTarget((math.inf, 0.0, 0.0)), WHEELCHAIR)
    with pytest.raises(ValueError, match=r"shape \(N, 2\)"):
        plan(np.ones((3, 3)), here, there, WHEELCHAIR)
    with pytest.raises(ValueError, match="margins"):
        plan(NOTHING, here, there, WHEELCHAIR, PlannerSettings(margins=()))


@given(headings, st.floats(0.8, 1.2), st.booleans())
def test_the_target_behind_a_door_lies_on_its_axis(heading, width, swapped):
    jambs = [compose((1.0, 2.0, heading), (0.0, side * width / 2, 0.0))[:2] for side in (1, -1)]
    door = Door(*(jambs[::-1] if swapped else jambs))
    approach = compose((1.0, 2.0, heading), (-2.0, 0.7, 0.0))[:2]
    pose = target_behind(door, approach).pose
    assert to_local((1.0, 2.0, heading), pose[:2]) == pytest.approx((1.3, 0.0), abs=1e-9)
    assert math.cos(pose[2] - heading) == pytest.approx(1.0)


def test_a_door_without_width_is_refused():
    with pytest.raises(ValueError, match="no width"):
        target_behind(Door((1.0, 1.0), (1.0, 1.0)), (0.0, 0.0))
