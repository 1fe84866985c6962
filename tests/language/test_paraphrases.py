"""Other words for the same command."""

from __future__ import annotations

import re

import numpy as np
import pytest

from semnav_env.language import CommandError, paraphrases, parse, read, sample_command
from semnav_env.language.corpora.meanings import key_of

LANGUAGES = ("en", "de")
OFFICE = read(
    "turn left at the second intersection, go down the hallway past the first door on the left "
    "and go through the third door on the right"
)


@pytest.mark.parametrize("language", LANGUAGES)
def test_paraphrases_are_different_texts(language: str) -> None:
    texts = paraphrases(OFFICE, np.random.default_rng(1), 50, language)
    assert len(set(texts)) == 50
    assert OFFICE.say(language) not in texts


@pytest.mark.parametrize("language", LANGUAGES)
def test_what_paraphrases_say_is_understood(language: str) -> None:
    rng = np.random.default_rng(2)
    right = []
    for _ in range(200):
        command = sample_command(rng, max_clauses=3, max_ordinal=5)
        (text,) = paraphrases(command, rng, 1, language)
        try:
            right.append(key_of(parse(text, language)) == key_of(command))
        except CommandError:  # a question, as a rule
            continue
    assert np.mean(right) >= 0.98
    assert len(right) >= 180


@pytest.mark.parametrize("language", ["en", "de"])
def test_a_sign_and_a_verb_set_off_what_depends_on_a_condition(language: str) -> None:
    command = read("if you see the first door, turn left at the first corner")
    unclear = {
        "en": r" and then |[,;.] (then )?left at",
        "de": r" und dann |[,;.] (dann )?(an|bei) der \w+ \w+ links([.,]|$)",
    }
    for text in paraphrases(command, np.random.default_rng(0), 40, language):
        assert not re.search(unclear[language], text), text


def test_the_same_generator_says_the_same() -> None:
    there, again = (paraphrases(OFFICE, np.random.default_rng(4), 5) for _ in range(2))
    assert there == again


def test_what_can_be_said_in_few_ways_gives_few_texts() -> None:
    texts = paraphrases(read("stop"), np.random.default_rng(5), 500)
    assert 5 < len(texts) < 500


def test_no_negative_number_of_texts_is_asked_for() -> None:
    with pytest.raises(ValueError, match="n is -1; it must be 0 or more"):
        paraphrases(OFFICE, np.random.default_rng(6), -1)


def test_things_of_another_kind_are_refused_by_what_was_meant() -> None:
    with pytest.raises(TypeError, match="needs a Command, as parse makes it"):
        paraphrases("turn left", np.random.default_rng(0), 3)  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="rng is 5; give a generator"):
        paraphrases(OFFICE, 5, 3)  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="rng is 5; give a generator"):
        sample_command(5)  # type: ignore[arg-type]


def test_turn_is_a_verb_where_no_article_or_ordinal_comes_before_it() -> None:
    """The word is a noun, too: "left at the 3rd turn" has no verb."""
    command = read("if you see the first door, turn left at the third turning")
    texts = paraphrases(command, np.random.default_rng(0), 200)
    assert any(re.search(r"[,;.] turn left at", text) for text in texts)
    assert not any(re.search(r"[,;.] left at the \w+ (turning|opening)", text) for text in texts)
