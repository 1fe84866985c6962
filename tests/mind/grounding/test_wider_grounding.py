"""Where past, distances, turnings, counting from the end and leaving lead."""

from __future__ import annotations

import math

import pytest

from semnav_env.language import parse
from semnav_env.mind.grounding import Goal, GroundingError, PassGoal, SeekGoal, ground
from semnav_env.mind.grounding.follower import Follower
from semnav_env.mind.grounding.goal import door_of
from semnav_features.frames import Pose
from semnav_features.scene import Scene
from tests.support.hand_made import L_LEFT, SIDE_ARMS, T_JUNCTION, X_JUNCTION, corridor

START: Pose = (0.0, 0.0, 0.0)
QUARTER = math.pi / 2
DOORS = corridor(left=(2.0, 5.0, 9.0), right=(5.0, 7.0))


def goals_of(text: str, scene: Scene, start: Pose = START) -> list[Goal]:
    """The goals of a command on a scene that is wholly known, each from where the last leads."""
    follower = Follower(parse(text), complete=True)
    follower.start(scene, start)
    goals = []
    while not follower.done:
        if follower.impossible is not None:
            raise GroundingError(follower.impossible)
        goals.append(follower.goal)
        follower.skip_to_next(scene)
    return goals


def last_goal(text: str, scene: Scene, start: Pose = START) -> Goal:
    return goals_of(text, scene, start)[-1]


def door_in(text: str, scene: Scene = DOORS) -> tuple[float, float]:
    door = door_of(last_goal(text, scene))
    assert door is not None
    return door.midpoint


@pytest.mark.parametrize(
    ("text", "x", "y"),
    [
        ("take the second-to-last door on the left", 5.0, 1.0),
        ("take the third door from the end on the left", 2.0, 1.0),
        ("take the second-to-last door on the right", 5.0, -1.0),
        ("go past the first door on the left and take the first door on the left", 5.0, 1.0),
        ("go past two doors on the left and take the next door on the left", 9.0, 1.0),
        ("go past the first door on the right and take the first door on the right", 7.0, -1.0),
        ("go 3 metres and take the first door on the left", 5.0, 1.0),
        ("go ten steps and take the first door on the left", 9.0, 1.0),
    ],
)
def test_counting_from_the_end_and_from_farther_on(text: str, x: float, y: float) -> None:
    assert door_in(text) == pytest.approx((x, y))


def test_until_a_door_it_still_counts_and_past_it_no_longer() -> None:
    take = "take the first door on the left"
    assert door_in(f"go down the hallway until the first door on the left and {take}")[0] == 2.0
    assert door_in(f"go past the first door on the left and {take}")[0] == 5.0


def test_the_other_door_is_the_only_one() -> None:
    one = corridor(left=(6.0,))
    assert door_in("take the other door", one) == pytest.approx((6.0, 1.0))
    with pytest.raises(GroundingError, match="the other door on the left: there are 3; say which"):
        door_in("take the other door on the left")
    with pytest.raises(GroundingError, match="no other door on the right: the hallway has none"):
        door_in("take the other door on the right", one)


def test_the_last_door_is_sought_until_the_end_is_seen() -> None:
    (clause,) = parse("take the second-to-last door on the left").clauses
    assert isinstance(ground(clause, DOORS, START, (4.0, 0.0, 0.0)), SeekGoal)
    assert isinstance(ground(clause, DOORS, START, (12.6, 0.0, 0.0)), PassGoal)


@pytest.mark.parametrize(("text", "along"), [("go 3 m", 3.0), ("go five steps", 3.5)])
def test_a_distance_is_told_from_where_the_clause_begins(text: str, along: float) -> None:
    assert last_goal(text, DOORS).pose == pytest.approx((along, 0.0, 0.0), abs=0.05)


def test_a_distance_beyond_the_end_is_refused_with_the_end() -> None:
    with pytest.raises(GroundingError, match=r"40 metres ahead: the hallway ends after 14\.\d m"):
        last_goal("go 40 metres", DOORS)


@pytest.mark.parametrize("degrees", [5, 45, 90, 135, 180])
@pytest.mark.parametrize(("side", "sign"), [("left", 1.0), ("right", -1.0)])
def test_a_turn_by_degrees_is_made_on_the_spot(degrees: int, side: str, sign: float) -> None:
    goal = last_goal(f"turn {side} by {degrees} degrees", X_JUNCTION, (3.0, 0.2, 0.1))
    turned = math.remainder(goal.pose[2] - 0.1 - sign * math.radians(degrees), math.tau)
    assert turned == pytest.approx(0.0, abs=1e-9)
    assert goal.pose[:2] == pytest.approx((3.0, 0.2))


@pytest.mark.parametrize(
    ("text", "scene", "x"),
    [
        ("take the first right", SIDE_ARMS, 9.0),
        ("take the first left", X_JUNCTION, 7.0),
        ("take the first left", L_LEFT, 13.0),
        ("turn left at the last turning", T_JUNCTION, 13.0),
        ("turn left at the T-junction", T_JUNCTION, 13.0),
        ("go past the first door on the left and turn left", X_JUNCTION, 7.0),
    ],
)
def test_a_turning_is_whatever_leads_to_that_side(text: str, scene: Scene, x: float) -> None:
    if "door" in text:
        scene = corridor(left=(2.0,), left_arms=[(6.0, 8.0)])
    assert last_goal(text, scene).pose[0] == pytest.approx(x, abs=0.06)


def test_a_crossing_and_a_bend_are_no_t_junctions() -> None:
    for scene in (X_JUNCTION, L_LEFT):
        with pytest.raises(GroundingError, match="no first T-junction that leads left"):
            last_goal("turn left at the T-junction", scene)


def test_one_cannot_go_past_the_end() -> None:
    with pytest.raises(GroundingError, match="does not go on behind the first T-junction"):
        last_goal("go past the T-junction", T_JUNCTION)


@pytest.mark.parametrize("between", ["", "turn around, "])
def test_one_leaves_a_room_by_the_door_one_came_by(between: str) -> None:
    entered, *_, left = goals_of(f"take the first door on the left, {between}leave the room", DOORS)
    assert isinstance(left, PassGoal)
    assert left.door == entered.door
    assert left.pose[2] == pytest.approx(-QUARTER, abs=0.05)
    assert left.pose[1] < 1.0 < entered.pose[1]


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("leave the room", "by which door"),
        ('go to room "kitchen"', "not been told the way"),
    ],
)
def test_an_infeasible_command_is_refused(text: str, reason: str) -> None:
    with pytest.raises(GroundingError, match=reason):
        last_goal(text, DOORS)
