"""Commands as values: what can be built, how it is said, how it is sampled."""

import pickle
from collections import Counter
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from semnav_env.language import (
    LAST,
    MAX_CLAUSES,
    MAX_ORDINAL,
    OTHER,
    Approach,
    Clause,
    Command,
    Distance,
    DoorReference,
    Follow,
    GoBack,
    GoToDoor,
    GoToRoom,
    Leave,
    Place,
    PlaceReference,
    Side,
    Stop,
    Turn,
    Turning,
    decode,
    encode,
    from_program,
    read,
    sample_clause,
    sample_command,
    to_program,
)
from semnav_env.language.languages import languages
from tests.support.command_strategies import clauses, commands


@given(commands, st.sampled_from(sorted(languages())))
@settings(max_examples=300)
def test_saying_and_parsing_a_command_gives_it_back(command: Command, language: str) -> None:
    assert read(command.say(language), language) == command


@given(clauses)
def test_each_clause_says_itself(clause: Clause) -> None:
    assert read(str(clause)).clauses == (clause,)


@given(commands, commands)
def test_different_commands_are_said_differently(one: Command, other: Command) -> None:
    assert (str(one) == str(other)) == (one == other)


@given(commands)
def test_commands_survive_pickling_and_can_be_keys(command: Command) -> None:
    copy = pickle.loads(pickle.dumps(command))
    assert copy == command
    assert hash(copy) == hash(command)


def test_canonical_english() -> None:
    assert str(Follow()) == "go down the hallway"
    assert str(Follow(DoorReference(2))) == "go down the hallway until the second door"
    assert (
        str(Turn(Turning.LEFT, PlaceReference(Place.END))) == "turn left at the end of the hallway"
    )
    assert (
        str(GoToDoor(DoorReference(LAST, Side.AHEAD), Approach.TO))
        == "go to the last door straight ahead"
    )
    three = Command((Follow(), Turn(Turning.AROUND), Stop()))
    assert str(three) == "go down the hallway, turn around and stop"


@pytest.mark.parametrize("number", [0, MAX_CLAUSES + 1])
def test_a_command_has_one_to_eight_clauses(number: int) -> None:
    with pytest.raises(ValueError, match=f"1 to 8 clauses, not {number}"):
        Command((Stop(),) * number)


@pytest.mark.parametrize("clauses", ["stop", [Stop()], Stop(), None])
def test_a_command_holds_a_tuple(clauses: object) -> None:
    with pytest.raises(ValueError, match="holds a tuple of clauses"):
        Command(clauses)  # type: ignore[arg-type]


def test_a_command_holds_clauses_only() -> None:
    with pytest.raises(ValueError, match="not 'stop'"):
        Command(("stop",))  # type: ignore[arg-type]


@pytest.mark.parametrize("ordinal", [-11, MAX_ORDINAL + 1, 0.0, 1.5, float("nan"), "second", None])
def test_ordinals_outside_the_words_are_refused(ordinal: int) -> None:
    with pytest.raises(ValueError, match="ordinal of a door is 1 to 20, or LAST"):
        DoorReference(ordinal)
    with pytest.raises(ValueError, match="ordinal of a corner is 1 to 20, or LAST"):
        PlaceReference(Place.CORNER, ordinal)


def test_places_have_no_other_and_the_end_is_one() -> None:
    with pytest.raises(ValueError, match=r"1 to 20, .*, not 0"):
        PlaceReference(Place.INTERSECTION, OTHER)
    with pytest.raises(ValueError, match="one end ahead"):
        PlaceReference(Place.END, 2)


@given(st.integers(0, 2**32 - 1), st.integers(1, MAX_CLAUSES), st.integers(1, MAX_ORDINAL))
def test_sampled_commands_keep_their_limits(seed: int, most: int, highest: int) -> None:
    command = sample_command(np.random.default_rng(seed), most, highest)
    assert 1 <= len(command.clauses) <= most
    assert read(str(command)) == command
    assert command == sample_command(np.random.default_rng(seed), most, highest)
    for clause in command.clauses:
        for part in (getattr(clause, "door", None), getattr(clause, "until", None)):
            assert getattr(part, "ordinal", 0) <= highest


def test_sampling_reaches_every_kind_of_clause_about_equally() -> None:
    rng = np.random.default_rng(0)
    kinds = Counter(type(sample_clause(rng)) for _ in range(6000))
    assert set(kinds) == {Follow, Turn, GoToDoor, Leave, GoBack, Stop}
    assert all(abs(count - 1000) < 150 for count in kinds.values())


def test_sampling_reaches_every_clause_of_a_small_language() -> None:
    rng = np.random.default_rng(0)
    found = {sample_clause(rng, max_ordinal=1) for _ in range(60000)}
    doors, junctions, distances = 3 * 6, 2 * 4, 100 + 100
    follows = 1 + doors + (junctions + 1) + distances + doors + junctions
    turns = 3 * (1 + junctions + 1) + 2 * 72
    assert len(found) == follows + turns + 2 * doors + 1 + 1 + 101


@pytest.mark.parametrize("count", [500, pytest.param(100_000, marks=pytest.mark.slow)])
@pytest.mark.parametrize("language", sorted(languages()))
def test_sampled_commands_come_back_from_their_words(language: str, count: int) -> None:
    rng = np.random.default_rng(7)
    for _ in range(count):
        command = sample_command(rng)
        assert read(command.say(language), language) == command


@pytest.mark.parametrize("count", [500, pytest.param(100_000, marks=pytest.mark.slow)])
def test_sampled_commands_come_back_from_programs_and_tokens(count: int) -> None:
    rng = np.random.default_rng(11)
    for _ in range(count):
        command = sample_command(rng)
        assert from_program(to_program(command)) == command
        assert decode(encode(command)) == command


@pytest.mark.parametrize("bad", [0, -1, 0.3, 50.5, float("nan"), float("inf")])
def test_distances_outside_the_words_are_refused(bad: float) -> None:
    with pytest.raises(ValueError, match=r"a distance is 0.5 to 50 metres in steps of 0.5, not"):
        Distance(bad)


@pytest.mark.parametrize("degrees", [0, -90, 7, 365])
def test_degrees_outside_the_words_are_refused(degrees: int) -> None:
    with pytest.raises(ValueError, match="5 to 360 degrees in steps of 5"):
        Turn(Turning.LEFT, degrees=degrees)


def test_one_turns_by_degrees_on_the_spot_and_to_a_side() -> None:
    with pytest.raises(ValueError, match="on the spot"):
        Turn(Turning.AROUND, degrees=180)
    with pytest.raises(ValueError, match="on the spot"):
        Turn(Turning.LEFT, PlaceReference(Place.CORNER), 90)


@pytest.mark.parametrize("until", [None, PlaceReference(Place.END), Distance(2.0)])
def test_one_goes_past_doors_and_junctions_only(until: Any) -> None:
    with pytest.raises(ValueError, match="past a door or a junction"):
        Follow(until, past=True)


@pytest.mark.parametrize(
    "name", ["", " ", "Kitchen", "a  b", "a'b", "\u0430", "x" * 41, "two\nlines"]
)
def test_names_of_rooms_are_small_letters_and_digits(name: str) -> None:
    with pytest.raises(ValueError, match="of small letters and digits"):
        GoToRoom(name)
