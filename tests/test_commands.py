"""Commands as values: what can be built, how it is said, how it is sampled."""

import pickle
from collections import Counter

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from semnav_env.commands import (
    LAST,
    MAX_CLAUSES,
    MAX_ORDINAL,
    Approach,
    Clause,
    Command,
    DoorReference,
    Follow,
    GoToDoor,
    Place,
    PlaceReference,
    Side,
    Stop,
    Turn,
    Turning,
    parse,
    sample_clause,
    sample_command,
)
from tests.command_strategies import clauses, commands


@given(commands)
def test_saying_and_parsing_a_command_gives_it_back(command: Command) -> None:
    assert parse(str(command)) == command


@given(clauses)
def test_each_clause_says_itself(clause: Clause) -> None:
    assert parse(str(clause)).clauses == (clause,)


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


@pytest.mark.parametrize("ordinal", [0, -2, MAX_ORDINAL + 1, 1.5, float("nan"), "second", None])
def test_ordinals_outside_the_words_are_refused(ordinal: int) -> None:
    with pytest.raises(ValueError, match="ordinal of a door is 1 to 20 or LAST"):
        DoorReference(ordinal)
    with pytest.raises(ValueError, match="ordinal of a corner is 1 to 20, not"):
        PlaceReference(Place.CORNER, ordinal)


def test_places_have_no_last_and_the_end_is_one() -> None:
    with pytest.raises(ValueError, match="1 to 20, not -1"):
        PlaceReference(Place.INTERSECTION, LAST)
    with pytest.raises(ValueError, match="one end ahead"):
        PlaceReference(Place.END, 2)


@given(st.integers(0, 2**32 - 1), st.integers(1, MAX_CLAUSES), st.integers(1, MAX_ORDINAL))
def test_sampled_commands_keep_their_limits(seed: int, most: int, highest: int) -> None:
    command = sample_command(np.random.default_rng(seed), most, highest)
    assert 1 <= len(command.clauses) <= most
    assert parse(str(command)) == command
    assert command == sample_command(np.random.default_rng(seed), most, highest)
    for clause in command.clauses:
        for part in (getattr(clause, "door", None), getattr(clause, "until", None)):
            assert part is None or part.ordinal <= highest


def test_sampling_reaches_every_kind_of_clause_about_equally() -> None:
    rng = np.random.default_rng(0)
    kinds = Counter(type(sample_clause(rng)) for _ in range(4000))
    assert set(kinds) == {Follow, Turn, GoToDoor, Stop}
    assert all(abs(count - 1000) < 150 for count in kinds.values())


def test_sampling_reaches_every_clause_of_a_small_language() -> None:
    rng = np.random.default_rng(0)
    found = {sample_clause(rng, max_ordinal=1) for _ in range(6000)}
    doors, places = 2 * 4, 3
    assert len(found) == (1 + doors + places) + 3 * (1 + places) + 2 * doors + 1
