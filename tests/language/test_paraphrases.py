"""Other words for the same command."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest

from semnav_env.language import (
    BackUp,
    Command,
    CommandError,
    Distance,
    SearchHouse,
    paraphrases,
    read,
    sample_command,
)
from semnav_env.language.language import Language
from semnav_env.language.languages import language_of

LANGUAGES = ("en", "de")
OFFICE = read(
    "turn left at the second intersection, go down the hallway past the first door on the left "
    "and go through the third door on the right"
)


def understood(text: str, command: Command, language: Language) -> bool:
    try:
        return read(text, language) == command
    except CommandError:
        return False


@pytest.mark.parametrize("language", LANGUAGES)
def test_paraphrases_are_different_texts_of_the_same_command(language: str) -> None:
    texts = paraphrases(OFFICE, np.random.default_rng(1), 50, language)
    assert len(set(texts)) == 50
    assert OFFICE.say(language) not in texts
    assert {read(text, language) for text in texts} == {OFFICE}


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_kind_of_command_can_be_said_otherwise(language: str) -> None:
    rng = np.random.default_rng(2)
    for _ in range(200):
        command = sample_command(rng, max_clauses=3)
        (text,) = paraphrases(command, rng, 1, language)
        assert read(text, language) == command


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_wording_of_a_language_is_understood_somewhere(language: str) -> None:
    spoken = language_of(language)
    rng = np.random.default_rng(3)
    usable = {key for key in spoken.wordings if key in spoken.phrases} - {"comma", "from_there"}
    left = {(key, wording) for key in usable for wording in spoken.wordings[key]}
    commands = [sample_command(rng, max_clauses=2, max_ordinal=3) for _ in range(1500)]
    commands.append(Command((SearchHouse(),)))  # belongs to a house, so it is not sampled
    commands.append(Command((BackUp(Distance(2.0)),)))  # trained agents do not know it
    for key, wording in sorted(left):
        other = replace(spoken, phrases={**spoken.phrases, key: wording})
        texts = ((command.say(other), command) for command in commands)
        if any(t != c.say(spoken) and understood(t, c, spoken) for t, c in texts):
            left.discard((key, wording))
    assert left == set()


def test_readings_can_be_imported_after_parsing() -> None:
    """A module of that name would take the function's place when it is first needed."""
    read("stop")
    from semnav_env.language import readings

    assert readings("stop") == (read("stop"),)


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
