"""The texts from which the translator learns, and how it is measured."""

import numpy as np

from semnav_agents.networks.card import BUNDLED_FOLDER
from semnav_env.language import parse
from semnav_env.language.corpora import (
    ParseOutcome,
    judge,
    load_sentences,
)
from semnav_env.language.corpora.meanings import meaning_of, normal
from semnav_env.language.corpora.measure import rooms_in
from studies.corpora import development_corpora
from studies.translating.infeasible import infeasible
from studies.translating.measure import interpreters, outcome_of
from studies.translating.programs import command_of_meaning
from studies.translating.synonyms import with_synonyms
from studies.translating.texts import TrainingText, authored, disturbed, generated, joined

TURN = TrainingText("Turn left.", "en", (), (parse("turn left"),))
STOP = TrainingText("Stop.", "en", (), (parse("stop"),))


def test_a_meaning_becomes_a_command_that_means_the_same() -> None:
    meanings = [
        sentence.meanings[0]
        for path in development_corpora()
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
    assert all(
        ("right" in each.text.lower()) == (each.commands[0] == mirrored)
        for each in alone
        if "left" in each.text.lower() or "right" in each.text.lower()
    )


def test_the_texts_are_the_same_for_the_same_seed() -> None:
    known = authored(development_corpora()[2])[:20]
    first, second = (list(generated(known, 20, np.random.default_rng(3))) for _ in range(2))
    assert first == second
    assert all(each.commands for each in first)


def test_the_grammar_is_judged_as_by_the_evaluation() -> None:
    sentences = load_sentences(development_corpora()[2])
    rooms = tuple(dict.fromkeys(rooms_in(each.meanings for each in sentences)))
    grammar = interpreters(sentences, BUNDLED_FOLDER / "translator", 0.9)["grammar"]
    for sentence in sentences[:40]:
        assert outcome_of(sentence, grammar) == judge(sentence, rooms).outcome


def test_the_second_opinion_acts_only_where_the_grammar_does() -> None:
    sentences = load_sentences(development_corpora()[3])[:60]
    found = interpreters(sentences, BUNDLED_FOLDER / "translator", 0.9)
    acts = (ParseOutcome.UNDERSTOOD, ParseOutcome.MISREAD)
    for sentence in sentences:
        before = outcome_of(sentence, found["grammar"])
        after = outcome_of(sentence, found["second opinion"])
        assert after not in acts or after is before


def test_synonyms_keep_sides_and_numbers() -> None:
    rng = np.random.default_rng(0)
    for _ in range(50):
        said = with_synonyms("Go past the third door, then turn left.", "en", rng)
        assert "left" in said
        assert "right" not in said
        assert "third" in said


def test_what_is_made_infeasible_has_other_words() -> None:
    rng = np.random.default_rng(0)
    made = {infeasible("go to the second door", "en", rng) for _ in range(50)}
    assert len(made) > 20
    assert "go to the second door" not in made
    assert infeasible("left", "en", rng) is None
