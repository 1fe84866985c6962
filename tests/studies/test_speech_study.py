"""The study of how robust the speech parser is."""

import time

import numpy as np

from semnav_env.language import parse
from semnav_env.language.corpora import ParseOutcome, load_sentences
from studies.corpora import learned_corpora
from studies.speech.robustness import (
    changed_commands,
    outcomes,
    slowest_parse,
    understood,
    with_fillers,
    without_punctuation,
)


def test_fillers_and_missing_punctuation_change_little() -> None:
    corpus = load_sentences(learned_corpora()[2])
    right = understood(corpus)[:40]
    for disturbed, least in (
        (with_fillers(right, np.random.default_rng(0)), 0.95),
        (without_punctuation(right), 0.9),
    ):
        found = outcomes(corpus, disturbed)
        assert found[ParseOutcome.UNDERSTOOD] >= least * sum(found.values())


def test_canonical_words_keep_their_command() -> None:
    assert not list(changed_commands(20, np.random.default_rng(0)))


def test_a_long_text_takes_no_more_than_twenty_times_its_words_in_short_ones() -> None:
    texts = [f"go through the second door and wait for {n} seconds" for n in range(2, 32)]
    parse(texts[0])  # reads the words of the languages
    start = time.process_time()
    for text in texts:
        parse(text)
    assert slowest_parse() < 20.0 * (time.process_time() - start)
