"""Doors that open and close."""

from __future__ import annotations

import math
import sys
from dataclasses import replace

import numpy as np
import pytest
import shapely

from semnav_env import SemNavEnv
from semnav_env.judge.episodes import load_episodes
from semnav_env.world.dynamics import Dynamics, Swinging
from semnav_env.world.dynamics.leaves import swinging_leaves, with_leaves
from semnav_env.world.maps import bundled_names, load_floor_plan
from semnav_env.world.maps.doorways import DoorState, door_state
from semnav_env.world.maps.floor_plan import Material, PlanDoor, Surface
from semnav_env.world.maps.rules import check_plan
from tests.support.moving_worlds import world_of
from tests.support.small_plans import closed as ring_of
from tests.support.small_plans import plan_of

plans = pytest.mark.parametrize("name", bundled_names())
ALWAYS = Dynamics(changing_doors=1.0)
BY_HAND = Dynamics(changing_doors=sys.float_info.min)


@plans
def test_hung_leaves_leave_a_valid_plan_with_the_same_open_doors(name: str) -> None:
    plan = load_floor_plan(name)
    hung = with_leaves(plan)
    check_plan(hung)
    assert hung.doors == plan.doors
    leaves, still = swinging_leaves(hung)
    assert len(leaves) > 0
    assert len(still.surfaces) == len(hung.surfaces) - len(leaves)
    assert all(door_state(hung.door(leaf.door), hung) is not DoorState.CLOSED for leaf in leaves)


@plans
def test_a_closed_leaf_fills_its_door(name: str) -> None:
    """It swings only where nothing stands."""
    leaves, still = swinging_leaves(with_leaves(load_floor_plan(name)))
    for leaf in leaves:
        door = still.door(leaf.door)
        ends = sorted((leaf.hinge, leaf.tip(0.0)))
        for end, jamb in zip(ends, sorted((door.start, door.end)), strict=True):
            assert math.dist(end, jamb) < 0.12
        for share in np.linspace(0.1, 0.95, 9):
            hinge, tip = np.array(leaf.hinge), np.array(leaf.tip(share * leaf.swing))
            swept = shapely.LineString((hinge + 0.2 * (tip - hinge), tip))
            assert len(still.solids.query(swept, predicate="intersects")) == 0


def test_no_leaf_hangs_where_the_robot_starts() -> None:
    """The evaluation of such a frozen episode ended with an error."""
    [episode] = (each for each in load_episodes("val_unseen") if each.id == "val_unseen-00700")
    env = SemNavEnv(dynamics=ALWAYS)
    env.reset(seed=0, options={"episode": episode})
    assert len(env.floor_plan.surfaces) > len(episode.plan().surfaces)


def test_of_two_leaves_that_would_meet_only_one_swings() -> None:
    """In a passage 1.3 m wide two doors face each other, and both open into it."""
    drawn = Surface(((0.0, 0.0), (0.0, 1.0)), Material.LEAF)
    other = Surface(((1.3, 1.3), (1.3, 0.3)), Material.LEAF)
    walls = (
        Surface(((-3.0, 0.0), (0.0, 0.0))),
        Surface(((1.0, 0.0), (3.0, 0.0))),
        Surface(((-3.0, 1.3), (0.3, 1.3))),
        Surface(((1.3, 1.3), (3.0, 1.3))),
        ring_of((-3.0, -3.0), (3.0, -3.0), (3.0, 4.0), (-3.0, 4.0)),
    )
    doors = PlanDoor("a", (0.0, 0.0), (1.0, 0.0)), PlanDoor("b", (0.3, 1.3), (1.3, 1.3))
    for leaves in ((drawn,), (other,), (drawn, other)):
        plan = replace(plan_of(*walls, *leaves), doors=doors)
        assert len(swinging_leaves(plan)[0]) == 1
    hung = replace(plan_of(*walls, drawn), doors=doors)
    assert [leaf.door for leaf in swinging_leaves(with_leaves(hung))[0]] == ["a", "b"]


def test_a_closed_door_opens_again_and_an_open_one_closes() -> None:
    world = world_of("office_cross", "wheelchair", ALWAYS)
    world.reset((15.0, 5.5, 1.5), np.random.default_rng(0))
    assert world.moving is not None
    doors = world.moving.doors
    shut_for = np.zeros(len(doors.leaves))
    longest, ever = shut_for.copy(), np.zeros(len(doors.leaves), dtype=bool)
    for _ in range(15 * 60):
        world.step((0.0, 0.0, 0.0))
        shut = doors.angles == 0.0
        shut_for = np.where(shut, shut_for + 1.0 / 15.0, 0.0)
        longest, ever = np.maximum(longest, shut_for), ever | shut
    assert ever.all()
    assert longest.max() <= Swinging().closed_for[1] + 0.2


def test_a_leaf_waits_for_a_robot_in_the_doorway() -> None:
    """It moves on when the robot is gone."""
    world = world_of("office_cross", "spot", ALWAYS)
    door = world.floor_plan.door("west_north_1")
    world.reset((*door.midpoint, math.pi / 2), np.random.default_rng(0))
    assert world.moving is not None
    doors = world.moving.doors
    index = [leaf.door for leaf in doors.leaves].index(door.name)
    for _ in range(15 * 40):
        world.step((0.0, 0.0, 0.0))
        assert not world.in_contact
        assert door.name not in doors.closed
    for _ in range(15 * 40):
        world.step((-0.5, 0.0, 0.0) if world.pose[1] > 9.0 else (0.0, 0.0, 0.0))
        if doors.angles[index] == 0.0:
            return
    pytest.fail("the door never closed after the robot had left")


def test_only_a_closed_leaf_stops_the_robot() -> None:
    for closed in (True, False):
        world = world_of("office_cross", "spot", BY_HAND)
        world.reset((6.75, 8.9, math.pi / 2), np.random.default_rng(0))
        assert world.moving is not None
        world.moving.doors.hold("west_north_2", closed)
        for _ in range(60):
            world.step((0.0, 0.0, 0.0))
        for _ in range(60):
            world.step((0.8, 0.0, 0.0))
        assert (world.pose[1] < 10.2) == closed


def test_a_door_held_by_hand_stays_as_it_is_until_the_next_episode() -> None:
    world = world_of("office_cross", "wheelchair", ALWAYS)
    world.reset((15.0, 5.5, 1.5), np.random.default_rng(0))
    assert world.moving is not None
    doors = world.moving.doors
    for shut in (True, False):
        doors.hold("west_north_2", shut)
        for _ in range(15 * 5):
            world.step((0.0, 0.0, 0.0))
        for _ in range(15 * 40):
            world.step((0.0, 0.0, 0.0))
            assert ("west_north_2" in doors.closed) == shut
    doors.hold("west_north_2", True)
    world.reset((15.0, 5.5, 1.5), np.random.default_rng(0))
    assert doors.closed == ()


def test_only_a_door_with_a_leaf_can_be_held() -> None:
    world = world_of("office_cross", "wheelchair", BY_HAND)
    assert world.moving is not None
    with pytest.raises(ValueError, match=r"'nowhere'; it must be one of .*west_north_2"):
        world.moving.doors.hold("nowhere", True)


def test_leaves_for_a_hand_alone_never_move_by_themselves() -> None:
    world = world_of("office_cross", "wheelchair", BY_HAND)
    world.reset((15.0, 5.5, 1.5), np.random.default_rng(0))
    assert world.moving is not None
    angles = world.moving.doors.angles.copy()
    for _ in range(15 * 60):
        world.step((0.0, 0.0, 0.0))
    assert np.array_equal(world.moving.doors.angles, angles)


def test_with_no_changing_doors_leaves_are_part_of_the_plan() -> None:
    world = world_of("office_cross", "wheelchair", Dynamics(pedestrians=1))
    assert world.still is world.floor_plan
    assert any(s.material is Material.LEAF for s in world.still.surfaces)
