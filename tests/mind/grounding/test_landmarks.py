"""Doorways to stop in, things to face, and rooms as landmarks."""

import math

import pytest

from semnav_env.judge import plan_goals
from semnav_env.language import parse
from semnav_env.mind.grounding import GroundingError, ReachGoal, ground
from semnav_env.world.maps import load_floor_plan
from tests.support.situations import situation

PLAN = load_floor_plan("office_cross")
START = (1.3, 9.1, 0.0)
DOOR = "the second door on the right"


def goal_of(text: str):
    (goal,) = plan_goals(PLAN, parse(text), START)
    return goal


def test_one_stops_in_the_middle_of_a_doorway() -> None:
    inside, through = goal_of(f"stop in {DOOR}"), goal_of(f"go through {DOOR}")
    assert isinstance(inside, ReachGoal)
    assert inside.pose[:2] == pytest.approx(through.door.midpoint)
    assert not inside.reached_by(goal_of(f"go to {DOOR}").pose)


def test_facing_a_door_turns_towards_it_on_the_spot() -> None:
    goal = goal_of(f"face {DOOR}")
    x, y = goal_of(f"go through {DOOR}").door.midpoint
    assert goal.pose[:2] == START[:2]
    assert goal.pose[2] == pytest.approx(math.atan2(y - START[1], x - START[0]))


@pytest.mark.parametrize(("side", "sign"), [("left", 1), ("right", -1)])
def test_a_wall_comes_to_lie_on_the_side_that_is_named(side: str, sign: int) -> None:
    goal = goal_of(f"turn so that the wall is on the {side}")
    assert abs(math.sin(goal.pose[2])) < 0.1 or abs(math.cos(goal.pose[2])) < 0.1
    assert goal.pose[:2] == START[:2]


def test_a_room_can_be_gone_up_to_and_past() -> None:
    room = PLAN.room_names[0]
    texts = [f'go down the hallway until room "{room}"', f'go down the hallway past room "{room}"']
    until, past = (plan_goals(PLAN, parse(text), START)[0] for text in texts)
    assert isinstance(until, ReachGoal)
    assert 0.3 < math.dist(until.pose[:2], past.pose[:2]) < 1.0


def test_in_front_of_a_room_one_faces_its_door() -> None:
    room = PLAN.room_names[0]
    (front,) = plan_goals(PLAN, parse(f'stop in front of room "{room}"'), START)
    (inside,) = plan_goals(PLAN, parse(f'go to room "{room}"'), START)
    assert isinstance(front, ReachGoal)
    assert math.dist(front.pose[:2], inside.door.midpoint) == pytest.approx(0.9, abs=0.05)


def test_a_room_is_no_landmark_for_who_has_not_been_told_the_way() -> None:
    (clause,) = parse('go down the hallway past room "attic"').clauses
    with pytest.raises(GroundingError, match="has not been told the way"):
        ground(clause, PLAN.scene, START, complete=True)


def test_past_a_corner_leads_around_it() -> None:
    around, turned = (
        plan_goals(situation("left bend"), parse(text), (0.0, 0.0, 0.0))[0]
        for text in ("go around the corner", "turn left at the corner")
    )
    assert around.pose == turned.pose
