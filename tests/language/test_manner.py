"""A pace and a wall to keep along are the same in words, programs, symbols and notation."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from semnav_env.language import (
    Command,
    Follow,
    Pace,
    Side,
    Speed,
    Stop,
    decode,
    encode,
    from_program,
    to_program,
)
from semnav_env.language.corpora.meanings import meaning_of, normal, read_meaning
from semnav_env.language.languages import languages
from semnav_env.language.translating.masking import MaskedText
from semnav_env.language.translating.programs import command_of, symbols_of
from studies.translating.programs import command_of_meaning
from tests.support.command_strategies import follows

along_walls = st.builds(
    lambda follow, side: replace(follow, along=side),
    follows,
    st.sampled_from((Side.LEFT, Side.RIGHT)),
)
paces = st.builds(Pace, st.sampled_from(Speed))
commands = st.builds(
    lambda found: Command((*found, Stop())),
    st.lists(along_walls | paces | follows, min_size=1, max_size=6),
)


@given(commands)
def test_a_program_gives_the_command_again(command: Command) -> None:
    assert from_program(to_program(command)) == command


@given(commands)
def test_a_token_holds_the_pace_and_leaves_out_the_wall(command: Command) -> None:
    rooms = ("kitchen", "printer room", "3.508", "room_west_1", "left", "12 b", "e-1")
    plain = decode(encode(command, rooms), rooms)
    for clause, again in zip(command.clauses, plain.clauses, strict=True):
        if isinstance(clause, Pace):
            assert again == clause
        elif isinstance(clause, Follow):
            assert row(clause) == row(replace(clause, along=None)) == row(again)


def row(clause: Follow) -> list[int]:
    rooms = ("kitchen", "printer room", "3.508", "room_west_1", "left", "12 b", "e-1")
    return encode(Command((clause,)), rooms)[0].tolist()


@given(commands)
def test_different_commands_have_different_words(command: Command) -> None:
    for language in languages().values():
        plain = [
            replace(clause, along=None) if isinstance(clause, Follow) else clause
            for clause in command.clauses
        ]
        other = Command(tuple(plain))
        assert (command.say(language) == other.say(language)) is (command == other)


MEANINGS = (
    "slow; hallway until corner",
    "fast; through door(1,left)",
    "hallway along left; turn left at intersection#2; slow; to door(1)",
    "hallway along right until end; fast; leave",
    "hallway along left past door(2,right); hallway along left for 3 m",
)


@pytest.mark.parametrize("meaning", MEANINGS)
def test_notation_and_command_are_inverse(meaning: str) -> None:
    command = command_of_meaning(read_meaning(meaning))
    assert command is not None
    assert normal(meaning_of(command)) == normal(read_meaning(meaning))


@pytest.mark.parametrize("meaning", MEANINGS)
def test_symbols_give_the_command_again(meaning: str) -> None:
    command = command_of_meaning(read_meaning(meaning))
    assert command is not None
    text = MaskedText((), (), (), (2.0, 3.0), (Side.LEFT, Side.RIGHT), ())
    assert command_of(symbols_of(command, text), text) == command


def test_along_a_wall_with_nothing_behind_leads_to_the_end() -> None:
    short, whole = map(read_meaning, ("hallway along left", "hallway along left until end"))
    assert normal(short) == normal(whole)


@pytest.mark.parametrize("side", [Side.AHEAD, Side.BEHIND, Side.OPPOSITE])
def test_a_hallway_has_walls_on_two_sides(side: Side) -> None:
    with pytest.raises(ValueError, match="on the left or on the right"):
        Follow(along=side)
