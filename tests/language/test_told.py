"""What a robot tells is in the language of the speaker, and corrections are told."""

from __future__ import annotations

import ast
import copy
import pickle
from pathlib import Path
from string import Formatter

import pytest

from semnav_env.language import DoorReference, Side, corrections, parse
from semnav_env.language.languages import languages
from semnav_env.language.told import Told, in_words_of, told
from semnav_env.mind.grounding.errors import GroundingError, UnclearError

ROOT = Path(__file__).parents[2]
PACKAGES = ("semnav_env", "agents", "scripts")
GERMAN = languages()["de"]
DOOR = DoorReference(3, Side.LEFT)


def fields(template: str) -> set[str]:
    return {name for _, name, _, _ in Formatter().parse(template) if name}


def literals() -> set[str]:
    """The templates that the code gives to `Told` and `tell` as they are."""
    files = (file for package in PACKAGES for file in (ROOT / package).rglob("*.py"))
    calls = (node for file in files for node in ast.walk(ast.parse(file.read_text("utf-8"))))
    return {
        str(node.args[0].value)
        for node in calls
        if isinstance(node, ast.Call)
        and (getattr(node.func, "id", "") == "Told" or getattr(node.func, "attr", "") == "tell")
        and node.args
        and isinstance(node.args[0], ast.Constant)
    }


def test_every_text_that_is_told_has_words_in_german() -> None:
    said = literals()
    assert len(said) > 30
    assert said - GERMAN.told.keys() == set()


@pytest.mark.parametrize("template", GERMAN.told)
def test_a_text_tells_the_same_in_every_language(template: str) -> None:
    english, _, form = template.rpartition(":")
    known = english if form in ("to", "at", "dative") and english in GERMAN.told else template
    assert fields(GERMAN.told[template]) == fields(known)


def test_a_text_is_english_and_says_itself_in_german_with_its_parts() -> None:
    text = Told("looking for {what:dative}", what=told(DOOR))
    for each in (text, copy.deepcopy(text), pickle.loads(pickle.dumps(text))):
        assert each == "looking for the third door on the left"
        assert in_words_of(GERMAN, each) == "auf der Suche nach der dritten Tür links"
    assert in_words_of(GERMAN, "plain") == "plain"


@pytest.mark.parametrize("kind", [GroundingError, UnclearError])
def test_an_error_keeps_its_kind_in_another_language(kind: type[GroundingError]) -> None:
    error = kind(Told("no {what:bare}: the hallway has none", what=DOOR))
    assert str(error) == "no third door on the left: the hallway has none"
    german = error.in_words_of(GERMAN)
    assert type(german) is kind
    assert str(german) == "die dritte Tür links gibt es nicht: im Flur ist keine"


@pytest.mark.parametrize(
    ("text", "rooms", "english", "german"),
    [
        (
            "geh zur Kühe",
            ("Küche", "Bad"),
            '"Kühe" taken as "Küche"',
            '"Kühe" als "Küche" verstanden',
        ),
        ("go to the libary", ("Library",), '"libary" taken as "Library"', None),
        ("geh in die Bücher ei", ("Bücherei",), '"Bücher ei" taken as "Bücherei"', None),
        ("second door on the Rigth", (), '"Rigth" taken as "right"', None),
    ],
)
def test_a_word_that_was_corrected_is_told(
    text: str, rooms: tuple[str, ...], english: str, german: str | None
) -> None:
    parse(text, rooms=rooms)
    (correction,) = corrections(text, rooms)
    assert correction == english
    assert german in (None, correction.say(GERMAN))


@pytest.mark.parametrize(
    "text",
    [
        "geh zur Küche",
        "go to my library",
        "back to library",
        "die zweite Tür links",
        "Linksdrehung",
        "geh zum Bad",
    ],
)
def test_where_nothing_was_corrected_nothing_is_told(text: str) -> None:
    assert corrections(text, ("Küche", "Bad", "Library")) == ()
