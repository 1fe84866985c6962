"""What is run into but not seen: when it becomes a wall, and what robots make of it."""

from __future__ import annotations

import math
import pickle
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from semnav_agents.registry import make_agent
from semnav_env.env import SemNavEnv
from semnav_env.language import parse
from semnav_env.mind.belief import BeliefTracker
from semnav_env.mind.belief.bump_limits import LIMITS, MOST_PIECES
from semnav_env.mind.belief.bump_map import BumpMap
from semnav_env.mind.belief.understand import LOOK_DUE, understand
from semnav_env.mind.observations import table
from semnav_env.robots import ROBOTS
from semnav_env.world.maps.floor_plan import FloorPlan, Material, Surface
from semnav_env.world.physics import World
from semnav_features.frames import MOST_CONTACTS, Contact, Pose, points_to_parent, to_parent
from semnav_features.lidars import lidar_spec
from semnav_features.scene import Door, Scene
from tests.support.small_plans import closed, plan_of

SPEC = lidar_spec("tim561")
HERE: Pose = (0.0, 0.0, 0.0)
FRONT: Contact = (0.6, 0.0, 0.0)
HALF = LIMITS.piece_length / 2
NOTHING_NEAR = np.full(SPEC.beams, 5.0)

poses = st.tuples(st.floats(-9, 9), st.floats(-9, 9), st.floats(-math.pi, math.pi))


def bump_map() -> BumpMap:
    return BumpMap(SPEC, HERE)


def pane_across(east: float = 6.0) -> FloorPlan:
    """A corridor along x, 3 m wide, with a pane across its left half."""
    return plan_of(
        closed((0, -1.5), (12, -1.5), (12, 1.5), (0, 1.5)),
        Surface(((east, -0.2), (east, 1.5)), Material.GLASS),
    )


@given(poses)
def test_a_touch_that_the_lidar_sees_through_is_a_wall_across_it(odometry: Pose) -> None:
    known = bump_map()
    assert known.note([FRONT], NOTHING_NEAR, odometry)
    (ends,) = known.ends.reshape(-1, 2, 2)
    expected = points_to_parent(odometry, np.array([(0.6, -HALF), (0.6, HALF)]))
    np.testing.assert_allclose(ends, expected, atol=1e-9)


@pytest.mark.parametrize("distance", [0.1, 0.6, 0.8, -math.inf])
def test_what_the_lidar_sees_is_not_felt_as_well(distance: float) -> None:
    known = bump_map()
    assert not known.note([FRONT], np.full(SPEC.beams, distance), HERE)
    assert len(known) == 0


def test_a_beam_that_measured_nothing_shows_no_wall() -> None:
    ranges = np.full(SPEC.beams, 0.6)
    ranges[round(-SPEC.angle_min / SPEC.angle_increment)] = math.nan
    assert bump_map().note([FRONT], ranges, HERE)


def test_touches_outside_the_view_are_bumps() -> None:
    known = bump_map()
    assert known.note([(-0.6, 0.0, math.pi)], np.full(SPEC.beams, 0.1), HERE)


def test_a_full_circle_lidar_sees_what_is_touched_behind() -> None:
    round_spec = replace(SPEC, beams=720, angle_min=-math.pi, angle_increment=math.tau / 720)
    behind = [(-0.6, 0.0, math.pi)]
    assert not BumpMap(round_spec, HERE).note(behind, np.full(720, 0.6), HERE)
    assert BumpMap(round_spec, HERE).note(behind, np.full(720, 5.0), HERE)


@given(poses, st.floats(-0.04, 0.04))
def test_the_same_touch_again_tells_nothing_new(odometry: Pose, aside: float) -> None:
    known = bump_map()
    known.note([FRONT], NOTHING_NEAR, odometry)
    known.note([(0.6, 1.0, 0.0)], NOTHING_NEAR, odometry)
    ends = known.ends
    for touch in (FRONT, (0.6, aside, 0.0), (0.6, 1.0, 0.0)):
        assert not known.note([touch], NOTHING_NEAR, odometry)
    assert np.array_equal(known.ends, ends)


def test_touches_at_both_ends_of_the_front_are_one_wall() -> None:
    """A robot touches one wall with both ends of its front."""
    known = bump_map()
    known.note([(0.6, -0.45, 0.0), (0.6, 0.45, 0.0)], NOTHING_NEAR, HERE)
    assert len(known) == 1


def test_of_many_touches_the_first_count() -> None:
    known = BeliefTracker()
    known.begin(parse("turn around"))
    rows = [(0.6 + 0.3 * k, 0.0, 0.0) for k in range(MOST_CONTACTS + 3)]
    known.update(NOTHING_NEAR, HERE, bumps=rows)
    assert len(known.bumps) == MOST_CONTACTS


def test_a_known_touch_calls_for_no_thinking() -> None:
    robot = BeliefTracker()
    robot.begin(parse("turn around"))
    robot.update(NOTHING_NEAR, HERE)
    events = []
    for _ in range(2):
        robot.take(NOTHING_NEAR, HERE, bumps=[FRONT])
        events.append(understand(robot.senses))
        robot.think(events[-1])
    assert [bool(seen & LOOK_DUE) for seen in events] == [True, False]


def test_a_tracker_forgets_a_piece_that_the_robot_gets_through() -> None:
    robot = BeliefTracker()
    robot.begin(parse("turn around"))
    robot.update(NOTHING_NEAR, (0.0, 0.0, 0.0), bumps=[FRONT])
    robot.update(NOTHING_NEAR, (0.5, 0.0, 0.0))
    assert len(robot.bumps) == 1
    belief = robot.update(NOTHING_NEAR, (0.7, 0.0, 0.0))
    assert len(robot.bumps) == 0
    assert not any(0.55 < wall.start[0] < 0.65 for wall in belief.scene.walls)


def test_a_piece_that_the_robot_gets_through_is_forgotten() -> None:
    known = bump_map()
    known.note([FRONT], NOTHING_NEAR, HERE)
    known.note([(0.6, 1.0, 0.0)], NOTHING_NEAR, HERE)
    known.pass_on((0.0, 0.0, 0.0), (0.5, 0.0, 0.0))
    assert len(known) == 2
    known.pass_on((0.5, 0.0, 0.0), (0.7, 0.0, 0.0))
    assert known.ends[:, 1].min() == pytest.approx(0.9)


@given(poses, st.floats(-0.6, 0.6))
def test_pieces_that_no_robot_gets_between_are_one(odometry: Pose, aside: float) -> None:
    assume(abs(abs(aside) - LIMITS.least_growth) > 1e-9)  # there rounding decides
    known = bump_map()
    known.note([FRONT], NOTHING_NEAR, odometry)
    known.note([(0.6, aside, 0.0)], NOTHING_NEAR, odometry)
    assert len(known) == 1
    length = math.dist(known.ends[0, :2], known.ends[0, 2:])
    grown = abs(aside) if abs(aside) > LIMITS.least_growth else 0.0
    assert length == pytest.approx(LIMITS.piece_length + grown, abs=1e-6)
    assert min(robot.width for robot in ROBOTS.values()) > LIMITS.piece_gap


@given(poses)
def test_pieces_farther_apart_or_at_an_angle_stay_two(odometry: Pose) -> None:
    for other in ((0.6, 1.0, 0.0), (0.6, 0.1, 0.6), (1.0, 0.0, 0.0)):
        known = bump_map()
        known.note([FRONT], NOTHING_NEAR, odometry)
        known.note([other], NOTHING_NEAR, odometry)
        assert len(known) == 2


def test_a_full_bump_map_drops_its_oldest_piece() -> None:
    known = bump_map()
    for k in range(MOST_PIECES + 3):
        known.note([FRONT], NOTHING_NEAR, (2.0 * k, 0.0, 0.0))
    assert len(known) == MOST_PIECES
    assert known.ends[:, 0].min() == pytest.approx(2.0 * 3 + 0.6)


@given(poses)
def test_a_bumped_door_no_longer_counts_but_its_neighbour_does(odometry: Pose) -> None:
    """What was bumped into lies in its opening."""

    def door(low: float, high: float) -> Door:
        return Door(to_parent(odometry, (0.6, low)), to_parent(odometry, (0.6, high)))

    barred, beside, behind = (
        door(-0.5, 0.5),
        door(0.15, 1.1),
        Door(*[to_parent(odometry, p) for p in ((0.6, -0.5), (1.5, -0.5))]),
    )
    known = bump_map()
    known.note([FRONT], NOTHING_NEAR, odometry)
    scene = known.join(Scene((), (barred, beside, behind)))
    assert scene.doors == (beside, behind)
    assert len(scene.walls) == 1


def test_nothing_felt_changes_nothing() -> None:
    scene = Scene((), (Door((1.0, 0.0), (2.0, 0.0)),))
    assert bump_map().join(scene) is scene


@pytest.mark.parametrize("robot", ROBOTS)
def test_bumped_panes_are_kept_for_the_episode(
    robot: str,
) -> None:
    """A pane of glass that was bumped into is forgotten with the episode."""
    env = SemNavEnv(robot, pane_across())
    options = {"pose": (3.0, 0.5, 0.0), "command": "go down the hallway"}
    observation, _ = env.reset(seed=1, options=options)
    forward = np.zeros(env.action_space.shape, np.float32)
    forward[0] = 1.0
    info = {"in_contact": False}
    while not info["in_contact"]:
        assert len(table(observation, "bumps")) == 0
        observation, _, _, _, info = env.step(forward)
    (piece,) = table(observation, "bumps")
    front = env.robot.length / 2
    assert piece[[0, 2]] == pytest.approx(front, abs=0.05)
    assert env.observation_space.contains(observation)
    observation, _ = env.reset(seed=1, options=options)
    assert len(table(observation, "bumps")) == 0


@pytest.mark.parametrize("robot", ROBOTS)
def test_a_robot_feels_no_wall_that_it_sees(robot: str) -> None:
    env = SemNavEnv(robot, pane_across())
    env.reset(seed=1, options={"pose": (10.5, 0.0, 0.0), "command": "turn around"})
    forward = np.zeros(env.action_space.shape, np.float32)
    forward[0] = 1.0
    touched = False
    for _ in range(60):
        observation, _, _, _, info = env.step(forward)
        touched |= info["in_contact"]
        assert len(table(observation, "bumps")) == 0
    assert touched


@pytest.mark.parametrize("robot", ROBOTS)
def test_the_scripted_agent_finds_its_way_around_a_pane(robot: str) -> None:
    agent = make_agent("scripted")
    env = SemNavEnv(robot, pane_across(), observation=agent.observation)
    command = "go down the hallway until the end of the hallway"
    observation, info = env.reset(seed=1, options={"pose": (2.0, 0.5, 0.0), "command": command})
    agent.reset(info)
    over = False
    while not over:
        observation, _, over, truncated, info = env.step(agent.act(observation))
        over |= truncated
    assert info["is_success"]
    assert len(table(observation, "bumps")) > 0


@pytest.mark.parametrize("heading", [0.0, 0.5, math.pi / 2, 2.0, math.pi, -1.0])
def test_a_touch_lies_on_the_footprint_and_points_outwards(heading: float) -> None:
    plan = plan_of(closed((-3, -3), (3, -3), (3, 3), (-3, 3)))
    world = World(plan, ROBOTS["spot"])
    world.reset((0.0, 0.0, heading), np.random.default_rng(0))
    assert world.touches == []
    while not world.touches:
        world.step((0.5, 0.0, 0.0))
    copy = pickle.loads(pickle.dumps(world))
    assert copy.touches == world.touches
    half = np.array((world.robot.length, world.robot.width)) / 2
    for x, y, inward in world.touches:
        assert (np.abs((x, y)) < half + 0.01).all()
        assert (np.abs((x, y)) > half - 0.01).any()
        ahead = to_parent(world.pose, to_parent((x, y, inward), (0.05, 0.0)))
        assert max(map(abs, ahead)) > 3.0
