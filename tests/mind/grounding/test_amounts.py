"""An amount that is not said has one length, told in the reasons, and never leads beyond a wall."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from semnav_agents.base import steps
from semnav_agents.registry import make_agent
from semnav_env import Rules, SemNavEnv
from semnav_env.language import (
    SOME,
    AmbiguousCommandError,
    BackUp,
    Command,
    Distance,
    Follow,
    Turn,
    Turning,
    decode,
    encode,
    from_program,
    parse,
    to_program,
)
from semnav_env.language.corpora.meanings import meaning_of, normal
from semnav_env.language.corpora.notation import notation_of, read_meaning
from semnav_env.language.references import Unit
from semnav_env.mind.grounding import GroundingError, ground
from semnav_env.mind.grounding.clause_order import comes_after_corridor, is_only_a_direction
from semnav_env.rules import GroundingRules
from semnav_features.frames import ORIGIN
from semnav_features.scene import Scene, Wall

LENGTH = GroundingRules().some_distance
HALLWAY = (Wall((-9.0, 1.0), (30.0, 1.0)), Wall((30.0, -1.0), (-9.0, -1.0)))


def hallway_to(end: float) -> Scene:
    return Scene((*HALLWAY, Wall((end, -1.0), (end, 1.0))))


@pytest.mark.parametrize(
    "text",
    [
        "go a bit further",
        "go on a bit",
        "go a short way down the hallway",
        "drive a short distance",
        "go a few steps",
        "a little further",
        "go slightly forward",
        "geh ein Stück weiter",
        "fahr noch ein bisschen weiter",
        "ein kleines Stück geradeaus",
        "fahr ein Stück den Flur entlang",
        "ein paar Meter weiter",
        "etwas weiter",
    ],
)
def test_an_amount_without_a_number_is_some(text: str) -> None:
    assert parse(text).clauses == (Follow(SOME),)


@pytest.mark.parametrize("text", ["back up a bit", "setz ein Stück zurück", "reverse a little"])
def test_one_backs_up_by_some(text: str) -> None:
    assert parse(text).clauses == (BackUp(SOME),)


@pytest.mark.parametrize("text", ["turn a bit to the left", "bieg etwas nach links ab"])
def test_an_amount_of_a_turn_is_no_distance(text: str) -> None:
    try:
        readings: tuple[Command, ...] = (parse(text),)
    except AmbiguousCommandError as asked:
        readings = asked.readings
    assert all(isinstance(each.clauses[0], Turn) for each in readings)


@pytest.mark.parametrize("clause", [Follow(SOME), BackUp(SOME)])
def test_an_amount_is_the_same_in_every_notation(clause: Follow | BackUp) -> None:
    command = Command((clause,))
    assert decode(encode(command)) == from_program(to_program(command)) == command
    for language in ("en", "de"):
        assert parse(command.say(language), language) == command
    assert meaning_of(command) == read_meaning(notation_of(command))


def test_there_is_one_amount_of_some() -> None:
    with pytest.raises(ValueError, match="a distance is 1 to 1 some"):
        Distance(2.0, Unit.SOME)


@given(st.floats(0.5, 20.0))
def test_some_is_as_long_as_the_rules_say(length: float) -> None:
    rules = Rules(grounding=GroundingRules(some_distance=length))
    goal = ground(Follow(SOME), hallway_to(29.0), ORIGIN, rules=rules)
    assert goal.pose == pytest.approx((length, 0.0, 0.0))
    assert goal.because == f"go on to a bit of {length:g} metres, as it was not said how far"


@pytest.mark.parametrize("end", [0.4, 1.0, 2.0])
def test_some_leads_no_farther_than_the_hallway(end: float) -> None:
    goal = ground(Follow(SOME), hallway_to(end), ORIGIN, complete=True)
    assert 0.0 <= goal.pose[0] < end
    with pytest.raises(GroundingError, match="the hallway ends"):
        ground(Follow(Distance(2.0)), hallway_to(end), ORIGIN, complete=True)


def test_one_backs_up_by_less_where_there_is_less_room() -> None:
    for wall, back in ((9.0, LENGTH), (2.0, 1.3)):
        scene = Scene((Wall((-wall, -1.0), (-wall, 1.0)),))
        assert ground(BackUp(SOME), scene, ORIGIN).pose[0] == pytest.approx(-back)
    with pytest.raises(GroundingError, match=r"there is a wall 1\.0 m behind"):
        ground(BackUp(SOME), Scene((Wall((-1.0, -1.0), (-1.0, 1.0)),)), ORIGIN)


@pytest.mark.parametrize(
    ("text", "meaning"),
    [
        ("go a bit further and turn left", "turn left at turning"),
        ("go a little way and take the second door", "through door(2)"),
        ("ein Stück geradeaus, dann bis zur Kreuzung", "hallway until intersection"),
        ("go a bit further and turn around", "hallway for some; turn around"),
        ("go a bit further and stop", "hallway for some; stop"),
    ],
)
def test_some_before_what_says_where_is_only_a_direction(text: str, meaning: str) -> None:
    """As "go down the hallway" is; a turn is then made at the next place that allows it."""
    command = parse(text)
    assert normal(meaning_of(command)) == normal(read_meaning(meaning))
    assert is_only_a_direction(command.clauses, 0) is ("some" not in meaning)


def test_some_then_a_turn_is_a_turn_at_the_next_turning() -> None:
    clauses = (Follow(SOME), Turn(Turning.LEFT))
    assert comes_after_corridor(clauses, 1)


@pytest.mark.parametrize("robot", ["wheelchair", "spot"])
def test_a_robot_goes_a_bit_and_stands(robot: str) -> None:
    agent = make_agent("scripted")
    env = SemNavEnv(robot, "office_cross", observation=agent.observation)
    observation, info = env.reset(seed=3, options={"command": "go a bit further and stop"})
    begin = env.world.pose
    for step in steps(env, agent, observation, info):
        info = step.info
    assert info["is_success"], info["verdicts"]
    moved = env.world.pose
    way = ((moved[0] - begin[0]) ** 2 + (moved[1] - begin[1]) ** 2) ** 0.5
    assert way == pytest.approx(LENGTH, abs=1.0)
    env.close()


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        ("go a bit further, half a metre", "go down the hallway for 0.5 metres"),
        ("ein Stück geradeaus, zwei Meter", "go down the hallway for 2 metres"),
    ],
)
def test_a_number_behind_an_amount_says_how_much(text: str, meant: str) -> None:
    assert str(parse(text)) == meant
