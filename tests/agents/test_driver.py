from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from semnav_agents.planning.doorway import barriers_across, room_behind, target_behind
from semnav_agents.planning.driver import Driver
from semnav_agents.planning.follower import PathProgress, follow
from semnav_agents.planning.guard import GuardedBody, safe_share
from semnav_agents.planning.obstacles import points_of_segments
from semnav_agents.planning.planner import DriveTarget, is_free, plan
from semnav_agents.planning.track import PathTrack
from semnav_agents.planning.yielding import (
    AMONG_PEOPLE_STEPS,
    BACKING_SPEED,
    INSISTING_SHARE,
    INSISTING_STEPS,
    JAM_STEPS,
)
from semnav_env.robots import SPOT, WHEELCHAIR
from semnav_features.frames import points_to_local, to_parent
from semnav_features.scene import Door
from tests.support.kinematics import (
    HALLWAY_STARTS,
    Kinematics,
    around,
    corridor_with_door,
    drive_knowing,
    drive_seeing,
    hallway_task,
    room_with_pillar,
)
from tests.support.raycaster import polyline

ROBOTS = pytest.mark.parametrize("robot", [WHEELCHAIR, SPOT], ids=lambda robot: robot.name)
NOTHING = np.empty((0, 2))


@ROBOTS
@pytest.mark.parametrize("name", HALLWAY_STARTS)
def test_with_everything_known_doors_are_passed_on_the_path(robot, name):
    segments, start, target = hallway_task(name)
    drive = drive_knowing(segments, robot, around(start, np.random.default_rng(1)), target)
    assert drive.arrived
    assert drive.clearance > 0
    assert drive.deviation < 0.06
    assert drive.plans == 1


@pytest.mark.parametrize(
    ("robot", "name"), [(WHEELCHAIR, "north"), (WHEELCHAIR, "south_2"), (SPOT, "south_1")]
)
def test_with_noise_and_drift_doors_are_passed_without_contact(robot, name):
    segments, start, target = hallway_task(name)
    for seed in range(2):
        rng = np.random.default_rng(seed)
        drive = drive_seeing(segments, robot, around(start, rng), target, rng)
        assert drive.arrived
        assert drive.clearance > 0
        assert math.dist(drive.pose[:2], target.pose[:2]) < target.position_tolerance + 0.25


@ROBOTS
def test_a_door_on_the_side_of_a_narrow_corridor_is_entered(robot):
    segments, door = corridor_with_door(1.65, 1.0)
    drive = drive_knowing(segments, robot, (0.0, 0.8, 0.0), target_behind(door, (0.0, 0.8)))
    assert drive.arrived
    assert drive.clearance > 0.03


@ROBOTS
def test_a_pillar_is_passed(robot):
    target = DriveTarget((5.0, 2.2, 0.0))
    drive = drive_knowing(room_with_pillar(), robot, (1.0, 1.9, 0.0), target)
    assert drive.arrived
    assert drive.clearance > 0.05
    assert math.dist(drive.pose[:2], target.pose[:2]) < 0.15


@ROBOTS
def test_an_open_corridor_is_driven_at_cruising_speed(robot):
    walls = np.concatenate((polyline((-2, -1.2), (12, -1.2)), polyline((-2, 1.2), (12, 1.2))))
    drive = drive_knowing(walls, robot, (0.0, 0.0, 0.0), DriveTarget((9.0, 0.0, 0.0)))
    assert drive.arrived
    assert drive.seconds < 13.0


@ROBOTS
@pytest.mark.parametrize("offset", [0.08, -0.08])
def test_a_robot_beside_its_path_comes_back_to_it(robot, offset):
    path = plan(NOTHING, (0.0, 0.0, 0.0), DriveTarget((5.0, 0.0, 0.0)), robot)
    track, progress = PathTrack(path, robot), PathProgress()
    world = Kinematics(np.array([[(99, 99), (99, 98)]]), robot, (0.0, offset, 0.0), rng())
    for _ in range(40):
        steering = follow(track, progress, world.pose, tuple(world.velocity.tolist()))
        progress = steering.progress
        world.step(steering.twist)
    assert abs(world.pose[1]) < 0.015
    assert abs(world.pose[2]) < math.radians(2.0)


def test_a_turn_on_the_spot_stays_on_the_spot():
    path = plan(
        NOTHING, (0.0, 0.0, 0.0), DriveTarget((0.18, 0.18, math.pi / 2), 0.03, 0.05), WHEELCHAIR
    )
    track, progress = PathTrack(path, WHEELCHAIR), PathProgress()
    world = Kinematics(np.array([[(99, 99), (99, 98)]]), WHEELCHAIR, (0.0, 0.0, 0.0), rng())
    for _ in range(120):
        steering = follow(track, progress, world.pose, tuple(world.velocity.tolist()))
        progress = steering.progress
        if steering.done:
            break
        world.step(steering.twist)
    assert steering.done
    assert math.dist(world.pose[:2], path.end[:2]) < 0.03
    assert abs(world.pose[2] - path.end[2]) < 0.03


def test_commands_keep_to_the_limits_of_the_follower():
    segments, start, target = hallway_task("south_1")
    path = plan(points_of_segments(segments.reshape(-1, 4)), start, target, WHEELCHAIR)
    track = PathTrack(path, WHEELCHAIR)
    assert track.speed.max() <= track.settings.cruise
    assert track.speed[-1] == 0.0
    bends = np.abs(track.curvature) * np.minimum(track.speed[1:], track.speed[:-1])
    assert bends.max() <= track.settings.turn_rate + 1e-9


def test_a_wall_that_appears_on_the_path_is_driven_around():
    driver, pose = Driver(WHEELCHAIR), (0.0, 0.0, 0.0)
    target = DriveTarget((5.0, 0.0, 0.0))
    driver.drive(NOTHING, target, pose)
    before = driver.path
    box = points_of_segments(polyline((2.0, -0.3), (2.0, 0.3)).reshape(-1, 4))
    for _ in range(driver.check_every):
        driver.drive(box, target, pose)
    assert driver.path is not before
    assert driver.path.complete
    assert np.abs(driver.path.poses[:, 1]).max() > 0.6


def wall_with_two_gaps():
    """A wall at x = 3 with gaps of 1 m around y = 0 and y = 4, and points across the first one."""
    wall = np.array([[3.0, -30.0, 3.0, -0.5], [3.0, 0.5, 3.0, 3.5], [3.0, 4.5, 3.0, 30.0]])
    across = np.array([[3.0, -0.5, 3.0, 0.5]])
    return points_of_segments(wall), points_of_segments(across)


GATES = {y: ((3.0, y - 0.5), (3.0, y + 0.5)) for y in (0.0, 4.0)}


def test_the_way_to_a_gate_leads_through_that_gate():
    points, barrier = wall_with_two_gaps()
    driver, target = Driver(WHEELCHAIR), DriveTarget((6.0, 0.0, 0.0), 0.2, None, gate=GATES[4.0])
    for barriers in (NOTHING, barrier):
        driver.reset()
        driver.drive(points, target, (0.0, 0.0, 0.0), barriers=barriers)
        assert driver.path.complete
        assert driver.path.crosses(*GATES[4.0])
        assert not driver.path.crosses(*GATES[0.0])
    before = driver.path
    for _ in range(driver.check_every):
        driver.drive(points, target, (0.0, 0.0, 0.0), barriers=barrier)
    assert driver.path is before


def test_barriers_are_passed_as_a_last_way_alone():
    points, barrier = wall_with_two_gaps()
    beyond = ((5.0, -1.0), (5.0, 1.0))
    driver, target = Driver(WHEELCHAIR), DriveTarget((6.0, 0.0, 0.0), 0.2, None, gate=beyond)
    driver.drive(points, target, (0.0, 0.0, 0.0), barriers=barrier)
    assert driver.path.crosses(*GATES[4.0])
    assert not driver.path.crosses(*GATES[0.0])
    assert driver.path.crosses(*beyond)
    closed = np.vstack((points, points_of_segments(np.array([[3.0, 3.5, 3.0, 4.5]]))))
    driver.reset()
    driver.drive(closed, target, (0.0, 0.0, 0.0), barriers=barrier)
    assert driver.path.complete
    assert driver.path.crosses(*GATES[0.0])


HALL_START = (-1.5, 4.35, math.pi)
"""In the hall of the villa, 1.10 m wide, looking west."""


def hall_seen_ahead():
    """What a lidar sees of the hall's walls from `HALL_START`, and what bars the door at its end.

    Nothing is seen behind the robot, nor of the room behind the door on the right.
    """
    seen = [
        (-6.2, 3.9, -6.2, 3.8),
        (-6.2, 3.8, -1.6, 3.8),
        (-1.6, 4.9, -4.35, 4.9),
        (-5.25, 4.9, -6.2, 4.9),
        (-6.2, 4.9, -6.2, 4.8),
    ]
    at_end = points_of_segments(np.array([(-6.2, 4.8, -6.2, 3.9)]))
    return points_of_segments(np.array(seen)), at_end


@ROBOTS
def test_a_door_is_entered_by_itself_and_not_through_what_is_unseen(robot):
    """Neither through the next door, nor through the wall beside, which is not seen behind."""
    points, at_end = hall_seen_ahead()
    door = Door((-4.35, 4.9), (-5.25, 4.9))
    driver = Driver(robot)
    driver.drive(points, target_behind(door, HALL_START[:2]), HALL_START, barriers=at_end)
    assert driver.path.complete
    assert driver.path.crosses(door.start, door.end)
    assert is_free(at_end, driver.path.poses, robot)


def test_a_door_is_entered_where_another_one_was_wrongly_seen_in_the_way():
    points, _ = hall_seen_ahead()
    wrong = points_of_segments(np.array([(-3.4, 3.85, -3.4, 4.85)]))
    door = Door((-4.35, 4.9), (-5.25, 4.9))
    driver = Driver(WHEELCHAIR)
    driver.drive(points, target_behind(door, HALL_START[:2]), HALL_START, barriers=wrong)
    assert driver.path.complete
    assert driver.path.crosses(door.start, door.end)


@ROBOTS
def test_a_long_way_through_the_unseen_is_not_taken_around_another_door(robot):
    """A room that lies behind two doors is reached through both, and not around the building."""
    sides = [(-2.0, y, 3.0, y) for y in (-0.8, 0.8)]
    front = [(3.0, 5.0, 3.0, 0.5), (3.0, -0.5, 3.0, -5.0)]
    points = points_of_segments(np.array([*sides, *front]))
    across = points_of_segments(np.array([(3.0, -0.5, 3.0, 0.5)]))
    door = Door((4.5, 1.5), (5.5, 1.5))
    driver = Driver(robot)
    for behind in (0.0, 1.0, 2.0):
        driver.reset()
        start = (behind, 0.0, 0.0)
        driver.drive(points, target_behind(door, start[:2]), start, barriers=across)
        assert driver.path.complete
        assert driver.path.crosses((3.0, -0.5), (3.0, 0.5))


@given(st.floats(-math.pi, math.pi), st.floats(0.8, 1.2), st.booleans(), st.sampled_from((1, -1)))
def test_the_room_behind_a_door_is_open_at_the_door_alone(heading, width, swapped, side):
    """Its points keep off the gap, lie on the target's side of it, and reach both jambs."""
    frame = (3.0, -2.0, heading)
    jambs = [to_parent(frame, (0.0, 0.0)), to_parent(frame, (width, 0.0))]
    target = (*to_parent(frame, (width / 2, side * 1.3)), 0.0)
    gate = (jambs[1], jambs[0]) if swapped else (jambs[0], jambs[1])
    x, y = points_to_local(frame, room_behind(gate, target)).T
    assert ((x < 1e-9) | (x > width - 1e-9) | (side * y > 2.0)).all()
    assert (side * y > -1e-9).all()
    for jamb in (0.0, width):
        assert np.hypot(x - jamb, y).min() < 1e-9


def test_a_short_detour_leads_around_a_barrier():
    points, barrier = wall_with_two_gaps()
    for y, gate in ((1.5, 4.0), (0.0, 0.0)):
        driver, target = Driver(WHEELCHAIR), DriveTarget((6.0, y, 0.0), 0.2, None)
        driver.drive(points, target, (0.0, y, 0.0), barriers=barrier)
        assert driver.path.complete
        assert driver.path.crosses(*GATES[gate])


@ROBOTS
def test_a_robot_waits_for_what_moves_on_its_path_and_then_plans_around_it(robot):
    person = np.array(
        [(2.0 + 0.25 * math.cos(a), 0.25 * math.sin(a)) for a in np.arange(0, 6, 0.1)]
    )
    driver, target = Driver(robot), DriveTarget((4.0, 0.0, 0.0))
    here = 0.8, 0.0, 0.0
    for _ in range(driver.patience):
        steering = driver.drive(NOTHING, target, here, moving=person)
        assert steering.twist == (0.0, 0.0, 0.0)
        assert driver.plans == 1
    driver.drive(NOTHING, target, here, moving=person)
    driver.drive(NOTHING, target, here, moving=person)
    assert driver.plans == 2
    assert is_free(person, driver.path.poses, robot)


def test_what_moves_is_not_evaded_through_a_barrier():
    points, barrier = wall_with_two_gaps()
    across = points_of_segments(np.array([[3.0, 3.5, 3.0, 4.5]]))
    person = barrier + np.array((0.3, 0.0))
    driver, target = Driver(WHEELCHAIR), DriveTarget((6.0, 0.0, 0.0), 0.2, None)
    for _ in range(3 * driver.patience):
        driver.drive(points, target, (2.3, 0.0, 0.0), barriers=across, moving=person)
        assert is_free(across, driver.path.poses, WHEELCHAIR)


def test_what_moves_is_not_evaded_by_a_long_way():
    """The other gap lies 4 m aside; the path to it is too long to be worth a try."""
    points, barrier = wall_with_two_gaps()
    person = barrier + np.array((0.3, 0.0))
    driver, target = Driver(WHEELCHAIR), DriveTarget((4.5, 0.0, 0.0), 0.2, None)
    for _ in range(JAM_STEPS):
        driver.drive(points, target, (2.3, 0.0, 0.0), moving=person)
        assert not driver.path.crosses(*GATES[4.0])


@ROBOTS
def test_a_robot_backs_off_from_who_does_not_go_away(robot):
    points, barrier = wall_with_two_gaps()
    person = barrier + np.array((0.1, 0.0))
    target, here = DriveTarget((4.5, 0.0, 0.0), 0.2, None), (2.3, 0.0, 0.0)
    behind = np.array([(here[0] - robot.length / 2 - 0.02, 0.0)])
    for standing, moving, expected in (
        (points, person, -BACKING_SPEED),
        (np.vstack((points, behind)), person, 0.0),
        (points, np.vstack((person, behind)), 0.0),
    ):
        driver = Driver(robot)
        told = target, here, (0.0, 0.0, 0.0), NOTHING, moving
        steps = 2 * JAM_STEPS + INSISTING_STEPS + 40
        assert min(driver.drive(standing, *told).forward for _ in range(steps)) == expected


@ROBOTS
def test_a_robot_in_a_jam_creeps_on_before_it_backs_off(robot):
    points, barrier = wall_with_two_gaps()
    person = barrier + np.array((1.5, 0.0))
    target, here = DriveTarget((6.0, 0.0, 0.0), 0.2, None), (2.3, 0.0, 0.0)
    person[:, 0] = here[0] + robot.length / 2 + 0.35
    driver = Driver(robot)
    speeds = [
        driver.drive(points, target, here, moving=person).forward
        for _ in range(JAM_STEPS + INSISTING_STEPS)
    ]
    assert min(speeds) == 0.0
    assert 0.0 < max(speeds) <= INSISTING_SHARE * robot.max_speed


def test_a_robot_among_people_takes_no_door_in_place_of_a_blocked_gate():
    points, barrier = wall_with_two_gaps()
    beyond, elsewhere = ((5.0, -1.0), (5.0, 1.0)), np.array([(-2.0, -2.0)])
    closed = np.vstack((points, points_of_segments(np.array([[3.0, 3.5, 3.0, 4.5]]))))
    target = DriveTarget((6.0, 0.0, 0.0), 0.2, None, gate=beyond)
    told = target, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), barrier
    alone, driver = Driver(WHEELCHAIR), Driver(WHEELCHAIR)
    alone.drive(closed, *told)
    assert alone.path.crosses(*GATES[0.0])
    driver.drive(closed, *told, elsewhere)
    for _ in range(AMONG_PEOPLE_STEPS - 2):
        assert not driver.path.crosses(*GATES[0.0])
        driver.drive(closed, *told)


@ROBOTS
def test_what_moves_beside_the_path_or_away_from_it_stops_nobody(robot):
    target = DriveTarget((4.0, 0.0, 0.0))
    for place in ((2.0, 1.0), (-0.8, 0.0), (0.0, 0.5)):
        steering = Driver(robot).drive(NOTHING, target, (0.0, 0.0, 0.0), moving=np.array([place]))
        assert steering.forward > 0.0


def test_a_robot_that_seeks_waits_before_it_passes_a_barrier():
    points, barrier = wall_with_two_gaps()
    closed = np.vstack((points, points_of_segments(np.array([[3.0, 3.5, 3.0, 4.5]]))))
    driver, target = Driver(WHEELCHAIR), DriveTarget((5.0, 0.0, 0.0), 0.4, None)
    pose, steps = (1.5, 0.0, 0.0), 0
    driver.drive(closed, target, pose, barriers=barrier)
    while not driver.path.crosses(*GATES[0.0]):
        steps, pose = steps + 1, driver.path.end
        driver.drive(closed, target, pose, barriers=barrier)
    assert driver.patience <= steps < 2 * driver.patience


def test_doorways_are_barred_but_for_the_one_the_robot_stands_in():
    beside, here = (2.0, 1.0, 3.0, 1.0), (0.3, -0.5, 0.3, 0.5)
    barriers = barriers_across(np.array([beside, here]), WHEELCHAIR)
    assert np.array_equal(barriers, points_of_segments(np.array([beside])))
    assert barriers_across(np.empty((0, 4)), WHEELCHAIR).shape == (0, 2)


def test_a_moving_target_is_followed_but_not_a_trembling_one():
    driver, pose = Driver(WHEELCHAIR), (0.0, 0.0, 0.0)
    driver.drive(NOTHING, DriveTarget((5.0, 0.0, 0.0)), pose)
    driver.drive(NOTHING, DriveTarget((5.01, 0.01, 0.01)), pose)
    assert driver.plans == 1
    driver.drive(NOTHING, DriveTarget((5.0, 1.0, 0.0)), pose)
    assert driver.plans == 2


def test_a_path_to_a_place_to_look_from_is_planned_anew_once_that_is_the_place_to_stop_at():
    place, here = (0.3, 0.0, math.pi / 2), (0.0, 0.0, 0.0)
    for asked in (DriveTarget(place, 0.4, 0.15), DriveTarget(place, 0.2, None)):
        driver = Driver(WHEELCHAIR)
        driver.drive(NOTHING, asked, here)
        driver.drive(NOTHING, DriveTarget(place, 0.2, 0.15), here)
        assert driver.plans == 2
        assert driver.path.end[2] == pytest.approx(math.pi / 2, abs=0.15)
        driver.drive(NOTHING, DriveTarget(place, 0.4, None), here)
        assert driver.plans == 2


def test_where_no_way_leads_on_the_robot_stands_and_is_not_done():
    driver, wall = Driver(WHEELCHAIR), points_of_segments(np.array([[0.7, -30.0, 0.7, 30.0]]))
    for _ in range(30):
        steering = driver.drive(wall, DriveTarget((3.0, 0.0, 0.0)), (0.0, 0.0, 0.0))
        assert not steering.done
    assert driver.plans < 10


@ROBOTS
def test_a_short_way_that_ends_near_the_target_is_driven(robot):
    """The target lies behind the end of a corridor, half a metre ahead of the robot's front."""
    walls = polyline((-2, -1), (1.2, -1), (1.2, 1), (-2, 1), (-2, -1))
    target = DriveTarget((1.6, 0.0, 0.0), 0.2, 0.15)
    drive = drive_knowing(walls, robot, (0.0, 0.0, 0.0), target, steps=150)
    assert drive.pose[0] > 0.2
    assert drive.clearance > 0.0


def test_a_command_into_a_wall_is_slowed_and_one_along_it_is_not():
    wall = np.stack((np.full(50, 0.72), np.linspace(-1.0, 1.0, 50)), axis=1)
    assert safe_share(wall, (1.0, 0.0, 0.0), (0.0, 0.0, 0.0), GuardedBody.of(WHEELCHAIR)) < 1.0
    assert safe_share(wall, (1.0, 0.0, 0.0), (1.2, 0.0, 0.0), GuardedBody.of(WHEELCHAIR)) == 0.0
    assert safe_share(wall, (-1.0, 0.0, 0.0), (0.0, 0.0, 0.0), GuardedBody.of(WHEELCHAIR)) == 1.0
    assert safe_share(NOTHING, (1.0, 0.0, 0.0), (0.0, 0.0, 0.0), GuardedBody.of(WHEELCHAIR)) == 1.0


def rng():
    return np.random.default_rng(0)
