"""The texts from which the translator learns, and how it is measured."""

import re

import numpy as np
import pytest

from semnav_env.language import parse
from semnav_env.language.corpora import (
    load_sentences,
)
from semnav_env.language.corpora.meanings import meaning_of, normal
from semnav_env.language.translating.interpreter import AskingLimits
from semnav_env.language.translating.network import TRAINED_FOLDER
from studies.corpora import learned_corpora
from studies.translating.corrections import with_correction
from studies.translating.infeasible import infeasible
from studies.translating.limits import TranslatedCase, cases_of, outcome
from studies.translating.programs import command_of_meaning
from studies.translating.synonyms import with_synonyms
from studies.translating.texts import TrainingText, authored, disturbed, generated, joined

TURN = TrainingText("Turn left.", "en", (), (parse("turn left"),))
STOP = TrainingText("Stop.", "en", (), (parse("stop"),))


def test_a_meaning_becomes_a_command_that_means_the_same() -> None:
    meanings = [
        sentence.meanings[0]
        for path in learned_corpora()
        for sentence in load_sentences(path)
        if sentence.kind == "feasible"
    ]
    found = [(meaning, command_of_meaning(meaning)) for meaning in meanings]
    right = [(meaning, command) for meaning, command in found if command is not None]
    assert len(right) >= 0.95 * len(meanings)
    assert all(normal(meaning_of(command)) == normal(meaning) for meaning, command in right)


def test_two_texts_in_one_mean_both() -> None:
    both = joined(TURN, STOP, np.random.default_rng(0))
    assert both is not None
    assert both.commands == (parse("turn left and stop"),)


def test_a_text_with_a_part_that_is_refused_is_refused() -> None:
    refused = TrainingText("Sing.", "en", (), ())
    both = joined(TURN, refused, np.random.default_rng(0))
    assert both is not None
    assert both.commands == ()


def test_variants_keep_their_meaning_up_to_left_and_right() -> None:
    mirrored = parse("turn right")
    variants = list(disturbed([TURN], 200, np.random.default_rng(0)))
    alone = [t for t in variants if t.commands and len(t.commands[0].clauses) == 1]
    assert {each.commands[0] for each in alone} == {TURN.commands[0], mirrored}
    sides = {each: re.findall("left|right", each.text.lower()) for each in alone}
    assert all(  # of two sides the last one counts, as the first was taken back
        said[-1] == ("right" if each.commands[0] == mirrored else "left")
        for each, said in sides.items()
        if said
    )


def test_the_texts_are_the_same_for_the_same_seed() -> None:
    known = authored(learned_corpora()[2])[:20]
    first, second = (list(generated(known, 20, np.random.default_rng(3))) for _ in range(2))
    assert first == second
    assert all(each.commands for each in first)


@pytest.mark.parametrize(
    ("candidates", "becomes"),
    [
        (((0.95, True), (0.02, False)), "done"),
        (((0.95, False), (0.02, True)), "misread"),
        (((0.5, False), (0.3, True)), "asked"),
        (((0.5, False), (0.3, False)), "asked wrongly"),
        (((0.2, True), (0.05, False)), "refused"),
        ((), "refused"),
    ],
)
def test_what_becomes_of_a_text_follows_from_its_probabilities(candidates, becomes) -> None:
    assert outcome(TranslatedCase("feasible", candidates, "english"), AskingLimits()) == becomes


def test_most_texts_that_were_learned_have_a_right_candidate() -> None:
    found = list(cases_of(learned_corpora()[2], TRAINED_FOLDER))[:20]
    assert sum(any(right for _, right in case.candidates) for case in found) >= 15


def test_synonyms_keep_sides_and_numbers() -> None:
    rng = np.random.default_rng(0)
    for _ in range(50):
        said = with_synonyms("Go past the third door, then turn left.", "en", rng)
        assert "left" in said
        assert "right" not in said
        assert "third" in said


@pytest.mark.parametrize(
    ("code", "text", "wrong"),
    [
        ("en", "go to the third door", {"first", "second", "fourth", "fifth", "sixth"}),
        ("de", "fahr zur dritten Tür", {"ersten", "zweiten", "vierten", "fünften", "sechsten"}),
        ("en", "turn left", {"right"}),
    ],
)
def test_a_corrected_text_says_another_value_first(code, text, wrong) -> None:
    rng = np.random.default_rng(0)
    for _ in range(20):
        corrected = with_correction(text, code, rng)
        assert corrected is not None
        said = re.findall(r"\w+", corrected)
        assert said[-1] == text.split()[-1]
        assert len(wrong & set(said)) == 1
    assert with_correction("go on", code, rng) is None


def test_what_is_made_infeasible_has_other_words() -> None:
    rng = np.random.default_rng(0)
    made = {infeasible("go to the second door", "en", rng) for _ in range(50)}
    assert len(made) > 20
    assert "go to the second door" not in made
    assert infeasible("left", "en", rng) is None
