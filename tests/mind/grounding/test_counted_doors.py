"""Which doors count, and which of them a clause means: the rules of docs/concepts/commands.md."""

from __future__ import annotations

import math

import pytest

from semnav_env.language import Side
from semnav_env.mind.grounding import GroundingError, PassGoal, ground
from semnav_env.mind.grounding.counted_doors import doors_along
from semnav_env.world.maps import load_floor_plan
from semnav_features.corridor import corridor_at
from semnav_features.frames import Pose
from semnav_features.scene import Door, Scene, Wall
from tests.support.grounded import DOORS, QUARTER, START, clause, goal_of, middle
from tests.support.hand_made import box, corridor


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
    assert isinstance(goal, PassGoal)
    assert isinstance(goal, PassGoal)
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
    assert isinstance(goal, PassGoal)
    assert goal.door.midpoint == pytest.approx((5.0, 1.0))


def test_a_passed_door_counts_while_its_clause_lasts() -> None:
    goal = ground(clause("take the second door on the left"), DOORS, START, (7.0, 0.0, 0.0))
    assert middle(goal) == pytest.approx(5.0)


def test_facing_doors_are_counted_on_their_own_sides_only() -> None:
    scene = corridor(left=(3.0, 6.0), right=(3.0, 6.0))
    for side, y in (("left", 1.0), ("right", -1.0)):
        goal = goal_of(f"go through the second door on the {side}", scene)
        assert isinstance(goal, PassGoal)
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
    lefts = doors_along(scene, corridor_at(scene, START), Side.LEFT)
    assert [round(door.along, 6) for door in lefts] == [2.0, 5.0, 9.0]


def test_a_door_in_a_recess_counts_and_one_in_an_arm_does_not() -> None:
    arm = corridor(left_arms=[(4.0, 6.0)], right=(9.0,))
    for depth, expected in ((1.0, [5.0, 9.0]), (3.0, [9.0])):
        back = (Wall((4.0, 1 + depth), (4.5, 1 + depth)), Wall((5.5, 1 + depth), (6.0, 1 + depth)))
        door = Door((4.5, 1.0 + depth), (5.5, 1.0 + depth))
        scene = Scene(arm.walls + back, (*arm.doors, door))
        counted = doors_along(scene, corridor_at(scene, START))
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


def names(plan: str, pose: Pose, side: Side | None = None) -> list[str | None]:
    scene = load_floor_plan(plan).scene
    return [counted.door.name for counted in doors_along(scene, corridor_at(scene, pose), side)]


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
