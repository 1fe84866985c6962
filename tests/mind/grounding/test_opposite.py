"""Doors behind and opposite, and turns beyond half a turn: on what is known, seen and driven."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from semnav_agents.evaluation import drive
from semnav_agents.registry import make_agent
from semnav_env.env import SemNavEnv
from semnav_env.language import parse
from semnav_env.mind.grounding import Goal, GroundingError, PassGoal, ReachGoal, SeekGoal
from semnav_env.mind.grounding.follower import Follower
from semnav_features.frames import Pose, compose
from semnav_features.scene import Door, Scene
from tests.mind.grounding.test_wider_grounding import last_goal
from tests.support.hand_made import DOOR_WIDTH, ROOM, corridor

QUARTER = math.pi / 2
BEHIND = corridor(left=(2.0, 5.6), right=(4.0,))
FACING = corridor(left=(3.0, 9.0), right=(3.0, 6.0))
TO_FIRST = "go to the first door on the left and go through the door opposite"

apart = st.lists(st.sampled_from([1.0, 3.2, 5.4, 7.6, 9.8]), unique=True, max_size=5)


def answer(text: str, scene: Scene, start: Pose) -> Goal | str:
    try:
        return last_goal(text, scene, start)
    except GroundingError as error:
        return str(error)


def seen_ahead(scene: Scene, x: float) -> Scene:
    """What lies beyond a place along the corridor."""
    return Scene(
        tuple(wall for wall in scene.walls if min(wall.start[0], wall.end[0]) >= x),
        tuple(door for door in scene.doors if door.start[0] >= x),
    )


@given(apart, apart, st.sampled_from([2.1, 4.3, 6.5, 8.7]), st.integers(1, 3))
def test_behind_is_what_one_comes_by_on_turning_around(
    left: list[float], right: list[float], x: float, ordinal: int
) -> None:
    scene = corridor(left=left, right=[place + 0.7 for place in right])
    nth = ("first", "second", "third")[ordinal - 1]
    behind = answer(f"go through the {nth} door behind you", scene, (x, 0.0, 0.0))
    turned = answer(f"turn around and go through the {nth} door", scene, (x, 0.0, 0.0))
    if isinstance(turned, str):
        assert isinstance(behind, str)
    else:
        assert isinstance(behind, Goal)
        assert behind.door == turned.door
        assert behind.pose == pytest.approx(turned.pose, abs=1e-6)


@given(st.floats(-2.0, 2.0), st.sampled_from([("left", "right"), ("right", "left")]))
def test_doors_are_opposite_iff_their_widths_overlap(shift: float, sides: tuple[str, str]) -> None:
    assume(abs(abs(shift) - DOOR_WIDTH) > 0.01)
    here, there = sides
    scene = corridor(**{here: (5.0,), there: (5.0 + shift,)})
    text = f"go to the first door on the {here} and go through the door opposite"
    found = answer(text, scene, (0.0, 0.0, 0.0))
    if abs(shift) > DOOR_WIDTH:
        assert found == "no door opposite: none faces that door"
    else:
        assert isinstance(found, Goal)
        assert isinstance(found, PassGoal)
        assert found.door.midpoint == pytest.approx((5.0 + shift, 1.0 if there == "left" else -1.0))


@pytest.mark.parametrize("between", ["", "wait for 5 seconds, "])
def test_waiting_before_a_door_changes_nothing(between: str) -> None:
    goal = last_goal(TO_FIRST.replace(" and ", f", {between}"), FACING)
    assert isinstance(goal, PassGoal)
    assert goal.door.midpoint == (3.0, -1.0)


def test_following_leads_back_to_a_door_but_not_across() -> None:
    goal = last_goal("go down the hallway until the second door behind you", BEHIND, (8, 0, 0))
    assert goal.pose == pytest.approx((4.3, 0.0, math.pi), abs=0.05)
    with pytest.raises(GroundingError, match="it lies across"):
        last_goal("go down the hallway until the door opposite", FACING)


@pytest.mark.parametrize(
    ("text", "turn"),
    [
        ("turn left by 270 degrees", -QUARTER),
        ("turn right by 270 degrees", QUARTER),
        ("turn right by 225 degrees", 1.5 * QUARTER),
        ("turn left by 360 degrees", 0.0),
    ],
)
def test_long_turns_end_as_the_shorter_ones(text: str, turn: float) -> None:
    begin = (1.0, 0.2, 0.3)
    goal = last_goal(text, BEHIND, begin)
    assert goal.pose == pytest.approx(compose(begin, (0.0, 0.0, turn)))
    assert goal.heading_tolerance == 0.5


def look(text: str, scene: Scene, pose: Pose, begin: Pose | None = None) -> Follower:
    """A robot that began its last clause at `begin`, knows a scene and is now at a pose."""
    follower = Follower(parse(text))
    follower.start(scene, pose if begin is None else begin)
    follower.advance(lambda: scene, pose, 0.0, 1 / 15)
    follower.look(scene, pose)
    return follower


@pytest.mark.parametrize("text", ["go through", "if you see", "go to"])
def test_an_unseen_rear_is_inspected_by_turning(text: str) -> None:
    rest = ", stop" if text.startswith("if") else ""
    follower = look(f"{text} the door behind you{rest}", seen_ahead(BEHIND, 7.5), (8.0, 0.0, 0.0))
    assert follower.active == 0
    assert isinstance(follower.goal, ReachGoal)
    assert follower.goal.pose == pytest.approx((8.0, 0.0, math.pi))
    assert follower.goal.because == "looking for the first door behind you"
    assert not follower.goal.reached_by((*follower.goal.pose[:2], 3.0))


def test_without_a_door_behind_the_search_goes_back_on() -> None:
    begin, pose = (8.0, 0.0, 0.0), (8.0, 0.0, 3.0)
    text = "go through the third door behind you"
    follower = look(text, seen_ahead(BEHIND, 3.0), pose, begin)
    assert isinstance(follower.goal, SeekGoal)
    assert follower.goal.pose[0] == pytest.approx(4.0, abs=0.05)
    follower.advance(lambda: BEHIND, (5.0, 0.0, 3.1), 0.5, 1 / 15)
    follower.look(BEHIND, (5.0, 0.0, 3.1))
    assert isinstance(follower.goal, PassGoal)
    assert follower.goal.door == BEHIND.doors[0]


def test_a_finished_search_behind_says_what_there_is() -> None:
    follower = look("go through the fourth door behind you", BEHIND, (8, 0, 3.1), (8, 0, 0))
    follower.advance(lambda: BEHIND, (-1.6, 0.0, 3.1), 0.5, 1 / 15)
    follower.look(BEHIND, (-1.6, 0.0, 3.1))
    assert follower.impossible == "no fourth door behind you: the hallway ended after 3"


def test_an_unseen_opposite_side_is_inspected_by_turning() -> None:
    text, half = TO_FIRST, Scene(tuple(w for w in FACING.walls if w.start[1] > -0.9))
    before: Pose = (3.0, 0.1, QUARTER)
    follower = Follower(parse(text))
    follower.start(Scene(half.walls, FACING.doors[:1]), (0.0, 0.0, 0.0))
    follower.skip_to_next(Scene(half.walls, FACING.doors[:1]))
    assert isinstance(follower.goal, ReachGoal)
    assert follower.goal.pose == pytest.approx((3.0, 0.1, -QUARTER))
    follower.look(FACING, compose(before, (0.0, 0.0, 3.0)))
    assert isinstance(follower.goal, PassGoal)
    assert isinstance(follower.goal, PassGoal)
    assert follower.goal.door.midpoint == (3.0, -1.0)


@pytest.mark.parametrize("kind", [np.array, list])
def test_doors_whose_ends_are_arrays_are_found_as_others(kind: Callable[..., Any]) -> None:
    doors = tuple(Door(kind(door.start), kind(door.end)) for door in FACING.doors)
    assert doors == tuple(FACING.doors)
    assert answer(TO_FIRST, Scene(FACING.walls, doors), (0.0, 0.0, 0.0)) == answer(
        TO_FIRST, FACING, (0.0, 0.0, 0.0)
    )


def test_a_door_whose_end_is_no_point_is_refused() -> None:
    with pytest.raises(ValueError, match=r"end is .*; it must be \(x, y\), two finite numbers"):
        Door((0.0, 0.0), np.array([1.0, 0.0, 0.0]))  # type: ignore[arg-type]


def test_no_door_is_called_missing_before_the_first_scan() -> None:
    """A robot that has seen nothing yet waits."""
    follower = look("go through the door opposite", Scene(), (7.0, 0.0, 0.0))
    assert isinstance(follower.goal, SeekGoal)
    follower.look(BEHIND, (7.0, 0.0, 0.0))
    assert follower.impossible == "no door opposite: none faces this place"


WEST = (1.3, 9.1, 0.0)
AROUND = "turn left by 270 degrees and go through the first door on the left"
OUT = "go through the first door on the left, leave the room and go through the door"


@pytest.mark.parametrize("robot", ["wheelchair", "spot"])
@pytest.mark.parametrize(
    ("text", "pose", "door"),
    [
        ("go through the door behind you", (5.5, 9.1, 0.0), "west_south_1"),
        (TO_FIRST, WEST, "west_south_1"),
        (f"{OUT} opposite", WEST, "west_south_1"),
        (f"{OUT} behind you", WEST, "west_north_1"),
        (AROUND, (4.5, 9.1, QUARTER), "west_north_2"),
    ],
)
def test_a_robot_that_sees_it_drives_there(robot: str, text: str, pose: Pose, door: str) -> None:
    agent = make_agent("scripted")
    env = SemNavEnv(robot, "office_cross", observation=agent.observation)
    driven = drive(env, agent, 0, {"command": parse(text), "pose": pose})
    assert driven.cause == ""
    assert driven.judge.crossed[-1] == door
    assert driven.rechecked() == ""


def test_a_gap_is_inspected_before_a_door_is_called_missing() -> None:
    """The robot turns towards an unseen stretch beside it."""
    unknown = Scene(FACING.walls)  # the gaps are seen, but not yet taken for doors
    begin: Pose = (6.0, 0.0, 0.0)
    follower = look("go through the door opposite", unknown, begin)
    assert isinstance(follower.goal, ReachGoal)
    assert follower.goal.pose == pytest.approx((6.0, 0.0, -QUARTER))
    follower.look(unknown, (6.0, 0.0, -1.2))
    assert follower.impossible == "no door opposite: none faces this place"
    follower.look(FACING, (6.0, 0.0, -1.2))
    assert follower.goal.door == FACING.doors[3]


def test_of_two_doors_as_straight_behind_none_is_chosen() -> None:
    walls = corridor(half=3.0).walls
    doors = tuple(Door((-3.0, y), (-3.0, y + 0.9)) for y in (-1.2, 0.3))
    with pytest.raises(GroundingError, match="two there are equally nearly straight behind"):
        last_goal("go through the door behind you", Scene(walls, doors), (2.0, 0.0, 0.0))


@pytest.mark.parametrize("until", ["until", "past"])
def test_a_door_that_is_far_behind_in_a_room_is_far_away(until: str) -> None:
    scene = Scene(corridor(half=3.0).walls, (Door((-3.0, -0.45), (-3.0, 0.45)),))
    text = f"go down the hallway {until} the first door behind you"
    assert last_goal(text, scene, (5.0, 0.0, 0.0)).pose[:2] == pytest.approx((-2.0, 0.0), abs=0.05)


@pytest.mark.parametrize("until", ["until", "past"])
def test_one_cannot_go_to_the_doorway_that_one_stands_in(until: str) -> None:
    text = f"go down the hallway {until} the first door behind you"
    with pytest.raises(GroundingError, match="one stands in that doorway"):
        last_goal(text, FACING, (3.0, 1.0, QUARTER))


def test_a_doorway_has_no_second_door_behind() -> None:
    text = "if you see a second door behind you, go through it, otherwise turn around"
    seen = Scene(FACING.walls, FACING.doors[:1])
    for scene, begin, pose in (
        (seen, (3.0, 1.0, QUARTER), (3.0, 1.0, QUARTER)),
        (ROOM, (0.0, 0.0, math.pi), (0.0, 0.0, 0.0)),  # who has looked round in a room
    ):
        follower = look(text, scene, pose, begin)
        assert follower.active == 2
        assert follower.goal.because == "turn around here"


@pytest.mark.parametrize("nth", ["second", "third", "second-to-last", "third-to-last"])
def test_no_condition_on_more_than_one_door_opposite_is_met(nth: str) -> None:
    text = f"go to the first door on the left, if you see the {nth} door opposite, stop, otherwise "
    goal = last_goal(text + "turn left by 90 degrees", FACING)
    assert isinstance(goal, ReachGoal)


@given(st.floats(-4.0, 4.0))
def test_in_a_room_behind_means_more_behind_than_beside(shift: float) -> None:
    assume(abs(abs(shift) - 3.0) > 0.05)
    scene = Scene(corridor(half=5.0).walls, (Door((-3.0, shift - 0.45), (-3.0, shift + 0.45)),))
    found = answer("go through the door behind you", scene, (0.0, 0.0, 0.0))
    assert isinstance(found, Goal) is (abs(shift) < 3.0)
