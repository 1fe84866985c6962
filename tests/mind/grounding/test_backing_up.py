"""Backing up is grounded behind the robot, judged there, and driven without a turn."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from semnav_agents.base import steps
from semnav_agents.registry import make_agent
from semnav_env import SemNavEnv
from semnav_env.language import (
    AmbiguousCommandError,
    BackUp,
    Command,
    Distance,
    decode,
    encode,
    parse,
)
from semnav_env.mind.grounding import GroundingError, ground
from semnav_env.mind.grounding.backing_up import LANE, room_behind
from semnav_features.frames import ORIGIN, compose
from semnav_features.scene import Scene, Wall

headings = st.floats(-math.pi, math.pi)


def wall(x1: float, y1: float, x2: float, y2: float) -> Wall:
    return Wall((x1, y1), (x2, y2))


@pytest.mark.parametrize(
    ("walls", "room"),
    [
        ((), math.inf),
        ((wall(-3.0, -1.0, -3.0, 1.0),), 3.0),
        ((wall(3.0, -1.0, 3.0, 1.0),), math.inf),
        ((wall(-3.0, 1.0, -3.0, LANE + 0.01),), math.inf),
        ((wall(-3.0, 1.0, -3.0, LANE - 0.01),), 3.0),
        ((wall(-4.0, 0.0, -2.0, 0.0),), 2.0),
        ((wall(-3.0, -1.0, -1.0, 1.0),), 2.0 - LANE),
        ((wall(-3.0, -1.0, -3.0, 1.0), wall(-2.0, 1.0, -2.0, -1.0)), 2.0),
    ],
)
@given(heading=headings)
def test_the_room_behind_ends_at_the_nearest_wall_in_the_lane(
    walls: tuple[Wall, ...], room: float, heading: float
) -> None:
    frame = (1.0, -2.0, heading)
    assert room_behind(Scene(walls).placed(frame), frame) == pytest.approx(room)


@given(st.integers(1, 20), headings)
def test_the_goal_lies_as_far_behind_as_is_said(halves: int, heading: float) -> None:
    begin, distance = (2.0, 1.0, heading), Distance(halves / 2)
    goal = ground(BackUp(distance), Scene(), begin)
    assert goal.pose == pytest.approx(compose(begin, (-distance.metres, 0.0, 0.0)))
    assert not goal.reached_by(begin)
    assert goal.reached_by(goal.pose)


def test_nobody_backs_up_into_a_wall() -> None:
    scene = Scene((wall(-2.0, -1.0, -2.0, 1.0),))
    with pytest.raises(GroundingError, match=r"there is a wall 2\.0 m behind"):
        ground(BackUp(Distance(1.5)), scene, ORIGIN)
    assert ground(BackUp(Distance(1.0)), scene, ORIGIN).pose == (-1.0, 0.0, 0.0)


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        ("reverse two metres", "back up for 2 metres"),
        ("go two metres backwards", "back up for 2 metres"),
        ("drive 3 steps in reverse, then turn left", "back up for 3 steps and turn left"),
        ("fahr zwei Meter rückwärts", "back up for 2 metres"),
        ("zwei Meter rückwärts fahren", "back up for 2 metres"),
        ("setz einen Meter zurück", "back up for 1 metre"),
    ],
)
def test_only_a_distance_backwards_is_backed_up(text: str, meant: str) -> None:
    assert str(parse(text)) == meant


def test_who_goes_back_some_metres_is_asked_whether_to_turn_round() -> None:
    with pytest.raises(AmbiguousCommandError) as asked:
        parse("go back for two metres")
    ways = ("turn around and go down the hallway for 2 metres", "back up for 2 metres")
    assert set(asked.value.readings) == set(map(parse, ways))


@given(st.integers(1, 20))
def test_a_token_of_backing_up_is_decoded(halves: int) -> None:
    command = Command((BackUp(Distance(halves / 2)),))
    assert decode(encode(command)) == command == parse(command.say("de"), "de")


@pytest.mark.parametrize("far", [10.5, 50.0])
def test_nobody_backs_up_through_the_whole_building(far: float) -> None:
    with pytest.raises(ValueError, match="at most 10 metres"):
        BackUp(Distance(far))


@pytest.mark.parametrize("robot", ["wheelchair", "spot"])
def test_a_robot_backs_up_without_turning(robot: str) -> None:
    agent = make_agent("scripted")
    env = SemNavEnv(robot, "office_cross", observation=agent.observation)
    for text in ("back up 2 metres", "go through the first door on the left and back up 1 metre"):
        observation, info = env.reset(seed=3, options={"command": text})
        headings = []
        for step in steps(env, agent, observation, info):
            if step.info["verdicts"][-1] == "active":
                headings.append(env.world.pose[2])
            info = step.info
        assert info["is_success"], (text, info["verdicts"])
        assert info["collisions"] == 0
        if text.startswith("back"):
            assert np.ptp(np.unwrap(headings)) < 0.5
    env.close()


@pytest.mark.parametrize("text", ["reverse two metres", "fahr zwei Meter rückwärts"])
def test_backing_up_is_not_doubted(text: str) -> None:
    assert str(parse(text)) == "back up for 2 metres"
