"""Texts of authors with their candidates, and which of these are right."""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from semnav_env.language.command import room_of
from semnav_env.language.corpora import Sentence, load_sentences
from semnav_env.language.corpora.meanings import meaning_of, normal
from semnav_env.language.corpora.measure import rooms_in
from semnav_env.language.corpora.notation import notation_of, read_meaning
from semnav_env.language.rewording import paraphrases
from semnav_env.language.sampling import sample_command
from studies.chart_reader.ranker import features_of, text_features
from studies.chart_reader.reader import candidates, chart_of


@dataclass(frozen=True)
class Example:
    """A text with its candidates.

    Attributes:
        author: the stem of its file.
        sentence: the text and its meanings.
        features: of each candidate, and of "none of these" behind them.
        forms: the normal form of each candidate; None for what no clause says.
        right: whether each is right; "none of these" is if no other is.
    """

    author: str
    sentence: Sentence
    features: tuple[dict[str, float], ...]
    forms: tuple[object, ...]
    right: tuple[bool, ...]


def examples_of(file: Path, language: str) -> list[Example]:
    """The examples of an author's file; `language` is a code."""
    sentences = load_sentences(file)
    rooms = tuple(dict.fromkeys(rooms_in(each.meanings for each in sentences)))
    return [example_of(each, language, rooms, file.stem) for each in sentences]


def example_of(sentence: Sentence, language: str, rooms: tuple[str, ...], author: str) -> Example:
    """A sentence with its candidates."""
    chart = chart_of(sentence.text, language, rooms)
    found = candidates(chart)
    wanted = list(map(normal, sentence.meanings))
    forms = [None if c.command is None else normal(meaning_of(c.command)) for c in found]
    right = [form is not None and form in wanted for form in forms]
    rows = [*features_of(found), text_features(chart, sentence.text, found)]
    return Example(author, sentence, tuple(rows), (*forms, None), (*right, not any(right)))


SAMPLED = "sampled"
"""The author of what nobody wrote."""


def sampled_examples(count: int, language: str, seed: int = 0) -> list[Example]:
    """Sampled commands in canonical words and in paraphrases, by turns."""
    rng = np.random.default_rng(seed)
    found = []
    for number in range(count):
        command = sample_command(rng, 3, 5)
        rooms = tuple(filter(None, map(room_of, command.clauses)))
        text = command.say(language)
        if number % 2:
            text = next(iter(paraphrases(command, rng, 1, language)), text)
        meaning = read_meaning(notation_of(command))
        sentence = Sentence(str(number), text, "feasible", (meaning,), "", SAMPLED)
        found.append(example_of(sentence, language, rooms, SAMPLED))
    return found


def all_examples(files: list[tuple[Path, str]]) -> Iterator[Example]:
    """The examples of several files, on two processors."""
    with ProcessPoolExecutor(2) as pool:
        for found in pool.map(examples_of, *zip(*files, strict=True)):
            yield from found
