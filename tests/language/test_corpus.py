"""Commands as people word them, written by hand and not from the grammar, with their programs.

A row of tests/corpus/LANGUAGE.csv is a text and its canonical English; " / " parts the readings of
an ambiguous one, and an empty program is something that must be refused.
"""

import csv

import pytest

from semnav_env.language import Command, CommandError, read, readings
from tests.support.paths import TESTS

FOLDER = TESTS / "corpus"
LANGUAGES = {"english": "en", "german": "de"}
ROOMS = ("kitchen", "printer room", "3.508", "204", "12", "101", "kueche", "druckerraum")
UNDERSTOOD = 0.97


def rows(name: str) -> list[tuple[str, frozenset[Command]]]:
    with (FOLDER / f"{name}.csv").open(encoding="utf-8") as file:
        table = list(csv.DictReader(file, delimiter=";"))
    programs = [row["program"].split(" / ") if row["program"] else [] for row in table]
    return [
        (row["text"], frozenset(map(read, each))) for row, each in zip(table, programs, strict=True)
    ]


def taken_as(text: str, language: str) -> frozenset[Command] | None:
    """What a text is taken for; None if it is refused."""
    try:
        return frozenset(readings(text, language, ROOMS))
    except CommandError:
        return None


@pytest.mark.parametrize(("name", "language"), LANGUAGES.items())
def test_nothing_is_taken_for_something_else(name: str, language: str) -> None:
    taken = [(text, meant, taken_as(text, language)) for text, meant in rows(name)]
    wrong = [text for text, meant, found in taken if found is not None and found != meant]
    assert wrong == []


@pytest.mark.parametrize(("name", "language"), LANGUAGES.items())
def test_nearly_all_is_understood_as_written_down(name: str, language: str) -> None:
    commands = [(text, meant) for text, meant in rows(name) if meant]
    refused = [text for text, _ in commands if taken_as(text, language) is None]
    assert len(refused) <= (1 - UNDERSTOOD) * len(commands), refused


def test_the_corpus_is_long_enough_and_says_nothing_twice() -> None:
    texts = [(name, text.casefold()) for name in LANGUAGES for text, _ in rows(name)]
    assert len(set(texts)) == len(texts) >= 400
