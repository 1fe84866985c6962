"""How far a robot is in following a command, and when a door has been crossed."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from shapely import LineString, Point

from semnav_env.language import parse
from semnav_env.mind.grounding.crossing import first_crossed
from semnav_env.mind.grounding.follower import Follower
from semnav_env.mind.grounding.goal import PassGoal, ReachGoal, SeekGoal, StopGoal
from semnav_features.frames import Pose, compose
from semnav_features.scene import Door, Scene
from tests.support.hand_made import SIDE_ARMS, X_JUNCTION, corridor

START: Pose = (0.0, 0.0, 0.0)
QUARTER = math.pi / 2
SCENE = corridor(left=(3.0, 6.0), right=(4.0,))


def following(text: str, scene: Scene = SCENE, care: float = 1.0, margin: float = 0.0) -> Follower:
    follower = Follower(parse(text), complete=True, care=care, jamb_margin=margin)
    follower.start(scene, START)
    return follower


def drive(follower: Follower, *poses: Pose, scene: Scene = SCENE, speed: float = 0.5) -> list[bool]:
    """Whether a clause was completed at each pose."""
    return [follower.advance(lambda: scene, pose, speed, 1 / 15) for pose in poses]


def test_a_door_clause_is_done_when_the_centre_crosses_the_line() -> None:
    follower = following("go through the first door on the left")
    before, line, behind = (3.0, 0.9, QUARTER), (3.0, 0.999, QUARTER), (3.1, 1.01, QUARTER)
    assert drive(follower, (3.0, 0.0, QUARTER), before, line, behind) == [False, False, False, True]
    assert follower.done


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ((6.0, 0.9, QUARTER), (6.0, 1.1, QUARTER)),
        ((4.0, -0.9, -QUARTER), (4.0, -1.1, -QUARTER)),
        ((3.0, 1.1, -QUARTER), (3.0, 0.9, -QUARTER)),
        ((2.4, 0.9, QUARTER), (2.4, 1.1, QUARTER)),
    ],
    ids=["another door", "the other side", "coming back", "beside the jamb"],
)
def test_nothing_else_is_that_door(before: Pose, after: Pose) -> None:
    goal = following("go through the first door on the left").goal
    assert goal.crossed_between((3.0, 0.9, QUARTER), (3.0, 1.1, QUARTER))
    assert not goal.crossed_between(before, after)


def test_an_inexact_door_is_crossed_only_well_behind_its_line() -> None:
    """A little beside the jambs counts, too."""
    follower = following("go through the first door on the left", margin=0.3)
    beside = 3.0 - 0.45 - 0.2
    assert drive(follower, (beside, 0.9, QUARTER), (beside, 1.2, QUARTER)) == [False, False]
    assert drive(follower, (beside, 1.4, QUARTER)) == [True]


def test_clauses_follow_one_another() -> None:
    follower = following("go to the first door on the left, turn around and stop")
    at_door = follower.goal.pose
    assert isinstance(follower.goal, ReachGoal)
    assert drive(follower, at_door) == [True]
    assert follower.goal.pose[2] == pytest.approx(-QUARTER)
    assert drive(follower, (*at_door[:2], -QUARTER)) == [True]
    assert isinstance(follower.goal, StopGoal)
    assert drive(follower, at_door, speed=0.2) == [False]
    assert drive(follower, at_door, speed=0.0) == [True]
    assert follower.done
    assert drive(follower, at_door) == [False]


def test_half_the_tolerance_is_enough_for_a_careful_robot_only() -> None:
    off = compose(following("go to the end of the hallway").goal.pose, (-0.7, 0.0, 0.0))
    assert drive(following("go to the end of the hallway"), off) == [True]
    assert drive(following("go to the end of the hallway", care=0.5), off) == [False]


@given(
    distance=st.floats(0.0, 3.0),
    direction=st.floats(-math.pi, math.pi),
    turn=st.floats(-math.pi, math.pi),
    share=st.floats(0.1, 1.0),
)
def test_what_a_careful_robot_calls_reached_is_reached(
    distance: float, direction: float, turn: float, share: float
) -> None:
    goal = ReachGoal((1.0, 2.0, 3.0), 1.6, 0.5)
    x, y = 1.0 + distance * math.cos(direction), 2.0 + distance * math.sin(direction)
    pose = (x, y, math.remainder(3.0 + turn, math.tau))
    careful, plain = goal.reached_by(pose, share), goal.reached_by(pose)
    assert plain == (distance <= 1.6 and abs(turn) <= 0.5) or abs(distance - 1.6) < 1e-9
    assert plain or not careful


@pytest.mark.parametrize(
    ("offset", "turned", "there"), [(1.9, 0.0, True), (2.1, 0.0, False), (1.9, 0.6, False)]
)
def test_a_wide_arm_is_taken_anywhere_across_it_facing_out(
    offset: float, turned: float, there: bool
) -> None:
    goal = ReachGoal((1.0, 2.0, 0.0), 1.6, 0.5, offset_tolerance=2.0)
    assert goal.reached_by((2.5, 2.0 + offset, turned)) is there


@pytest.mark.parametrize("care", [0.5, 1.0])
def test_the_start_of_a_clause_does_not_depend_on_the_driving(care: float) -> None:
    follower = following("turn left at the intersection, then go to the door ahead", X_JUNCTION)
    mouth = follower.goal.onward
    assert mouth is not None
    arrived = compose(follower.goal.pose, (0.6 * care, -0.4 * care, 0.2))
    assert drive(follower, arrived, scene=X_JUNCTION) == [True]
    assert follower.begin == pytest.approx(mouth)


def test_after_a_door_the_next_clause_begins_in_the_doorway() -> None:
    follower = following("go through the first door on the left and turn right")
    drive(follower, (2.8, 0.9, 1.2), (2.9, 1.1, 1.2))
    assert follower.begin == pytest.approx((3.0, 1.0, QUARTER))
    assert follower.goal.pose[1] == pytest.approx(2.0, abs=0.01)


def test_skipping_goes_the_planned_way() -> None:
    text = "turn left at the intersection, then go down the hallway"
    skipped, driven = following(text, SIDE_ARMS), following(text, SIDE_ARMS)
    drive(driven, driven.goal.pose, scene=SIDE_ARMS)
    skipped.skip_to_next(SIDE_ARMS)
    assert skipped.goal.pose == pytest.approx(driven.goal.pose)
    assert skipped.active == driven.active == 1


def test_a_bare_follow_is_carried_out_only_if_nothing_limits_it() -> None:
    """The next clause can say how far to go."""
    assert following("go down the hallway").active == 0
    assert following("go down the hallway and stop").active == 0
    assert following("go down the hallway and take the first door on the left").active == 1
    turning = following("go down the hallway, turn right", SIDE_ARMS)
    assert turning.active == 1
    assert turning.goal.pose[0] == pytest.approx(9.0, abs=0.06)


def test_an_impossible_clause_is_named_and_never_done() -> None:
    follower = following("go through the second door on the right")
    assert follower.impossible == "no second door on the right: the hallway ended after 1"
    assert isinstance(follower.goal, StopGoal)
    assert drive(follower, START, speed=0.0) == [False]
    assert not follower.done


def test_a_door_that_turns_up_makes_the_clause_possible_again() -> None:
    follower = following("go through the second door on the right")
    follower.look(corridor(right=(4.0, 7.0)), START)
    assert follower.impossible is None
    assert isinstance(follower.goal, PassGoal)


def test_what_was_looked_at_stays_so_when_the_robot_comes_back() -> None:
    follower = Follower(parse("go through the last door on the left"))
    follower.start(SCENE, START)
    assert isinstance(follower.goal, SeekGoal)
    drive(follower, (6.0, 0.0, 0.0), (12.6, 0.0, 0.0))
    follower.look(SCENE, (12.6, 0.0, 0.0))
    assert isinstance(follower.goal, PassGoal)
    drive(follower, (8.0, 0.0, math.pi))
    follower.look(SCENE, (8.0, 0.0, math.pi))
    assert isinstance(follower.goal, PassGoal)


points = st.tuples(st.floats(-3, 3), st.floats(-3, 3))


@given(a=points, b=points, before=points, after=points)
def test_a_door_is_crossed_where_the_step_meets_it(
    a: tuple[float, float],
    b: tuple[float, float],
    before: tuple[float, float],
    after: tuple[float, float],
) -> None:
    door, step = LineString([a, b]), LineString([before, after])
    shapes = [door, step, *map(Point, (a, b, before, after))]
    assume(min(door.length, step.length) > 1e-6)
    assume(min(step.distance(end) for end in shapes[2:4]) > 1e-6)
    assume(min(door.distance(end) for end in shapes[4:]) > 1e-6)
    crossed = first_crossed(np.array([[*a, *b]]), *before, *after) == 0
    assert crossed == door.intersects(step)


@given(before=points, after=points)
def test_a_way_through_and_back_crosses_outward_only_once(
    before: tuple[float, float], after: tuple[float, float]
) -> None:
    goal = PassGoal((0.0, 0.9, QUARTER), Door((-0.5, 0.0), (0.5, 0.0)))
    there = goal.crossed_between((*before, 0.0), (*after, 0.0))
    back = goal.crossed_between((*after, 0.0), (*before, 0.0))
    assert not (there and back)
    assert goal.crossed_between((*before, 1.0), (*before, 2.0)) is False
