"""Disturbs sentences that are understood, and parses canonical words and long texts."""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import replace

import numpy as np

from semnav_env.language import parse, read
from semnav_env.language.command import Command
from semnav_env.language.corpora import ParseOutcome, Sentence, judge
from semnav_env.language.corpora.measure import rooms_in
from semnav_env.language.errors import CommandError
from semnav_env.language.sampling import sample_command

FILLERS = {
    "en": ("uh", "um", "so", "please", "you know", "like", "well", "okay", "just"),
    "de": ("äh", "ähm", "also", "bitte", "mal", "halt", "ja", "so", "eben"),
}
"""Words without meaning, of each language; one of them is put at each place of a sentence."""

PUNCTUATION = ",.;:!?"

LONG = (
    "turn left and ",
    "go past the second door ",
    "if the door on the left is open ",
    "until you reach ",
    "when you ",
    "bis du nicht mehr weiterkommst ",
    "no, not the first door but ",
    "x ",
)
"""Beginnings that are repeated to texts of `LONG_LENGTH`."""

LONG_LENGTH = 10_000
"""Length of the long texts, characters."""


def understood(sentences: Sequence[Sentence]) -> list[Sentence]:
    """The sentences with a meaning that are understood."""
    rooms = _rooms(sentences)
    feasible = (each for each in sentences if each.kind == "feasible")
    return [s for s in feasible if judge(s, rooms, parse).outcome is ParseOutcome.UNDERSTOOD]


def with_fillers(sentences: Sequence[Sentence], rng: np.random.Generator) -> Iterator[Sentence]:
    """Each sentence with one filler, drawn anew, at each place between its words."""
    for sentence in sentences:
        words = sentence.text.split()
        fillers = FILLERS["de" if "german" in sentence.corpus else "en"]
        for place in range(len(words) + 1):
            filler = fillers[int(rng.integers(len(fillers)))]
            text = " ".join([*words[:place], filler, *words[place:]])
            yield replace(sentence, text=text)


def without_punctuation(sentences: Sequence[Sentence]) -> Iterator[Sentence]:
    """Each sentence that has commas or full stops, without them, in small letters."""
    for sentence in sentences:
        text = sentence.text.translate(str.maketrans("", "", PUNCTUATION)).lower()
        if text != sentence.text.lower():
            yield replace(sentence, text=text)


def outcomes(
    sentences: Sequence[Sentence], disturbed: Iterator[Sentence]
) -> dict[ParseOutcome, int]:
    """How many disturbed sentences came to which outcome.

    Args:
        sentences: the whole corpus, which tells the rooms of the building.
        disturbed: of them.
    """
    rooms = _rooms(sentences)
    found = dict.fromkeys(ParseOutcome, 0)
    for sentence in disturbed:
        found[judge(sentence, rooms, parse).outcome] += 1
    return found


def _rooms(sentences: Sequence[Sentence]) -> tuple[str, ...]:
    return tuple(dict.fromkeys(rooms_in(each.meanings for each in sentences)))


def changed_commands(programs: int, rng: np.random.Generator) -> Iterator[tuple[Command, str]]:
    """The sampled commands, and a language, whose canonical words mean something else."""
    for _ in range(programs):
        command = sample_command(rng)
        for language in FILLERS:
            try:
                same = read(command.say(language), language) == command
            except CommandError:
                same = False
            if not same:
                yield command, language


def slowest_parse() -> float:
    """Longest processor time to parse a text of `LONG_LENGTH` characters, seconds."""
    slowest = 0.0
    for beginning in LONG:
        text = (beginning * LONG_LENGTH)[:LONG_LENGTH]
        for part in (
            text,
            " ".join(text.split()[:300]),
        ):  # refused by its length, and the longest read
            start = time.process_time()
            with suppress(CommandError):
                read(part)
            slowest = max(slowest, time.process_time() - start)
    return slowest
