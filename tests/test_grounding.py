"""Which door or junction a clause means, and what its goal is: the rules of docs/commands.md."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from semnav_env.commands import Clause, Side, parse
from semnav_env.features.frames import Pose, compose, wrap_angle
from semnav_env.features.hallway import hallway
from semnav_env.features.scene import Door, Scene, Wall
from semnav_env.grounding import Goal, GoalKind, GroundingError, ground
from semnav_env.grounding.doors import doors_along
from semnav_env.maps import load_floor_plan
from tests.hand_made import (
    L_LEFT,
    L_RIGHT,
    ROOM,
    SIDE_ARMS,
    T_JUNCTION,
    X_JUNCTION,
    box,
    corridor,
)

START: Pose = (0.0, 0.0, 0.0)
QUARTER = math.pi / 2
DOORS = corridor(left=(2.0, 5.0, 9.0), right=(5.0, 7.0), end_door=True)


def clause(text: str) -> Clause:
    (only,) = parse(text).clauses
    return only


def goal_of(text: str, scene: Scene, begin: Pose = START, after_hallway: bool = False) -> Goal:
    """The goal on a scene that is wholly known."""
    return ground(clause(text), scene, begin, complete=True, after_hallway=after_hallway)


def middle(goal: Goal) -> float:
    assert goal.door is not None
    return goal.door.midpoint[0]


@pytest.mark.parametrize(
    ("text", "x", "y"),
    [
        ("go through the first door on the left", 2.0, 1.0),
        ("go through the second door on the left", 5.0, 1.0),
        ("go through the last door on the left", 9.0, 1.0),
        ("go through the first door on the right", 5.0, -1.0),
        ("go through the second door on the right", 7.0, -1.0),
        ("go through the door ahead", 14.0, 0.0),
        ("go through the first door", 2.0, 1.0),
        ("go through the fourth door", 7.0, -1.0),
        ("go through the last door", 14.0, 0.0),
    ],
)
def test_doors_count_along_the_way_on_the_named_side(text: str, x: float, y: float) -> None:
    goal = goal_of(text, DOORS)
    assert goal.kind is GoalKind.PASS
    assert goal.door is not None
    assert goal.door.midpoint == pytest.approx((x, y))


@pytest.mark.parametrize(("x", "second"), [(4.9, 7.0), (5.0, 7.0), (5.1, None)])
def test_a_door_counts_while_half_of_its_opening_is_ahead(x: float, second: float | None) -> None:
    begin = (x, 0.3, 0.2)
    first = middle(goal_of("go through the first door on the right", DOORS, begin))
    assert first == pytest.approx(5.0 if second else 7.0)
    if second:
        assert middle(goal_of("go through the second door on the right", DOORS, begin)) == second


def test_counting_the_other_way_takes_the_other_side() -> None:
    goal = goal_of("go through the first door on the right", DOORS, (6.0, 0.0, math.pi))
    assert goal.door is not None
    assert goal.door.midpoint == pytest.approx((5.0, 1.0))


def test_a_door_that_has_been_passed_counts_while_its_clause_lasts() -> None:
    goal = ground(clause("take the second door on the left"), DOORS, START, (7.0, 0.0, 0.0))
    assert middle(goal) == pytest.approx(5.0)


def test_facing_doors_are_counted_on_their_own_sides_only() -> None:
    scene = corridor(left=(3.0, 6.0), right=(3.0, 6.0))
    for side, y in (("left", 1.0), ("right", -1.0)):
        goal = goal_of(f"go through the second door on the {side}", scene)
        assert goal.door is not None
        assert goal.door.midpoint == pytest.approx((6.0, y))


def test_between_facing_doors_one_must_say_which_side() -> None:
    scene = corridor(left=(3.0,), right=(3.1,))
    with pytest.raises(GroundingError, match="there is one left and right there; say on which"):
        goal_of("go through the first door", scene)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            "take the third door on the right",
            "no third door on the right: the hallway ended after 2",
        ),
        (
            "take the fourth door on the left",
            "no fourth door on the left: the hallway ended after 3",
        ),
        ("take the second door ahead", "no second door straight ahead: the hallway ended after 1"),
    ],
)
def test_a_door_that_is_not_there_is_an_error_that_says_what_is(text: str, message: str) -> None:
    with pytest.raises(GroundingError, match=message):
        goal_of(text, DOORS)


def test_a_hallway_without_doors_is_said_to_have_none() -> None:
    with pytest.raises(GroundingError, match=r"^no first door on the left: the hallway has none$"):
        goal_of("go through the first door on the left", corridor())
    with pytest.raises(GroundingError, match=r"^no last door on the right: the hallway has none$"):
        goal_of("go through the last door on the right", corridor())


def test_only_doors_that_open_onto_the_hallway_count() -> None:
    across = Door((3.0, 2.0), (3.0, 3.0))
    behind = Door((6.0, 5.0), (7.0, 5.0))
    beyond = Door((16.0, 1.0), (17.0, 1.0))
    scene = Scene(DOORS.walls, (*DOORS.doors, across, behind, beyond))
    lefts = doors_along(scene, hallway(scene, START), Side.LEFT)
    assert [round(door.along, 6) for door in lefts] == [2.0, 5.0, 9.0]


def test_a_door_in_a_recess_counts_and_one_in_an_arm_does_not() -> None:
    arm = corridor(left_arms=[(4.0, 6.0)], right=(9.0,))
    for depth, expected in ((1.0, [5.0, 9.0]), (3.0, [9.0])):
        back = (Wall((4.0, 1 + depth), (4.5, 1 + depth)), Wall((5.5, 1 + depth), (6.0, 1 + depth)))
        door = Door((4.5, 1.0 + depth), (5.5, 1.0 + depth))
        scene = Scene(arm.walls + back, (*arm.doors, door))
        counted = doors_along(scene, hallway(scene, START))
        assert [round(door.along, 6) for door in counted] == expected


@pytest.mark.parametrize(
    "extra",
    [
        box(3.5, 0.7, 3.9, 1.0),
        box(3.4, 0.5, 4.4, 1.0),
        [Wall((4.55, 1.0), (4.2, 0.3))],
        [Wall((5.45, 1.0), (5.45, 1.9))],
    ],
    ids=["pillar", "cabinet", "half-open leaf in the corridor", "leaf in the room"],
)
def test_what_stands_beside_a_door_does_not_change_the_count(extra: list[Wall]) -> None:
    scene = Scene((*DOORS.walls, *extra), DOORS.doors)
    assert middle(goal_of("go through the second door on the left", scene)) == pytest.approx(5.0)
    assert middle(goal_of("go through the last door on the left", scene)) == pytest.approx(9.0)


def test_through_ends_behind_the_door_and_to_before_it() -> None:
    through = goal_of("go through the first door on the right", DOORS)
    to = goal_of("go to the first door on the right", DOORS)
    assert through.pose == pytest.approx((5.0, -1.9, -QUARTER))
    assert (to.kind, to.pose) == (GoalKind.REACH, pytest.approx((5.0, -0.1, -QUARTER)))
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
    assert goal.kind is GoalKind.REACH
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
def test_after_go_down_the_hallway_a_bare_turn_is_the_next_that_offers_it(
    scene: Scene, turn: str, x: float
) -> None:
    goal = goal_of(f"turn {turn}", scene, after_hallway=True)
    assert goal.pose[0] == pytest.approx(x, abs=0.06)


def test_out_of_a_doorway_one_turns_in_the_hallway_and_does_not_count_that_door() -> None:
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
    assert goal.kind is GoalKind.REACH
    assert goal.pose[:2] == pytest.approx(pose[:2], abs=0.06)
    assert abs(wrap_angle(goal.pose[2] - pose[2])) < 1e-6


def test_until_a_door_leaves_that_door_and_the_facing_one_still_to_count() -> None:
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


def test_what_is_not_seen_yet_is_looked_for_along_the_hallway() -> None:
    near = Scene(tuple(Wall(w.start, (min(w.end[0], 6.0), w.end[1])) for w in corridor().walls[:2]))
    for text in (
        "go through the first door on the right",
        "turn left at the intersection",
        "go to the end of the hallway",
        "follow the hallway until the corner",
    ):
        goal = ground(clause(text), near, START, (1.0, 0.3, 0.4))
        assert goal.kind is GoalKind.SEEK
        assert goal.pose == pytest.approx((5.0, 0.0, 0.0), abs=0.01)
        assert goal.because.startswith("looking for the")


def seen_without_a_door() -> Scene:
    """Doors at 3 and 6 on the left, of which only the second has been recognised."""
    scene = corridor(left=(3.0, 6.0))
    return Scene(scene.walls, scene.doors[1:])


@pytest.mark.parametrize(("progress", "kind"), [(0.0, "SEEK"), (2.0, "SEEK"), (3.2, "PASS")])
def test_while_a_stretch_before_the_door_is_unseen_one_looks_there_first(
    progress: float, kind: str
) -> None:
    text = "go through the first door on the left"
    goal = ground(clause(text), seen_without_a_door(), START, (progress, 0.0, 0.0))
    assert goal.kind.name == kind
    assert goal.pose[0] <= 6.0 + 1e-6


def test_the_last_door_is_known_only_at_the_end() -> None:
    last = clause("go through the last door on the left")
    assert ground(last, DOORS, START, (9.0, 0.0, 0.0)).kind is GoalKind.SEEK
    assert middle(ground(last, DOORS, START, (12.6, 0.0, 0.0))) == pytest.approx(9.0)


def test_a_perceived_door_is_missing_only_when_the_end_has_been_seen() -> None:
    third = clause("go through the third door on the right")
    assert ground(third, DOORS, START, (9.0, 0.0, 0.0)).kind is GoalKind.SEEK
    with pytest.raises(GroundingError, match=r"no third door on the right: .* ended after 2"):
        ground(third, DOORS, START, (12.6, 0.0, 0.0))


def test_looking_goes_on_to_a_place_from_which_the_end_counts_as_seen() -> None:
    goal = ground(clause("take the third door on the right"), DOORS, START, (11.0, 0.0, 0.0))
    with pytest.raises(GroundingError):
        ground(clause("take the third door on the right"), DOORS, START, goal.pose)


def test_at_the_end_a_robot_takes_a_corner_for_the_intersection_it_was_told_of() -> None:
    turn = clause("turn left at the intersection")
    assert ground(turn, L_LEFT, START, (9.0, 0.0, 0.0)).kind is GoalKind.SEEK
    assert ground(turn, L_LEFT, START, (12.6, 0.0, 0.0)).kind is GoalKind.REACH


def test_stop_is_here() -> None:
    assert goal_of("stop", Scene(), (1.0, 2.0, 3.0)).kind is GoalKind.STOP


def names(plan: str, pose: Pose, side: Side | None = None) -> list[str | None]:
    scene = load_floor_plan(plan).scene
    return [counted.door.name for counted in doors_along(scene, hallway(scene, pose), side)]


def test_the_doors_of_the_heidelberg_hallway() -> None:
    start = (-2.5, -0.3, 0.24)
    assert names("heidelberg_hallway", start, Side.RIGHT) == ["south_1", "south_2", "south_3"]
    assert names("heidelberg_hallway", start, Side.LEFT) == []
    scene = load_floor_plan("heidelberg_hallway").scene
    arm = goal_of("turn left at the intersection", scene, start).onward
    assert arm is not None
    assert names("heidelberg_hallway", arm, Side.RIGHT) == ["north"]


@pytest.mark.parametrize(
    ("pose", "side", "expected"),
    [
        (
            (1.3, 9.1, 0.0),
            Side.RIGHT,
            "west_south_1 west_south_2 west_south_3 east_south_1 east_south_3",
        ),
        (
            (1.3, 9.1, 0.0),
            Side.LEFT,
            "west_north_1 west_north_2 west_north_3 east_north_1 east_north_2 east_north_3",
        ),
        (
            (28.6, 9.1, math.pi),
            Side.LEFT,
            "east_south_3 east_south_1 west_south_3 west_south_2 west_south_1",
        ),
        ((15.0, 1.0, QUARTER), None, "south_west south_east north_east north_west"),
        ((26.0, 19.1, math.pi), Side.RIGHT, "bend_north_3 bend_north_2 bend_north_1"),
    ],
)
def test_the_open_doors_of_the_office(pose: Pose, side: Side | None, expected: str) -> None:
    assert names("office_cross", pose, side) == expected.split()


def test_the_hall_of_the_villa() -> None:
    assert names("villa_hall", (-1.0, 4.35, math.pi)) == ["daughter", "parents"]
    assert names("villa_hall", (1.2, 4.0, -QUARTER)) == ["living", "kitchen"]


def test_a_door_is_taken_once_the_robot_has_come_as_near_as_it_can_to_what_may_hide_another() -> (
    None
):
    """From 6 m on no side is seen to the left: a pane of glass, say."""
    scene = corridor(left=(5.0,), end_door=True)
    walls = tuple(w for w in scene.walls if not (w.start[1] == w.end[1] == 1.0 and w.end[0] > 6.0))
    cut = Wall((5.45, 1.0), (6.0, 1.0))
    gappy = Scene((*walls, cut), scene.doors)
    said = clause("go through the second door")
    goals = {
        x: ground(said, gappy, START, pose=(x, 0.0, 0.0)).kind for x in (7.0, 12.0, 12.7, 13.2)
    }
    assert goals == {
        7.0: GoalKind.SEEK,
        12.0: GoalKind.SEEK,
        12.7: GoalKind.PASS,
        13.2: GoalKind.PASS,
    }
