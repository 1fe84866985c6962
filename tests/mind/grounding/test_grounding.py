"""Where the goal of a clause lies: the rules of docs/concepts/commands.md."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from semnav_env.mind.grounding import GroundingError, ReachGoal, StopGoal, ground
from semnav_features.frames import Pose, compose, wrap_angle
from semnav_features.scene import Door, Scene, Wall
from tests.support.grounded import DOORS, QUARTER, START, clause, goal_of, middle
from tests.support.hand_made import (
    L_LEFT,
    L_RIGHT,
    ROOM,
    SIDE_ARMS,
    T_JUNCTION,
    X_JUNCTION,
    corridor,
)


def test_through_ends_behind_the_door_and_to_before_it() -> None:
    through = goal_of("go through the first door on the right", DOORS)
    to = goal_of("go to the first door on the right", DOORS)
    assert through.pose == pytest.approx((5.0, -1.9, -QUARTER))
    assert isinstance(to, ReachGoal)
    assert to.pose == pytest.approx((5.0, -0.1, -QUARTER))
    assert through.onward == pytest.approx((5.0, -1.0, -QUARTER))


def test_in_a_room_the_door_ahead_is_in_the_wall_one_looks_at() -> None:
    goal = goal_of("go through the door ahead", ROOM)
    assert goal.pose == pytest.approx((4.9, 0.0, 0.0))


@pytest.mark.parametrize(
    ("text", "scene", "mouth"),
    [
        ("turn left at the intersection", X_JUNCTION, (7.0, 1.0, QUARTER)),
        ("turn right at the intersection", X_JUNCTION, (7.0, -1.0, -QUARTER)),
        ("turn left at the intersection", T_JUNCTION, (13.0, 1.0, QUARTER)),
        ("turn right at the end", T_JUNCTION, (13.0, -1.0, -QUARTER)),
        ("turn left at the corner", L_LEFT, (13.0, 1.0, QUARTER)),
        ("turn left at the end", L_LEFT, (13.0, 1.0, QUARTER)),
        ("turn right at the corner", L_RIGHT, (13.0, -1.0, -QUARTER)),
        ("turn right at the first intersection", SIDE_ARMS, (9.0, -1.0, -QUARTER)),
    ],
)
def test_a_turn_ends_a_metre_inside_the_arm(text: str, scene: Scene, mouth: Pose) -> None:
    goal = goal_of(text, scene)
    assert isinstance(goal, ReachGoal)
    assert goal.onward == pytest.approx(mouth, abs=0.06)
    assert goal.pose == pytest.approx(compose(mouth, (1.0, 0.0, 0.0)), abs=0.06)


@pytest.mark.parametrize(
    ("text", "scene", "message"),
    [
        ("turn left at the corner", X_JUNCTION, "no first corner that leads left: .* has none"),
        ("turn left at the intersection", L_LEFT, "no first intersection that leads left: .* none"),
        ("turn right at the corner", L_LEFT, "no first corner that leads right: .* has none"),
        ("turn left at the second intersection", SIDE_ARMS, "ended after 1"),
        ("turn left at the end", X_JUNCTION, "no end of the hallway that leads left: .* has none"),
        ("go down the hallway until the third intersection", SIDE_ARMS, "ended after 2"),
    ],
)
def test_a_junction_that_is_not_there_is_an_error(text: str, scene: Scene, message: str) -> None:
    with pytest.raises(GroundingError, match=message):
        goal_of(text, scene)


def test_a_bare_turn_is_made_here() -> None:
    begin = (3.0, 0.2, 0.1)
    goal = goal_of("turn left", X_JUNCTION, begin)
    assert goal.pose == pytest.approx((3.0, 0.2, 0.1 + QUARTER))


@pytest.mark.parametrize(
    ("scene", "turn", "x"),
    [(SIDE_ARMS, "left", 4.0), (SIDE_ARMS, "right", 9.0), (L_LEFT, "left", 13.0)],
)
def test_after_follow_a_bare_turn_is_at_the_next_opening(scene: Scene, turn: str, x: float) -> None:
    """After "go down the hallway", "turn left" means the next opening to the left."""
    goal = goal_of(f"turn {turn}", scene, after_corridor=True)
    assert goal.pose[0] == pytest.approx(x, abs=0.06)


def test_out_of_a_doorway_the_own_door_does_not_count() -> None:
    scene = corridor(left=(5.0, 8.0), right=(2.0,))
    doorway = (5.0, 1.0, -QUARTER)
    goal = goal_of("turn left", scene, doorway)
    assert goal.pose == pytest.approx((5.0, 0.0, 0.0), abs=0.01)
    assert goal.onward is not None
    assert middle(goal_of("take the first door on the left", scene, goal.onward)) == 8.0


@pytest.mark.parametrize(
    ("text", "scene", "pose"),
    [
        ("go down the hallway", DOORS, (13.0, 0.0, 0.0)),
        ("go to the end of the hallway", T_JUNCTION, (13.0, 0.0, 0.0)),
        ("follow the hallway until the intersection", X_JUNCTION, (7.0, 0.0, 0.0)),
        ("follow the hallway until the second intersection", SIDE_ARMS, (9.0, 0.0, 0.0)),
        ("follow the hallway until the second door on the left", DOORS, (4.7, 0.0, 0.0)),
        ("follow the hallway until the door ahead", DOORS, (13.0, 0.0, 0.0)),
        ("turn around at the intersection", X_JUNCTION, (7.0, 0.0, math.pi)),
    ],
)
def test_how_far_the_hallway_is_followed(text: str, scene: Scene, pose: Pose) -> None:
    goal = goal_of(text, scene)
    assert isinstance(goal, ReachGoal)
    assert goal.pose[:2] == pytest.approx(pose[:2], abs=0.06)
    assert abs(wrap_angle(goal.pose[2] - pose[2])) < 1e-6


def test_until_a_door_leaves_it_and_the_facing_one_ahead() -> None:
    """Both still count for the clause that comes after "until the door"."""
    scene = corridor(left=(3.0, 6.0), right=(6.0,))
    there = goal_of("follow the hallway until the second door on the left", scene).pose
    assert middle(goal_of("take the first door on the left", scene, there)) == 6.0
    assert middle(goal_of("take the first door on the right", scene, there)) == 6.0


frames = st.tuples(st.floats(-20, 20), st.floats(-20, 20), st.floats(-math.pi, math.pi))
begins = st.tuples(st.floats(-0.9, 0.9), st.floats(-0.4, 0.4), st.floats(-0.5, 0.5))
questions = st.sampled_from(
    [
        ("go through the second door on the left", DOORS),
        ("go to the first door on the right", DOORS),
        ("turn left at the intersection", T_JUNCTION),
        ("turn right at the intersection", SIDE_ARMS),
        ("go to the end of the hallway", L_LEFT),
    ]
)


@given(question=questions, begin=begins, frame=frames)
def test_moving_scene_and_pose_moves_the_goal(
    question: tuple[str, Scene], begin: Pose, frame: Pose
) -> None:
    text, scene = question
    here, there = (
        goal_of(text, scene, begin),
        goal_of(text, scene.placed(frame), compose(frame, begin)),
    )
    expected = compose(frame, here.pose)
    assert here.kind is there.kind
    assert math.dist(expected[:2], there.pose[:2]) < 0.12
    assert abs(wrap_angle(expected[2] - there.pose[2])) < 0.02


@given(side=st.sampled_from(["left", "right"]), nth=st.sampled_from(["first", "second"]), x=begins)
def test_mirroring_the_scene_mirrors_the_goal(side: str, nth: str, x: Pose) -> None:
    scene, other = corridor(left=(3, 6), right=(4, 8)), corridor(left=(4, 8), right=(3, 6))
    opposite = {"left": "right", "right": "left"}[side]
    here = goal_of(f"go through the {nth} door on the {side}", scene, x)
    there = goal_of(f"go through the {nth} door on the {opposite}", other, (x[0], -x[1], -x[2]))
    assert there.pose == pytest.approx((here.pose[0], -here.pose[1], -here.pose[2]), abs=1e-6)


def test_stop_is_here() -> None:
    assert isinstance(goal_of("stop", Scene(), (1.0, 2.0, 3.0)), StopGoal)


def test_a_door_without_width_is_named_where_its_line_is_asked_for() -> None:
    hall = (Wall((0.0, 1.0), (9.0, 1.0)), Wall((0.0, -1.0), (9.0, -1.0)))
    doors = (Door((2.0, 1.0), (2.0, 1.0)), Door((4.0, 1.0), (5.0, 1.0)))
    with pytest.raises(ValueError, match=r"the door at \(2.0, 1.0\) has no width"):
        ground(clause("leave the room"), Scene(hall, doors), START)
