"""Boxes and people that are added by hand while an episode runs, and doors that are shut."""

from __future__ import annotations

import math
import pickle
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from semnav_env.env import SemNavEnv
from semnav_env.judge.metrics.recording import Recorder
from semnav_env.robots import ROBOTS
from semnav_env.world.dynamics import Dynamics, Walking
from semnav_env.world.dynamics.boxes import BOX_SIDE, box_corners
from semnav_env.world.dynamics.settings import AWAY
from semnav_env.world.maps import load_floor_plan
from semnav_env.world.maps.placement import footprint
from semnav_env.world.physics import World
from semnav_env.world.simulator import RobotSetup, Simulator
from tests.support.episodes import actions, digest, rollout
from tests.support.moving_worlds import deepest_overlap

HALLWAY = load_floor_plan("heidelberg_hallway")
START = (-2.5, -0.6, 0.0)
AHEAD = (0.5, 0.0, 0.0)
REST = (0.0, 0.0, 0.0)
WHEELCHAIR = ROBOTS["wheelchair"]
SETUP = RobotSetup(robot=WHEELCHAIR, exact=True)
FREE, FAR = (1.0, 0.4), (-1.0, -0.6)


def begun(by_hand: int = 2, **dynamics: Any) -> Simulator:
    """A wheelchair at rest in the hallway, where boxes and people can be added."""
    simulator = Simulator(HALLWAY, SETUP, Dynamics(by_hand=by_hand, **dynamics))
    simulator.reset(START, np.random.default_rng(0))
    return simulator


def ahead(simulator: Simulator) -> float:
    """The range of the beam straight ahead, metres."""
    world, spec = simulator.world, simulator.lidar.spec
    ranges = simulator.lidar.exact_ranges(world.pose)
    return float(ranges[np.argmin(np.abs(spec.angles))])


def test_an_added_box_is_seen_and_stops_the_robot() -> None:
    simulator = begun()
    before = ahead(simulator)
    simulator.world.add_box(FAR)
    assert ahead(simulator) < min(before, 1.5)
    for _ in range(90):
        simulator.step(AHEAD)
    assert simulator.world.in_contact
    front = FAR[0] - BOX_SIDE / 2
    assert simulator.world.pose[0] + WHEELCHAIR.length / 2 < front + 0.01
    assert simulator.world.clearance() < 0.01


def test_an_added_person_walks_and_walks_into_nothing() -> None:
    simulator = begun()
    simulator.world.add_box(FAR)
    simulator.world.add_person(FREE)
    for _ in range(150):
        simulator.step(REST)
        assert deepest_overlap(simulator.world) < 0.01
    people, sides = simulator.world.moving_shapes
    assert people.shape == (1, 3)
    assert sides.shape == (4, 4)
    assert math.dist(people[0, :2], FREE) > 0.5


def test_an_added_person_stops_the_robot() -> None:
    """Somebody who has nowhere to go stands in its way."""
    simulator = begun(walking=Walking(speed=0.01, spread=0.0))
    simulator.world.add_person(FAR)
    for _ in range(90):
        simulator.step(AHEAD)
        assert deepest_overlap(simulator.world) < 0.01
    assert simulator.world.in_contact


def test_a_reset_takes_away_what_was_added() -> None:
    simulator = begun()
    before = simulator.lidar.exact_ranges(START)
    simulator.world.add_box(FAR)
    simulator.world.add_person(FREE)
    simulator.reset(START, np.random.default_rng(0))
    assert [len(shapes) for shapes in simulator.world.moving_shapes] == [0, 0]
    np.testing.assert_array_equal(simulator.lidar.exact_ranges(START), before)
    for _ in range(45):
        simulator.step(AHEAD)
    assert simulator.world.pose[0] > FAR[0] - BOX_SIDE


def test_room_for_additions_changes_nothing_until_they_come() -> None:
    one, other = begun(1), begun(20)
    for _ in range(20):
        ranges = one.step(AHEAD).ranges.copy()
        np.testing.assert_array_equal(other.step(AHEAD).ranges, ranges)
        assert one.world.pose == other.world.pose


def test_the_same_additions_give_the_same_bits_also_in_a_copy() -> None:
    """A copy made in mid-episode repeats what was done by hand."""
    env = SemNavEnv(
        floor_plan="office_cross",
        observation="all",
        dynamics=Dynamics(pedestrians=1, changing_doors=0.5, by_hand=2),
    )
    steps = actions(90, 2)
    seen, ends = [], []
    for copied in (False, True):
        env.reset(seed=3, options={"pose": (1.3, 9.1, 0.0)})
        list(rollout(env, steps[:30]))
        env.world.add_person((8.0, 9.1))
        door = env.world.moving.doors.leaves[0].door
        env.world.hold_door(door, True)
        list(rollout(env, steps[30:60]))
        env.world.add_box((6.0, 9.1))
        twin = pickle.loads(pickle.dumps(env)) if copied else env
        seen.append(digest(rollout(twin, steps[60:])))
        ends.append([shapes.tolist() for shapes in twin.world.moving_shapes])
    assert seen[0] == seen[1]
    assert ends[0] == ends[1]
    assert len(ends[0][0]) == 2


def test_a_recording_shows_an_added_person_from_when_it_came() -> None:
    world = begun().world
    recorder = Recorder(world)
    world.step(REST)
    recorder.note()
    world.add_person(FREE)
    world.step(REST)
    recorder.note()
    people = recorder.recording().people
    assert people is not None
    assert (people[:2, 0, :2] == AWAY).all()
    np.testing.assert_array_equal(people[2], world.moving_shapes[0])


REFUSED: list[tuple[str, Callable[[World], None], str]] = [
    ("a box on the robot", lambda w: w.add_box(START[:2]), "beside the robot"),
    ("a box elsewhere", lambda w: w.add_box((500.0, 0.0)), "inside the floor plan"),
    ("a box in a wall", lambda w: w.add_box((2.5, -0.16)), "touch no wall"),
    ("a box on a person", lambda w: w.add_box(FREE), "where nobody stands"),
    ("a box on a box", lambda w: w.add_box((-0.8, -0.6)), "beside the other boxes"),
    ("a box of three numbers", lambda w: w.add_box((0, 0, 0)), "two finite numbers"),  # type: ignore[arg-type]
    ("a box nowhere", lambda w: w.add_box((math.nan, 0.0)), "two finite numbers"),
    ("a person at the robot", lambda w: w.add_person(START[:2]), "from the robot"),
    ("a person in a box", lambda w: w.add_person(FAR), "no box"),
    ("a person in a person", lambda w: w.add_person(FREE), "a free place"),
    ("a person elsewhere", lambda w: w.add_person((500.0, 0.0)), "a free place"),
    ("a person in a wall", lambda w: w.add_person((2.5, -0.16)), "a free place"),
    ("a person nowhere", lambda w: w.add_person((0.0, math.inf)), "two finite numbers"),
    ("no door", lambda w: w.hold_door("nowhere", True), "it must be one of"),
]


@pytest.mark.parametrize(
    ("act", "why"), [case[1:] for case in REFUSED], ids=[c[0] for c in REFUSED]
)
def test_what_cannot_be_is_refused_and_changes_nothing(
    act: Callable[[World], None], why: str
) -> None:
    world = begun(changing_doors=1e-300).world
    world.add_box(FAR)
    world.add_person(FREE)
    before = pickle.dumps(world)
    with pytest.raises(ValueError, match=why):
        act(world)
    assert pickle.dumps(world) == before


def test_no_more_is_added_than_there_is_room_for() -> None:
    world = begun(1).world
    world.add_box(FAR)
    world.add_person(FREE)
    with pytest.raises(ValueError, match=r"people added by hand is 2; .* at most 1"):
        world.add_person((2.5, 0.6))
    with pytest.raises(ValueError, match=r"boxes added by hand is 2; .* at most 1"):
        world.add_box((2.5, 0.6))
    none = begun(0, pedestrians=1).world
    with pytest.raises(ValueError, match="at most 0"):
        none.add_box((2.5, 0.6))
    with pytest.raises(ValueError, match="only the robot moves"):
        begun(0).world.add_person(FREE)
    with pytest.raises(RuntimeError, match="reset"):
        World(HALLWAY, WHEELCHAIR, dynamics=Dynamics(by_hand=1)).add_box(FAR)


@pytest.fixture(scope="module")
def roomy() -> World:
    return begun(changing_doors=1e-300).world


@settings(max_examples=60, deadline=None)
@given(middle=st.tuples(st.floats(-5.0, 10.0), st.floats(-6.0, 8.0)))
def test_a_box_that_is_put_down_overlaps_nothing(roomy: World, middle: tuple[float, float]) -> None:
    world = roomy
    world.reset(START)
    try:
        world.add_box(middle)
    except ValueError:
        return
    box = shapely.Polygon(box_corners(middle))
    solids = shapely.linestrings(world.still.segments.reshape(-1, 2, 2))
    leaves = shapely.linestrings(world.moving_shapes[1][:-4].reshape(-1, 2, 2))
    assert not shapely.intersects(box, np.concatenate((solids, leaves))).any()
    assert not box.intersects(footprint(WHEELCHAIR, world.pose))
