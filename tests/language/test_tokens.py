"""Commands as arrays of small integers."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from semnav_env.language import (
    CLAUSE_FEATURES,
    LAST,
    MAX_CLAUSES,
    Command,
    DoorReference,
    Follow,
    GoToDoor,
    GoToRoom,
    Place,
    PlaceReference,
    Side,
    Stop,
    Turn,
    Turning,
    decode,
    encode,
    token_mask,
    token_space,
)
from semnav_env.language.command import room_of
from semnav_env.language.declarations import ROOM
from semnav_env.language.tokens import COLUMN_SIZES, TOKEN_REFERENTS
from tests.support.command_strategies import commands, without_rooms

SHAPE = (MAX_CLAUSES, CLAUSE_FEATURES)


@given(without_rooms)
def test_decoding_undoes_encoding(command: Command) -> None:
    assert decode(encode(command)) == command


@given(without_rooms)
def test_tokens_lie_in_their_space(command: Command) -> None:
    assert token_space().contains(encode(command))


@given(without_rooms, without_rooms)
def test_different_commands_have_different_tokens(one: Command, other: Command) -> None:
    assert np.array_equal(encode(one), encode(other)) == (one == other)


@given(without_rooms)
def test_rows_after_the_last_clause_are_zero(command: Command) -> None:
    assert np.all(encode(command)[: len(command.clauses)].any(axis=1))
    assert not np.any(encode(command)[len(command.clauses) :])


def test_the_columns_are_as_written_down() -> None:
    command = Command(
        (
            Follow(PlaceReference(Place.END)),
            Turn(Turning.RIGHT, PlaceReference(Place.CORNER, 3)),
            GoToDoor(DoorReference(LAST, Side.LEFT)),
            Stop(),
        )
    )
    rows = [[1, 0, 4, 1, 0], [2, 2, 3, 3, 0], [4, 0, 1, 21, 1], [5, 0, 0, 0, 0]]
    assert encode(command)[:4].tolist() == rows


@given(
    arrays(np.int64, SHAPE, elements=st.integers(-1, 33))
    | st.tuples(
        *(arrays(np.int64, MAX_CLAUSES, elements=st.integers(0, n - 1)) for n in COLUMN_SIZES)
    ).map(np.column_stack)
)
def test_any_integers_are_a_command_or_refused(tokens: Any) -> None:
    try:
        command = decode(tokens)
    except ValueError:
        return
    assert np.array_equal(encode(command), tokens)


@pytest.mark.parametrize(
    ("row", "reason"),
    [
        ([2, 0, 0, 0, 0], "no clause"),
        ([2, 1, 1, 1, 0], "no clause"),
        ([3, 0, 2, 1, 0], "no clause"),
        ([5, 3, 0, 0, 0], "no clause"),
        ([0, 0, 0, 0, 1], "no clause"),
        ([1, 0, 4, 2, 0], "one end ahead"),
        ([1, 0, 2, 31, 0], "1 to 20"),
        ([1, 0, 1, 0, 0], "no ordinal"),
        ([10, 0, 0, 0, 0], "go up to"),
        ([6, 0, 0, 0, 0], "no clause"),
        ([7, 0, 11, 1, 0], "0 rooms"),
        ([-1, 0, 0, 0, 0], "go up to"),
    ],
)
def test_a_row_that_is_no_clause_is_named(row: list[int], reason: str) -> None:
    tokens = encode(Command((Stop(),)))
    tokens[1] = row
    with pytest.raises(ValueError, match=f"row 1 .*{reason}"):
        decode(tokens)


ROOMS = ("kitchen", "3.508", "left")


@given(commands)
def test_rooms_are_numbered_by_their_place_among_the_names(command: Command) -> None:
    names = [name for clause in command.clauses if (name := room_of(clause))]
    rooms = sorted({*names, *ROOMS})
    tokens = encode(command, rooms)
    assert token_space().contains(tokens)
    assert decode(tokens, rooms) == command
    named = TOKEN_REFERENTS.index(ROOM)
    numbers = [n for _, _, kind, n, _ in tokens.tolist() if kind == named and n]
    assert [rooms[n - 1] for n in numbers] == names


def test_a_room_that_is_not_there_has_no_number() -> None:
    with pytest.raises(ValueError, match=r"no room 'attic' .*; there are: kitchen, 3.508, left"):
        encode(Command((GoToRoom("attic"),)), ROOMS)


@given(without_rooms)
def test_the_mask_says_which_rows_are_clauses(command: Command) -> None:
    mask = token_mask(encode(command))
    assert mask.tolist() == [i < len(command.clauses) for i in range(MAX_CLAUSES)]


def test_a_gap_between_clauses_is_refused() -> None:
    tokens = encode(Command((Stop(), Stop(), Stop())))
    tokens[1] = 0
    with pytest.raises(ValueError, match=r"row 1 .* is no clause"):
        decode(tokens)


def test_no_clause_at_all_is_refused() -> None:
    with pytest.raises(ValueError, match="1 to 8 clauses, not 0"):
        decode(np.zeros(SHAPE, dtype=np.int64))


@pytest.mark.parametrize(
    "tokens", [[], np.zeros(SHAPE), np.zeros((3, 5), dtype=int), np.full(SHAPE, np.nan), "stop"]
)
def test_arrays_of_another_shape_or_type_are_refused(tokens: Any) -> None:
    with pytest.raises(ValueError, match=r"integers of shape \(8, 5\), not"):
        decode(tokens)
