"""The door we came in by is the one through which the robot came last, wherever it went since."""

import math

import pytest

from semnav_agents.base import steps
from semnav_agents.registry import make_agent
from semnav_env import SemNavEnv
from semnav_env.language import (
    ENTRY,
    Approach,
    Command,
    DoorReference,
    Face,
    Follow,
    GoToDoor,
    IfThere,
    Leave,
    Side,
    decode,
    encode,
    from_program,
    parse,
    to_program,
)
from semnav_env.language.corpora.meanings import meaning_of, normal
from semnav_env.language.corpora.notation import notation_of, read_meaning
from semnav_env.mind.grounding import GroundingError, ground
from semnav_env.mind.grounding.behind import find_entry
from semnav_env.mind.grounding.goal import PassGoal
from semnav_env.mind.grounding.situation import Situation
from semnav_features.frames import ORIGIN
from semnav_features.scene import Door, Scene

DOOR = DoorReference(ENTRY)
THROUGH, TO, FACE = GoToDoor(DOOR), GoToDoor(DOOR, Approach.TO), Face(DOOR)


@pytest.mark.parametrize(
    ("text", "clause"),
    [
        ("go out the door we came in by", THROUGH),
        ("leave by the door you came in through", THROUGH),
        ("go back through the door we entered through", THROUGH),
        ("exit through the door by which you entered", THROUGH),
        ("go to the door we came in by", TO),
        ("go back to the door we came in by", TO),
        ("face the door you came through", FACE),
        ("turn towards the door you came in by", FACE),
        ("stop in the doorway we came through", GoToDoor(DOOR, Approach.IN)),
        ("geh durch die Tür, durch die wir gekommen sind", THROUGH),
        ("verlass den Raum durch die Tür, durch die wir hereingekommen sind", THROUGH),
        ("fahr zu der Tür, durch die du reingekommen bist", TO),
        ("schau zur Tür, durch die du gekommen bist", FACE),
    ],
)
def test_the_door_we_came_in_by_is_understood(text: str, clause: GoToDoor | Face) -> None:
    assert parse(text).clauses == (clause,)


@pytest.mark.parametrize("clause", [THROUGH, TO, GoToDoor(DOOR, Approach.IN), FACE])
def test_the_entry_is_the_same_in_every_notation(clause: GoToDoor | Face) -> None:
    command = Command((clause,))
    assert decode(encode(command)) == from_program(to_program(command)) == command
    for language in ("en", "de"):
        assert parse(command.say(language), language) == command
    assert meaning_of(command) == read_meaning(notation_of(command))
    assert "door(entry)" in notation_of(command)


def test_to_go_out_by_the_entry_is_to_leave() -> None:
    assert normal(read_meaning("through door(entry)")) == normal(read_meaning("leave"))


def test_the_entry_has_no_side_and_lies_not_ahead() -> None:
    with pytest.raises(ValueError, match="say no side"):
        DoorReference(ENTRY, Side.LEFT)
    for kind in (Follow, IfThere):
        with pytest.raises(ValueError, match="lies behind"):
            kind(DOOR)


ONE_DOOR = Scene((), (Door((5.0, -0.5), (5.0, 0.5)),))


@pytest.mark.parametrize("clause", [TO, FACE])
def test_a_robot_that_came_through_no_door_says_so(clause: GoToDoor | Face) -> None:
    with pytest.raises(GroundingError, match="the robot has come through no door; say which"):
        ground(clause, ONE_DOOR, ORIGIN)


def test_a_robot_that_came_through_no_door_leaves_by_the_only_one() -> None:
    assert ground(THROUGH, ONE_DOOR, ORIGIN) == ground(Leave(), ONE_DOOR, ORIGIN)


@pytest.mark.parametrize("drift", [0.0, 0.5])
def test_the_seen_door_nearest_to_the_passed_one_is_the_entry(drift: float) -> None:
    """The door has moved by the drift of odometry since; the other one is a door's width off."""
    entry, other = Door((2.0, -0.5), (2.0, 0.5)), Door((2.0, 1.5), (2.0, 2.5))
    passed = PassGoal((2.9, 0.0, 0.0), door=entry)
    moved = Door((2.0, -0.5 - drift), (2.0, 0.5 - drift))
    for doors, found in (((other, moved), moved), ((other,), entry)):
        situation = Situation(Scene((), doors), ORIGIN, (6.0, 3.0, 1.0), entry=passed)
        door = find_entry(DOOR, situation)
        assert door.door == found
        assert abs(door.outward) == pytest.approx(math.pi)


@pytest.mark.parametrize("robot", ["wheelchair", "spot"])
def test_a_robot_finds_the_door_it_came_by(robot: str) -> None:
    agent = make_agent("scripted")
    env = SemNavEnv(robot, "office_cross", observation=agent.observation)
    for text in (
        "go through the first door on the left, go a bit further and face the door you came in by",
        "go through the first door on the left, go down the hallway until the end of the hallway "
        "and go out the door you came in by",
        "go through the second door on the right, turn around and go to the door you came in by",
    ):
        observation, info = env.reset(seed=3, options={"command": parse(text)})
        for step in steps(env, agent, observation, info):
            info = step.info
        assert info["is_success"], (text, info["verdicts"])
        assert info["collisions"] == 0
    env.close()
