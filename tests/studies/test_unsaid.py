"""What goes without saying: leaving the room that one is in."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest

from semnav_env.env import SemNavEnv
from semnav_env.judge import plan_goals
from semnav_env.judge.tasks.implicit import with_implicit_steps
from semnav_env.language import Leave, parse
from semnav_env.mind.grounding import GroundingError, PassGoal, ground
from semnav_env.mind.grounding.room_exits import room_exits
from semnav_env.mind.grounding.visible_doors import doors_around
from semnav_env.world.maps import load_floor_plan
from semnav_features.frames import Pose
from semnav_features.scene import Door, Scene, Wall
from studies.__main__ import STUDIES
from studies.unsaid.unsaid import follow, unsaid_trials

PLAN = load_floor_plan("office_cross")
WEST: Pose = (1.3, 9.1, 0.0)


def inside(room: str, heading: float = 1.0) -> Pose:
    middle = PLAN.region(room).polygon.centroid
    return middle.x, middle.y, heading


def test_the_nearest_wall_with_a_door_counts() -> None:
    """Not all walls are seen here."""
    here: Pose = (0.0, 0.0, 0.0)
    near, across = Door((2.0, 0.5), (2.0, 1.5)), Door((5.0, -0.5), (5.0, 0.5))
    beside = Door((-1.0, -3.0), (0.0, -3.0))
    assert room_exits([near, across], Scene((), ()), here) == [near]
    assert room_exits([across, near, beside], Scene((), ()), here) == [near, beside]
    assert room_exits([across], Scene((), ()), here) == [across]
    wall = Wall((6.5, -9.0), (6.5, 9.0))
    cupboard = Door((0.5, -2.0), (-0.5, -2.0))
    assert room_exits([near, cupboard], Scene((wall,), ()), here) == [near]
    close = Wall((-3.0, -2.6), (3.0, -2.6))
    assert room_exits([near, cupboard], Scene((close,), ()), here) == [near]
    assert room_exits([cupboard], Scene((close,), ()), here) == [cupboard]
    assert room_exits([cupboard], Scene((Wall((-3.0, -3.2), (3.0, -3.2)),), ()), here) != []
    goal = ground(Leave(), Scene((), (across, near)), here)
    assert goal.door == near
    with pytest.raises(GroundingError, match="by which door"):
        ground(Leave(), Scene((), (across, near)), here, complete=True)


@pytest.mark.parametrize(
    ("said", "fuller"),
    [
        ("go through the third door on the left", "leave the room, turn left and {}"),
        ("turn around", "turn around"),
        ('go to room "kitchen"', 'go to room "kitchen"'),
    ],
)
def test_the_room_is_left_and_the_named_side_taken(said: str, fuller: str) -> None:
    wanted = parse(fuller.format(said))
    found = with_implicit_steps(parse(said), lambda each: each == wanted, in_room=True)
    assert found == wanted


def test_feasible_and_hopeless_commands_stay_as_they_are() -> None:
    """No step is inferred for a feasible command, nor where none helps."""
    command = parse("go through the first door on the left")
    for in_room in (True, False):
        assert with_implicit_steps(command, lambda _: True, in_room=in_room) == command
        assert with_implicit_steps(command, lambda _: False, in_room=in_room) == command


def test_in_the_hallway_nothing_is_left() -> None:
    command = parse("go through the third door on the left")
    found = with_implicit_steps(command, lambda each: each != command, in_room=False)
    assert found == command


def test_after_going_in_the_room_is_left_before_the_next_door() -> None:
    command = parse(
        "go through the first door on the left and go through the second door on the right"
    )
    found = with_implicit_steps(command, lambda each: each != command, in_room=False)
    assert str(found) == (
        "go through the first door on the left, leave the room, turn right and "
        "go through the second door on the right"
    )


def test_where_both_sides_fit_both_are_said() -> None:
    command = parse("turn left at the intersection")
    with pytest.raises(GroundingError, match=r"turn left and turn left .* or .*turn right and"):
        with_implicit_steps(command, lambda each: each != command, in_room=True)


@pytest.mark.parametrize("heading", [0.0, 2.0, math.pi, -1.0])
def test_one_leaves_a_room_by_its_only_door(heading: float) -> None:
    pose = inside("room_west_south_1", heading)
    (goal,) = plan_goals(PLAN, parse("leave the room"), pose)
    assert isinstance(goal, PassGoal)
    assert goal.door.name == "west_south_1"
    assert goal.pose[1] > goal.door.midpoint[1]
    assert [door.name for door in doors_around(PLAN.scene, pose)] == ["west_south_1"]


def test_where_several_doors_are_in_view_one_does_not_choose() -> None:
    assert len(doors_around(PLAN.scene, WEST)) > 1
    with pytest.raises(GroundingError, match="by which door"):
        plan_goals(PLAN, parse("leave the room"), WEST)


def test_an_episode_echoes_the_steps_or_goes_without() -> None:
    env = SemNavEnv("wheelchair", PLAN)
    options = {"command": "enter the second door on the right", "pose": inside("room_west_south_1")}
    _, info = env.reset(seed=0, options=options)
    assert info["command"].startswith("leave the room, turn right and go through the second door")
    with pytest.raises(GroundingError):
        env.reset(seed=0, options={**options, "implicit_steps": False})


def test_more_is_understood_with_the_steps_than_without() -> None:
    env = SemNavEnv("wheelchair", PLAN, observation="truth")
    trials = unsaid_trials(PLAN, env.robot, np.random.default_rng(1))
    assert len(trials) > 20
    chosen = trials[:: len(trials) // 10]
    known = [follow(env, t, None, 0, implicit_steps=True).understood for t in chosen]
    literal = [follow(env, t, None, 0, implicit_steps=False).understood for t in chosen]
    assert sum(known) > sum(literal)


def test_the_ablation_is_printed(capsys: pytest.CaptureFixture[str]) -> None:
    assert STUDIES.main(["unsaid", "--trials", "3", "--json"]) == 0
    rows = json.loads(capsys.readouterr().out.splitlines()[-1])
    assert set(rows) == {"with implicit steps", "without"}
    assert rows["without"]["commands"] == 3


def test_without_a_door_in_view_the_robot_turns_to_look() -> None:
    (clause,) = parse("leave the room").clauses
    begin = (2.0, 1.0, 0.5)
    goal = ground(clause, Scene((), ()), begin)
    assert goal.pose == pytest.approx((2.0, 1.0, 0.5 - math.pi))
    assert not goal.reached_by(begin)
    with pytest.raises(GroundingError, match="by which door"):
        ground(clause, Scene((), ()), begin, complete=True)
