"""Canonical words: what `say` says, `read` reads back, and nothing else."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from semnav_env.judge.episodes import load_episodes
from semnav_env.language import Command, CommandError, parse, read
from semnav_env.language.languages import languages
from tests.support.command_strategies import commands

CODES = sorted(languages())


@given(commands, st.sampled_from(CODES))
def test_what_is_said_is_read_back(command: Command, code: str) -> None:
    assert read(command.say(code), code) == command


@given(commands, st.sampled_from(CODES))
def test_canonical_words_are_never_doubted(command: Command, code: str) -> None:
    assert parse(command.say(code), code) == command


@pytest.mark.parametrize(
    "text",
    [
        "  go\tthrough \n the\u2028second\u00a0door on\u3000the right. ",
        "GO THROUGH THE SECOND DOOR ON THE RIGHT",
        "ｇｏ ｔｈｒｏｕｇｈ ｔｈｅ second door on the right",
        "\ufeffgo thr\u200bough the se\u00adcond door\u2060 on the ri\u200dght\u200e",
    ],
)
def test_case_spaces_and_invisible_characters_change_nothing(text: str) -> None:
    assert str(read(text)) == "go through the second door on the right"


def test_counting_on_is_told_from_counting_anew() -> None:
    said = "go down the hallway past the first door and {}go through the second door"
    assert str(read(said.format("from there "))) == said.format("from there ")
    with pytest.raises(CommandError):
        read(said.format(""))


@pytest.mark.parametrize(
    "text",
    [
        "the second door on the right",
        "please turn left",
        "turn left turn right",
        "if you see the first door",
        "go to the twenty-first door",
        "wait for 101 seconds",
        'go to room ""',
        "verlass den Raum",
    ],
)
def test_other_words_are_none(text: str) -> None:
    with pytest.raises(CommandError, match="canonical words"):
        read(text)


@pytest.mark.parametrize("split", ["val_unseen", "test_infeasible", "test_real"])
def test_frozen_readings_are_the_stored_programs(split: str) -> None:
    for episode in load_episodes(split)[::7]:
        said = tuple(read(each, episode.language) for each in episode.readings)
        assert said == episode.programs
