"""A distance before or after a place is measured along the hallway from that place."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from semnav_agents.base import steps
from semnav_agents.registry import make_agent
from semnav_env import SemNavEnv
from semnav_env.language import (
    AmbiguousCommandError,
    Command,
    Distance,
    DoorReference,
    Follow,
    Place,
    PlaceOffset,
    PlaceReference,
    Relation,
    decode,
    encode,
    from_program,
    parse,
    to_program,
)
from semnav_env.language.corpora.meanings import meaning_of, normal
from semnav_env.language.corpora.notation import notation_of, read_meaning
from semnav_env.mind.grounding import GroundingError, ground
from semnav_features.frames import ORIGIN
from semnav_features.scene import Door, Scene, Wall
from tests.support.command_strategies import offsets

END = 20.0
WALLS = (Wall((-9.0, 1.0), (END, 1.0)), Wall((END, -1.0), (-9.0, -1.0)))
DOORS = tuple(Door((x - 0.5, 1.0), (x + 0.5, 1.0)) for x in (6.0, 12.0))
HALLWAY = Scene((*WALLS, Wall((END, -1.0), (END, 1.0))), DOORS)

TEXTS = """
stop a metre before the corner = hallway until 1 m before corner; stop
two metres past the second door = hallway until 2 m after door(2)
go two metres past the second door = hallway until 2 m after door(2)
stop three metres in front of the second door = hallway until 3 m before door(2); stop
go until one metre before the end of the hallway = hallway until 1 m before end
one metre before the intersection, turn around = hallway until 1 m before intersection; turn around
halt einen Meter vor der Ecke = hallway until 1 m before corner; stop
fahr bis zwei Meter hinter die zweite Tür = hallway until 2 m after door(2)
geh bis einen Meter vor das Ende des Flurs = hallway until 1 m before end
go past the second door and then two metres further = hallway until 2 m after door(2)
after three metres, turn left = hallway for 3 m; turn left
"""
CASES = [tuple(line.split(" = ")) for line in TEXTS.strip().splitlines()]


def test_the_place_of_a_turn_may_be_asked_for() -> None:
    with pytest.raises(AmbiguousCommandError) as asked:
        parse("turn left two metres after the second door")
    meant = "hallway until 2 m after door(2); turn left"
    assert normal(meaning_of(asked.value.readings[0])) == normal(read_meaning(meant))


@pytest.mark.parametrize(("text", "meaning"), CASES)
def test_a_distance_before_a_place_belongs_to_it(text: str, meaning: str) -> None:
    assert normal(meaning_of(parse(text))) == normal(read_meaning(meaning))


@given(offsets)
def test_an_offset_is_the_same_in_words_programs_and_notation(clause: Follow) -> None:
    command = Command((clause,))
    assert from_program(to_program(command)) == command
    assert meaning_of(command) == read_meaning(notation_of(command))
    rooms = ("kitchen", "printer room", "3.508", "room_west_1", "left", "12 b", "e-1")
    for language in ("en", "de"):
        assert parse(command.say(language), language, rooms) == command


def test_the_token_of_an_offset_is_that_of_its_place() -> None:
    corner = PlaceReference(Place.CORNER)
    off = Command((Follow(PlaceOffset(Distance(1.0), Relation.BEFORE, corner)),))
    assert decode(encode(off)).clauses == (Follow(corner),)


def test_there_is_nothing_after_the_end() -> None:
    with pytest.raises(ValueError, match="nothing after the end"):
        PlaceOffset(Distance(1.0), Relation.AFTER, PlaceReference(Place.END))
    with pytest.raises(ValueError, match="one can go past"):
        Follow(PlaceOffset(Distance(1.0), Relation.BEFORE, DoorReference(1)), past=True)


@given(st.integers(1, 10), st.sampled_from(Relation), st.sampled_from((1, 2)))
def test_the_goal_lies_so_far_from_the_door(halves: int, relation: Relation, n: int) -> None:
    far = halves / 2
    clause = Follow(PlaceOffset(Distance(far), relation, DoorReference(n)))
    goal = ground(clause, HALLWAY, ORIGIN, complete=True)
    door = 6.0 * n
    assert goal.pose[0] == pytest.approx(door + far if relation is Relation.AFTER else door - far)
    assert not goal.reached_by((door, 0.0, 0.0)), "beside the door is not where it was sent"


def test_before_the_end_is_before_its_wall() -> None:
    before = PlaceOffset(Distance(3.0), Relation.BEFORE, PlaceReference(Place.END))
    assert ground(Follow(before), HALLWAY, ORIGIN).pose[0] == pytest.approx(END - 3.0)


def test_nobody_goes_farther_than_the_hallway() -> None:
    after = PlaceOffset(Distance(9.0), Relation.AFTER, DoorReference(2))
    with pytest.raises(GroundingError, match=r"the hallway ends after 20\.0 m"):
        ground(Follow(after), HALLWAY, ORIGIN, complete=True)


@pytest.mark.parametrize("robot", ["wheelchair", "spot"])
def test_a_robot_stops_so_far_from_a_place(robot: str) -> None:
    agent = make_agent("scripted")
    env = SemNavEnv(robot, "office_cross", observation=agent.observation)
    for text in (
        "stop one metre before the first intersection",
        "stop two metres past the first door",
        "go until two metres before the end of the hallway and stop",
        "stop a metre before the second door",
    ):
        observation, info = env.reset(seed=3, options={"command": text})
        for step in steps(env, agent, observation, info):
            info = step.info
        assert info["is_success"], (text, info["verdicts"])
        assert info["collisions"] == 0
    env.close()
