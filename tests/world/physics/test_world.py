from __future__ import annotations

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from shapely import LineString, Polygon

from semnav_env.robots import ROBOTS, SPOT, WHEELCHAIR, RobotSpec
from semnav_env.world.physics import GRAVITY, GRIP, World
from semnav_features.frames import Point, Pose, to_parent, wrap_angle
from tests.support.driving import at_the_wall, random_commands
from tests.support.small_plans import empty_hall, furnished_hall, plan_of

HZ = 15
MIDDLE: Pose = (20.0, 15.0, 0.4)
FAST = replace(
    WHEELCHAIR,
    **{"name": "fast", "length": 0.5, "width": 0.3, "mass": 3.5, "axle": -0.15},
    **{"max_speed": 7.0, "max_acceleration": 9.0, "lidar_mount": (0.1, 0.0, 0.0)},
)
TINY = replace(
    FAST, name="tiny", length=0.2, width=0.2, axle=0.0, max_speed=1.5, lidar_mount=(0.0, 0.0, 0.0)
)
robots = pytest.mark.parametrize("robot", ROBOTS.values(), ids=lambda robot: robot.name)


def wide_world(robot: RobotSpec = WHEELCHAIR, pose: Pose = MIDDLE) -> World:
    world = World(empty_hall(40.0, 30.0), robot)
    world.reset(pose)
    return world


def axle_of(world: World) -> Point:
    return to_parent(world.pose, (world.robot.axle, 0.0))


@robots
def test_a_straight_drive_respects_the_acceleration_limit(robot: RobotSpec) -> None:
    world, speeds = wide_world(robot, (5.0, 15.0, 0.0)), [0.0]
    for _ in range(3 * HZ):
        world.step((9.0, 0.0, 0.0))
        speeds.append(world.velocity[0])
    assert speeds[-1] == pytest.approx(robot.max_speed)
    assert np.diff(speeds).max() <= robot.max_acceleration / HZ + 1e-9
    assert world.pose[1:] == pytest.approx((15.0, 0.0), abs=1e-9)
    way = sum(way_of_a_period(before, after) for before, after in pairwise(speeds))
    assert world.pose[0] == pytest.approx(5.0 + way)


def way_of_a_period(before: float, after: float, substeps: int = 4) -> float:
    """Each substep moves with the speed it finds, then changes it as far as the grip allows."""
    dt, way, speed = 1.0 / HZ / substeps, 0.0, before
    for _ in range(substeps):
        way += speed * dt
        speed += min(max(after - speed, -GRIP * GRAVITY * dt), GRIP * GRAVITY * dt)
    return way


@robots
def test_turning_is_about_the_axle_and_bounded(robot: RobotSpec) -> None:
    world, rates = wide_world(robot), [0.0]
    axle = axle_of(world)
    for _ in range(4 * HZ):
        world.step((0.0, 0.0, 9.0))
        rates.append(world.velocity[2])
    assert rates[-1] == pytest.approx(robot.max_turn_rate)
    assert np.diff(rates).max() <= robot.max_turn_acceleration / HZ + 1e-9
    assert axle_of(world) == pytest.approx(axle, abs=1e-9)


def test_a_differential_drive_never_moves_sideways_at_its_axle() -> None:
    world = wide_world()
    for command in random_commands(1, 300):
        before, heading = axle_of(world), world.pose[2]
        world.step(command)
        _, left, turn = world.velocity
        assert left + WHEELCHAIR.axle * turn == pytest.approx(0.0, abs=1e-9)
        after, middle = axle_of(world), heading + 0.5 * wrap_angle(world.pose[2] - heading)
        dx, dy = after[0] - before[0], after[1] - before[1]
        assert abs(dy * math.cos(middle) - dx * math.sin(middle)) < 2e-4
    assert not world.in_contact


def test_a_steady_curve_is_a_circle_of_speed_over_turn_rate() -> None:
    world, axles = wide_world(), []
    for step in range(12 * HZ):
        world.step((1.0, 0.0, 0.5))
        if step > 2 * HZ:
            axles.append(axle_of(world))
    points = np.array(axles)
    system = np.column_stack((2 * points, np.ones(len(points))))
    x, y, rest = np.linalg.lstsq(system, (points**2).sum(axis=1), rcond=None)[0]
    assert math.sqrt(rest + x * x + y * y) == pytest.approx(2.0, rel=1e-4)
    assert np.hypot(*(points - (x, y)).T) == pytest.approx(2.0, rel=1e-4)


def test_the_velocity_is_that_of_the_centre() -> None:
    world = wide_world()
    for _ in range(3 * HZ):
        before = world.pose
        world.step((1.0, 0.0, 0.5))
    forward, left, turn = world.velocity
    assert (forward, turn) == (pytest.approx(1.0), pytest.approx(0.5))
    assert left == pytest.approx(-WHEELCHAIR.axle * 0.5)
    assert math.dist(before[:2], world.pose[:2]) * HZ == pytest.approx(
        math.hypot(forward, left), rel=1e-3
    )


def test_spot_moves_sideways_and_the_wheelchair_does_not() -> None:
    spot, wheelchair = wide_world(SPOT, (20, 15, 0)), wide_world(WHEELCHAIR, (20, 15, 0))
    for world in (spot, wheelchair):
        for _ in range(2 * HZ):
            world.step((0.0, 9.0, 0.0))
    assert spot.velocity == pytest.approx((0.0, SPOT.max_sideways_speed, 0.0))
    assert spot.pose[1] > 15.7
    assert wheelchair.pose == pytest.approx((20.0, 15.0, 0.0))


@robots
def test_no_robot_gets_into_or_through_anything_solid(robot: RobotSpec) -> None:
    world, touched = World(furnished_hall(), robot), 0
    world.reset((3.0, 2.0, 0.5))
    for command in random_commands(5, 2000):
        before = world.pose
        world.step(command)
        touched += world.in_contact
        way = LineString((before[:2], world.pose[:2]))
        assert not any(way.crosses(LineString(row)) for row in _segments(world))
        core = _shrunken_footprint(world, 0.04)
        assert not any(core.intersects(LineString(row)) for row in _segments(world))
    assert touched > 100


@pytest.mark.parametrize(
    ("robot", "rate"),
    [*((WHEELCHAIR, rate) for rate in (5.0, 1.0, 0.5, 0.1)), (FAST, 5.0), (FAST, 1.0), (TINY, 2.0)],
)
def test_no_wall_lets_a_robot_through_at_a_low_control_rate(robot: RobotSpec, rate: float) -> None:
    world = World(empty_hall(40.0, 30.0), robot, control_hz=rate)
    for n in range(10):
        world.reset((36.0 + 0.1 * n, 15.0, 0.3))
        for _ in range(max(2, int(4 * rate))):
            world.step((robot.max_speed, 0.0, 0.0))
            assert world.in_contact or world.fits(world.pose)
        assert world.pose[0] < 40.0


@robots
def test_grip_bounds_accelerations_whatever_the_limits_say(robot: RobotSpec) -> None:
    eager = replace(robot, max_speed=10.0, max_turn_rate=20.0)
    eager = replace(eager, max_acceleration=100.0, max_turn_acceleration=200.0)
    body = eager.length**2 + eager.width**2 + 12.0 * eager.axle**2
    most = (GRIP * GRAVITY, 6.0 * GRIP * GRAVITY * eager.width / body)
    for command, part, limit in (((9.0, 0.0, 0.0), 0, most[0]), ((0.0, 0.0, 19.0), 2, most[1])):
        world = wide_world(eager)
        for _ in range(4):
            world.step(command)
        assert world.velocity[part] * HZ / 4 == pytest.approx(limit, rel=0.01)


def test_usual_robots_at_usual_rates_keep_their_substeps() -> None:
    for robot in ROBOTS.values():
        for rate in (10.0, 15.0, 40.0):
            assert World(plan_of(), robot, control_hz=rate).substeps == 4


def _segments(world: World) -> list[list[Point]]:
    return [[(a, b), (c, d)] for a, b, c, d in world.floor_plan.segments.tolist()]


def _shrunken_footprint(world: World, margin: float) -> Polygon:
    x, y = world.robot.length / 2 - margin, world.robot.width / 2 - margin
    corners = [(-x, -y), (x, -y), (x, y), (-x, y)]
    return Polygon([to_parent(world.pose, corner) for corner in corners])


@robots
def test_a_wall_stops_the_robot_which_feels_it(robot: RobotSpec) -> None:
    world = World(empty_hall(10.0, 6.0), robot)
    world.reset((8.0, 3.0, 0.0))
    world.step((1.0, 0.0, 0.0))
    assert not world.in_contact
    assert (world.contacts.count, world.contacts.impulse) == (0, 0.0)
    for _ in range(60):
        world.step((1.0, 0.0, 0.0))
    assert world.in_contact
    assert world.contacts.impulse > 0.0
    assert world.velocity == pytest.approx((0.0, 0.0, 0.0), abs=1e-3)
    assert world.pose[0] == pytest.approx(10.0 - robot.length / 2, abs=0.003)
    assert world.clearance() == 0.0
    for _ in range(30):
        world.step((-1.0, 0.0, 0.0))
    assert not world.in_contact
    assert world.clearance() > 0.5


def test_glass_stops_the_robot() -> None:
    world = World(furnished_hall(), WHEELCHAIR)
    world.reset((7.0, 1.0, 0.0))
    for _ in range(60):
        world.step((1.0, 0.0, 0.0))
    assert world.in_contact
    assert world.pose[0] == pytest.approx(9.0 - WHEELCHAIR.length / 2, abs=0.003)


def test_a_robot_that_leaves_a_wall_starts_from_its_true_speed() -> None:
    world = at_the_wall()
    world.step((-1.0, 0.0, 0.0))
    assert -WHEELCHAIR.max_acceleration / HZ - 1e-6 <= world.velocity[0] <= 0.0


def test_clearance_is_the_distance_to_the_nearest_segment() -> None:
    world = World(empty_hall(10.0, 6.0), WHEELCHAIR)
    world.reset((5.0, 2.0, 0.0))
    assert world.clearance() == pytest.approx(2.0 - WHEELCHAIR.width / 2)
    world.reset((9.0, 3.0, math.pi / 2))
    assert world.clearance() == pytest.approx(1.0 - WHEELCHAIR.width / 2)


def test_a_robot_fits_where_it_touches_nothing_and_not_outside() -> None:
    world = World(furnished_hall(), WHEELCHAIR)
    assert world.fits((3.0, 2.0, 0.5))
    assert not world.fits((0.5, 2.0, 0.0))
    assert not world.fits((5.2, 2.3, 0.0)), "the pillar is inside the footprint"
    assert not world.fits((30.0, 2.0, 0.0))


@pytest.mark.parametrize(
    ("pose", "message"),
    [
        ((0.56, 2.0, 0.3), "reaches over the boundary of small"),
        ((30.0, 2.0, 0.0), "is outside small"),
        ((5.2, 2.3, 0.0), "a wheelchair at .5.2, 2.3, 0. overlaps"),
        ((math.nan, 2.0, 0.0), "pose is .*nan.* must be three finite numbers"),
        ((1.0, 2.0), "pose is .* must be three finite numbers"),
        ("here", "pose is 'here'; it must be three finite numbers"),
    ],
)
def test_a_start_pose_that_is_not_free_is_refused(pose: Pose, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        World(furnished_hall(), WHEELCHAIR).reset(pose)


@pytest.mark.parametrize(
    "command", [(math.nan, 0, 0), (0, math.inf, 0), (0, 0, -math.inf), (1.0, 2.0), None, "abc"]
)
def test_a_command_that_is_not_finite_leaves_the_world_as_it_was(command: Pose) -> None:
    world, untouched = wide_world(), wide_world()
    with pytest.raises(ValueError, match=r"velocity is .*; it must be"):
        world.step(command)
    for each in (world, untouched):
        each.step((1.0, 0.0, 0.2))
    assert world.pose == untouched.pose


def test_huge_commands_are_cut_to_the_robots_limits() -> None:
    huge, full = wide_world(SPOT), wide_world(SPOT)
    for _ in range(20):
        huge.step((1e308, -1e308, 1e308))
        full.step((SPOT.max_speed, -SPOT.max_sideways_speed, SPOT.max_turn_rate))
    assert huge.pose == full.pose


def test_a_world_must_be_reset_before_it_is_used() -> None:
    world = World(empty_hall(), WHEELCHAIR)
    with pytest.raises(RuntimeError, match="reset"):
        world.step((0.0, 0.0, 0.0))
    with pytest.raises(RuntimeError, match="reset"):
        assert world.pose
    with pytest.raises(ValueError, match="must be positive"):
        World(empty_hall(), WHEELCHAIR, substeps=0)


def test_an_empty_plan_has_unbounded_clearance() -> None:
    world = World(plan_of(), WHEELCHAIR)
    world.reset((0.0, 0.0, 0.0))
    world.step((1.0, 0.0, 0.0))
    assert world.clearance() == math.inf
