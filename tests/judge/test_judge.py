"""The judge says what happened, by the identity of doors and by places."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from semnav_env.judge import Judge, Motion, Verdict, plan_mission
from semnav_env.judge.verdict import verdicts
from semnav_env.language import parse
from semnav_env.mind.grounding import GroundingError, PassGoal
from semnav_env.world.maps import PlanDoor, load_floor_plan
from semnav_env.world.maps.geodesic import Geodesic
from semnav_features.frames import Pose

PLAN = load_floor_plan("office_cross")
GEODESIC = Geodesic(PLAN)
WEST: Pose = (1.3, 9.1, 0.0)


def judge_of(command: str, start: Pose = WEST) -> Judge:
    return Judge(plan_mission(PLAN, GEODESIC, parse(command), start))


def walk(judge: Judge, *points: tuple[float, float], step: float = 0.1) -> Judge:
    """Move the robot's centre along straight lines, facing the way it goes."""
    x, y = judge.mission.start[:2]
    for px, py in points:
        heading = math.atan2(py - y, px - x)
        for share in np.linspace(0.0, 1.0, max(2, int(math.dist((x, y), (px, py)) / step)))[1:]:
            pose = (x + share * (px - x), y + share * (py - y), heading)
            judge.update(Motion(pose, 1.0, 0.0, in_contact=False, seconds=1 / 15))
        x, y = px, py
    return judge


@pytest.mark.parametrize(
    ("command", "points", "verdicts"),
    [
        ("go through the first door on the right", [(3.4, 9.0), (3.4, 7.0)], ["done"]),
        ("go through the second door on the right", [(3.4, 9.0), (3.4, 7.0)], ["wrong door"]),
        ("go through the first door on the right", [(6.0, 9.0)], ["active"]),
        (
            "turn right at the intersection and go through the first door on the left",
            [(15.0, 9.1), (15.0, 6.5), (15.0, 2.7), (17.0, 2.7)],
            ["done", "done"],
        ),
        ("turn right at the intersection", [(15.0, 9.1), (15.0, 12.5)], ["wrong turn"]),
        ("turn right at the intersection", [(20.0, 9.1)], ["wrong turn"]),
        ("follow the hallway until the intersection", [(15.0, 9.1)], ["done"]),
        ("follow the hallway until the end", [(15.0, 9.1)], ["active"]),
        ("follow the hallway until the end", [(29.0, 9.1)], ["done"]),
    ],
)
def test_walks_are_judged_by_what_was_crossed_and_reached(
    command: str, points: list[tuple[float, float]], verdicts: list[str]
) -> None:
    assert list(walk(judge_of(command), *points).verdicts) == verdicts


def test_verdicts_are_printed_as_plain_words() -> None:
    assert str((Verdict.DONE, Verdict.WRONG_DOOR)) == "('done', 'wrong door')"


def test_the_door_next_to_the_named_one_is_a_failure() -> None:
    judge = walk(judge_of("go through the second door on the right"), (3.4, 9.0), (3.4, 7.0))
    assert judge.over
    assert not judge.success
    assert judge.crossed == ["west_south_1"]


def test_an_opening_too_wide_for_a_door_is_no_wrong_door() -> None:
    gate = PlanDoor("gate", (14.0, 8.0), (14.0, 10.2))
    plan = replace(PLAN, doors=(*PLAN.doors, gate))
    command = parse("follow the hallway until the intersection")
    judge = walk(Judge(plan_mission(plan, GEODESIC, command, WEST)), (15.0, 9.1))
    assert judge.success
    assert judge.crossed == ["gate"]


def test_a_closed_door_is_not_counted() -> None:
    judge = judge_of("go through the second door on the left", (28.6, 9.1, math.pi))
    assert isinstance(judge.mission.goals[0], PassGoal)
    assert judge.mission.goals[0].door.name == "east_south_1"


def test_a_missing_referent_is_answered_with_what_there_is() -> None:
    with pytest.raises(GroundingError, match="after 5"):
        judge_of("go through the ninth door on the right")


def test_contacts_are_counted_when_they_begin() -> None:
    judge = judge_of("go through the first door on the right")
    for touching in (False, True, True, False, True):
        judge.update(Motion(WEST, 0.1, 0.0, touching, 1 / 15))
    assert judge.period.collisions == 2


def test_the_path_is_as_long_as_what_was_driven() -> None:
    judge, (x, y, _) = judge_of("follow the hallway until the end"), WEST
    for dx, dy in ((0.3, 0.0), (0.3, 0.4), (0.0, 0.0)):
        judge.update(Motion((x + dx, y + dy, 0.0), 1.0, 0.0, in_contact=False, seconds=1.0))
    assert judge.period.path_length == pytest.approx(1.2)


def test_standing_still_for_ten_seconds_is_stopping_short() -> None:
    judge = judge_of("go through the first door on the right")
    for _ in range(149):
        judge.update(Motion(WEST, 0.0, 0.0, False, 1 / 15))
    assert not judge.over
    for _ in range(3):
        judge.update(Motion(WEST, 0.0, 0.0, False, 1 / 15))
    assert judge.failure is Verdict.STOPPED_SHORT


def test_standing_still_as_told_is_not_stopping_short_afterwards() -> None:
    judge = judge_of("wait for 15 seconds and go through the first door on the right")
    for _ in range(15 * 15 + 140):
        judge.update(Motion(WEST, 0.0, 0.0, False, 1 / 15))
    assert judge.completed == 1
    assert not judge.over
    for _ in range(20):
        judge.update(Motion(WEST, 0.0, 0.0, False, 1 / 15))
    assert judge.failure is Verdict.STOPPED_SHORT


def test_the_route_leads_through_every_goal_and_is_shortest() -> None:
    judge = judge_of("turn right at the intersection and go through the first door on the left")
    assert judge.mission.route[0] == pytest.approx(WEST[:2])
    assert judge.mission.route[-1] == pytest.approx((16.0, 2.7))
    walk(judge, (15.0, 9.1), (15.0, 2.7), (16.3, 2.7))
    assert judge.mission.route_length <= 1.09 * (13.7 + 6.4 + 1.3)


def test_the_remaining_way_shrinks_to_zero() -> None:
    judge = Judge(judge_of("go through the first door on the right").mission)
    lengths = [judge.remaining]
    for x, y in ((2.4, 9.0), (3.4, 8.8), (3.4, 8.3)):
        judge.update(Motion((x, y, 0.0), 1.0, 0.0, False, 1.0))
        lengths.append(judge.remaining)
    assert lengths == sorted(lengths, reverse=True)
    judge.update(Motion((3.4, 7.9, 0.0), 1.0, 0.0, False, 1.0))
    assert judge.success
    assert judge.remaining == 0.0


def test_a_failure_shows_even_with_the_last_clause_done() -> None:
    assert verdicts(2, 2, Verdict.WRONG_DOOR) == (Verdict.DONE, Verdict.WRONG_DOOR)
    assert verdicts(2, 2, None) == (Verdict.DONE, Verdict.DONE)
    assert verdicts(2, 1, Verdict.WRONG_TURN) == (Verdict.DONE, Verdict.WRONG_TURN)
    assert verdicts(2, 0, None) == (Verdict.ACTIVE, Verdict.PENDING)
    assert verdicts(0, 0, None) == ()


def test_the_branch_not_taken_is_skipped_and_never_fails() -> None:
    skips = frozenset({2})
    assert verdicts(3, 3, None, skips) == (Verdict.DONE, Verdict.DONE, Verdict.SKIPPED)
    assert verdicts(3, 3, Verdict.WRONG_DOOR, skips) == (
        Verdict.DONE,
        Verdict.WRONG_DOOR,
        Verdict.SKIPPED,
    )


@pytest.mark.parametrize(
    ("command", "points", "verdicts"),
    [
        (
            "if you see an intersection, turn right, otherwise turn around",
            [(15.0, 9.1), (15.0, 6.5)],
            ["done", "done", "skipped"],
        ),
        (
            "if you do not see an intersection, turn around, otherwise turn right at the "
            "intersection",
            [(15.0, 9.1), (15.0, 6.5)],
            ["done", "skipped", "done"],
        ),
    ],
)
def test_the_clause_of_the_other_branch_is_skipped(
    command: str, points: list[tuple[float, float]], verdicts: list[str]
) -> None:
    judge = walk(judge_of(command), *points)
    assert list(judge.verdicts) == verdicts
    assert judge.success


def test_the_verdict_is_that_of_the_deciding_clause() -> None:
    judge = judge_of("go through the second door on the right")
    assert judge.verdict is Verdict.ACTIVE
    assert walk(judge, (3.4, 9.0), (3.4, 7.0)).verdict is Verdict.WRONG_DOOR


def test_a_referent_missing_from_the_plan_is_refused() -> None:
    """Where there are no walls, there is no end of a corridor to be seen on the plan."""
    plan = replace(load_floor_plan("villa_hall"), surfaces=(), doors=())
    start: Pose = (1.0, 2.0, 1.5)
    command = "go down the hallway until the end of the hallway"
    with pytest.raises(GroundingError, match="the end of the hallway: the floor plan shows none"):
        Judge(plan_mission(plan, Geodesic(plan), parse(command), start))


def test_a_corner_outside_the_building_is_refused() -> None:
    """Across the hall of the villa its side arm looks like a room that opens to the left."""
    plan = load_floor_plan("villa_hall")
    with pytest.raises(GroundingError, match="leads out of villa_hall"):
        plan_mission(plan, Geodesic(plan), parse("turn left at the corner"), (1.58, 2.02, -2.98))


def test_after_a_stop_the_next_clause_begins_where_the_stop_did() -> None:
    """It does not matter where the robot stands."""
    judge = judge_of("go down the hallway for 3 metres, stop and turn left")
    walk(judge, (3.6, 9.6))
    judge.update(Motion((3.6, 9.6, 0.0), 0.0, 0.0, in_contact=False, seconds=1 / 15))
    assert [str(verdict) for verdict in judge.verdicts] == ["done", "done", "active"]
    assert judge.follower.goal.pose == pytest.approx(judge.mission.goals[-1].pose)


def test_a_door_that_opens_later_is_still_a_wrong_door() -> None:
    """It may have been opened since; a way through it was not asked for."""
    judge = judge_of("go through the first door on the left", (28.6, 9.1, math.pi))
    assert not PLAN.door("east_south_2").open
    assert walk(judge, (23.0, 9.0), (23.0, 7.0)).verdict is Verdict.WRONG_DOOR
