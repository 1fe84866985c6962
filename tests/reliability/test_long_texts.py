"""Texts of one character or token again and again are read or refused."""

from __future__ import annotations

import time

import pytest

from semnav_env.language import CommandError, parse
from semnav_env.language.normalise import MAX_CHARACTERS, MAX_WORD_LENGTH, MAX_WORDS
from tests.reliability.long_texts import CHARACTERS, MOST_CHARACTERS, TOKENS, read_run, run_of


@pytest.mark.parametrize("length", [80, MAX_CHARACTERS, 10_000])
def test_runs_of_every_character_are_read_or_refused(length: int) -> None:
    for character in CHARACTERS:
        read_run((character, length))


@pytest.mark.parametrize("length", [300, 10_000])
def test_runs_of_every_short_token_are_read_or_refused(length: int) -> None:
    for token in TOKENS:
        read_run((token, length))


@pytest.mark.parametrize("token", [",", '"', "[", "twenty-", "the ", "-a"])
def test_a_text_of_twice_the_budget_takes_no_longer_than_one_within_it(token: str) -> None:
    """A ratio, as machines differ: what is over the budget is refused before it is parsed."""

    def seconds(length: int) -> float:
        begun = time.process_time()
        with pytest.raises(CommandError):
            parse(run_of(token, length))
        return time.process_time() - begun

    within = MAX_WORDS * max(1, len(token) - token.count(" ")) // 2
    seconds(within)
    assert min(seconds(10_000) for _ in range(3)) < 2 * max(seconds(within) for _ in range(3))


def test_words_and_numbers_that_are_too_long_are_pointed_at() -> None:
    for word in ("x" * (MAX_WORD_LENGTH + 1), "9" * 309, "1" + "0" * 400, '"' + "a" * 90 + '"'):
        with pytest.raises(CommandError, match=f"at most {MAX_WORD_LENGTH} are read") as refused:
            parse(f"go for {word} metres")
        assert (refused.value.position, refused.value.length) == (7, len(word))


@pytest.mark.parametrize("zeros", [2, 12, 60, 400])
@pytest.mark.parametrize(
    "text",
    [
        *("drive for {} metres", "fahr {} Meter", "wait {} seconds", "warte {} Sekunden"),
        *("turn {} degrees to the left", "dreh dich um {} Grad nach links", "go {} steps"),
        *(
            "go through door number {}",
            "pass {} doors",
            "wait {} hours",
        ),
        *("go {}.5 metres", "go {}th door", "wait for {} minutes and {} seconds"),
    ],
)
def test_numbers_without_end_are_refused_in_one_line(text: str, zeros: int) -> None:
    with pytest.raises(CommandError) as refused:
        parse(text.replace("{}", "9" + "0" * zeros))
    assert "\n" not in refused.value.summary
    assert len(refused.value.summary) < MOST_CHARACTERS
