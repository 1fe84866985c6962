"""Poses before doors: what holds for every door, body and obstacle."""

import math

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from semnav_env.approach import (
    ApproachSettings,
    DoorSide,
    Surroundings,
    plan_approach,
)
from semnav_env.approach.in_plan import side_towards
from semnav_env.approach.poses import body_at
from semnav_env.robots import ROBOTS, SPOT, WHEELCHAIR, RobotSpec
from semnav_env.world.maps import load_floor_plan
from semnav_env.world.simulator import RobotSetup, Simulator
from semnav_features import Scan, extract
from semnav_features.frames import Pose, compose, points_to_parent
from semnav_features.scene import Door

VILLA = load_floor_plan("villa_hall")
AROUND = Surroundings.of_plan(VILLA)
EXACT = ApproachSettings(rounding=0.0)
"""Settings without what depends on the frame."""

ROOM = np.array([(-3.0, 0, 3, 0), (3, 0, 3, -5), (3, -5, -3, -5), (-3, -5, -3, 0)], dtype=float)
DOOR = DoorSide((0.45, 0.0), (-0.45, 0.0))
places = st.floats(-20.0, 20.0)
angles = st.floats(-math.pi, math.pi)


def empty_room(*obstacles: shapely.Polygon) -> Surroundings:
    """A room of 6 m by 5 m below a wall along the x axis, with a door in its middle."""
    walls = np.array([(-3.0, 0, -0.45, 0), (0.45, 0, 3, 0), *ROOM[1:]])
    return Surroundings(walls, np.empty((0, 4))).with_obstacles(*obstacles)


def test_the_settings_of_spot_are_those_of_the_thesis() -> None:
    found, hers = ApproachSettings.for_robot(SPOT), ApproachSettings()
    for name in ApproachSettings.__slots__:
        assert getattr(found, name) == pytest.approx(getattr(hers, name))


@pytest.mark.parametrize("robot", ROBOTS.values(), ids=str)
def test_before_a_free_square_one_stands_straight(robot: RobotSpec) -> None:
    plan = plan_approach(DOOR, empty_room(), robot)
    assert plan.square_is_free
    assert plan.best == pytest.approx((0.0, -1.0, math.pi / 2))
    assert plan.clear_count == len(plan.ranked) == 25


@settings(max_examples=20)
@given(places, places, angles)
def test_poses_move_with_the_door(x: float, y: float, angle: float) -> None:
    frame = (x, y, angle)
    around = empty_room(shapely.box(0.3, -1.2, 0.8, -0.7))
    walls = points_to_parent(frame, around.walls.reshape(-1, 2)).reshape(-1, 4)
    box = shapely.Polygon(
        points_to_parent(frame, np.array([(0.3, -1.2), (0.8, -1.2), (0.8, -0.7), (0.3, -0.7)]))
    )
    ends = points_to_parent(frame, np.array([DOOR.right, DOOR.left])).tolist()
    here = plan_approach(DOOR, around, settings=EXACT)
    there = plan_approach(
        DoorSide(*map(tuple, ends)), Surroundings(walls, np.empty((0, 4)), box), settings=EXACT
    )
    assert len(here.safe) == len(there.safe) > 0
    for a, b in zip(here.safe, there.safe, strict=True):
        assert a.key == pytest.approx(b.key, abs=2e-5)
    assert {_near(compose(frame, each.pose)) for each in here.safe} == {
        _near(each.pose) for each in there.safe
    }


@pytest.mark.parametrize("turn", [0.0, math.pi / 2, math.pi, -math.pi / 2])
def test_the_best_pose_does_not_depend_on_how_the_map_is_turned(turn: float) -> None:
    """A bin in the door leaves two headings beside it: that towards the door is the better."""
    frame = (0.0, 0.0, turn)
    corners = [(-0.5, 1), (-4, 1), (-4, -1.5), (4, -1.5), (4, 1), (0.5, 1)]
    placed = points_to_parent(frame, np.array(corners, dtype=float))
    walls = np.hstack((placed[:-1], placed[1:]))
    ends = points_to_parent(frame, np.array([(0.5, 1.0), (-0.5, 1.0)])).tolist()
    side = DoorSide(*map(tuple, ends))
    [middle] = points_to_parent(frame, np.array([(-0.02, 0.17)]))
    around = Surroundings(walls, np.empty((0, 4)))
    best = plan_approach(side, around.with_obstacles(shapely.Point(middle).buffer(0.24))).best
    assert best is not None
    to_door = math.atan2(side.middle[1] - best[1], side.middle[0] - best[0])
    assert abs(math.remainder(best[2] - to_door, math.tau)) < math.radians(31.0)


def _near(pose: Pose) -> tuple[int, ...]:
    x, y, heading = pose
    return tuple(round(50 * value) for value in (x, y, math.cos(heading)))


@settings(max_examples=20)
@given(st.lists(st.tuples(st.floats(-1.5, 1.5), st.floats(-2.0, -0.2)), max_size=4))
def test_no_usable_pose_touches_an_obstacle(centres: list[tuple[float, float]]) -> None:
    boxes = [shapely.box(x - 0.15, y - 0.15, x + 0.15, y + 0.15) for x, y in centres]
    around = empty_room(*boxes)
    walls = [shapely.LineString(row.reshape(2, 2)) for row in around.walls]
    solid = shapely.union_all([*boxes, *walls])
    for robot in ROBOTS.values():
        for pose in plan_approach(DOOR, around, robot).usable:
            assert not body_at(pose, robot).intersects(solid)


def test_a_bin_before_the_door_moves_the_best_pose_aside() -> None:
    bin_ = shapely.Point(0.0, -1.0).buffer(0.15)
    plan = plan_approach(DOOR, empty_room(bin_))
    assert not plan.square_is_free
    assert plan.best is not None
    assert abs(plan.best[0]) > 0.1
    assert not body_at(plan.best, SPOT).intersects(bin_)


def test_every_pose_that_is_refused_says_why() -> None:
    side = side_towards(VILLA, VILLA.door("living"))
    plan = plan_approach(side, AROUND)
    reasons = [each.refusal for each in plan.ranked if not each.is_safe]
    assert len(reasons) == len(plan.ranked) - len(plan.safe)
    assert all(reasons)
    kinds = ("it lies outside", "from the nearest wall; 0.30 m are needed", "walls cut")
    assert all(any(kind in why for why in reasons) for kind in kinds)


def test_of_equally_good_poses_the_nearer_is_first() -> None:
    side = side_towards(VILLA, VILLA.door("daughter"))
    for start in ((-3.0, 4.35, 0.0), (-5.6, 4.35, 0.0)):
        first, second = plan_approach(side, AROUND, start=start).safe[:2]
        assert first.key[:2] == second.key[:2]
        assert first.distance < second.distance


def test_the_side_is_that_of_the_start() -> None:
    door = VILLA.door("kitchen")
    assert side_towards(VILLA, door, (0.5, 2.0)).middle[1] == 0.0
    assert side_towards(VILLA, door, (0.5, 2.0)) == side_towards(VILLA, door)
    assert side_towards(VILLA, door, (0.5, -2.0)) == side_towards(VILLA, door).opposite


def test_a_perceived_scene_gives_the_pose_of_the_plan() -> None:
    """From one scan of the hall; walls that are not seen bound nothing."""
    here = (-4.0, 4.35, math.pi)
    simulator = Simulator(VILLA, RobotSetup(SPOT, exact=True))
    ranges = simulator.reset(here, np.random.default_rng(0)).ranges
    lidar = simulator.setup.lidar
    scan = Scan(ranges, lidar.angle_min, lidar.angle_increment, range_max=lidar.range_max)
    scene = extract(scan).placed(compose(here, SPOT.lidar_mount))
    wanted = plan_approach(side_towards(VILLA, VILLA.door("parents")), AROUND).best
    [door] = [each for each in scene.doors if math.dist(each.midpoint, (-6.2, 4.35)) < 0.2]
    side = DoorSide.seen_from(door, here[:2])
    found = plan_approach(side, Surroundings.of_scene(scene), settings=EXACT).best
    assert wanted is not None
    assert found is not None
    assert found[:2] == pytest.approx(wanted[:2], abs=0.05)
    assert abs(math.remainder(found[2] - wanted[2], math.tau)) < 0.05


def test_points_of_a_scan_count_and_bad_ones_do_not() -> None:
    points = np.array([(0.0, -0.9), (math.nan, 0.0), (math.inf, 1.0)])
    plan = plan_approach(DOOR, empty_room().with_points(points))
    assert not plan.square_is_free
    assert not plan.straight_clear


def test_without_walls_every_pose_is_safe() -> None:
    nothing = Surroundings(np.empty((0, 4)), np.empty((0, 4))).with_points(np.empty((0, 2)))
    assert len(plan_approach(DOOR, nothing).safe) == 25


def test_a_door_narrower_than_the_body_is_refused() -> None:
    narrow = DoorSide((0.3, 0.0), (-0.3, 0.0))
    with pytest.raises(ValueError, match=r"the door is 0\.60 m wide; a wheelchair, 0\.65 m wide"):
        plan_approach(narrow, empty_room(), WHEELCHAIR)


def test_bad_doors_starts_and_settings_are_refused() -> None:
    with pytest.raises(ValueError, match="has no width"):
        DoorSide((1.0, 1.0), (1.0, 1.0))
    with pytest.raises(ValueError, match="give metres"):
        DoorSide((math.nan, 1.0), (1.0, 1.0))
    with pytest.raises(ValueError, match="start is"):
        plan_approach(DOOR, empty_room(), start=(math.nan, 0.0, 0.0))
    with pytest.raises(ValueError, match="radius is -1"):
        ApproachSettings(radius=-1.0)


@given(places, places)
def test_a_side_is_seen_from_where_one_is(x: float, y: float) -> None:
    side = DoorSide.seen_from(Door(DOOR.right, DOOR.left), (x, y))
    assert side.distance_before((x, y)) >= -1e-9
    assert side.opposite.opposite == side
