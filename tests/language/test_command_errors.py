"""What an error says, and that nothing else ever comes out."""

import pickle
import re

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from semnav_env.language import Command, CommandError, parse, read
from semnav_env.language.languages import english
from semnav_env.language.normalise import MAX_CHARACTERS, MAX_WORDS
from semnav_env.language.vocabulary.typos import nearest_word
from tests.support.command_strategies import commands


def error_of(text: object) -> CommandError:
    with pytest.raises(CommandError) as caught:
        parse(text)  # type: ignore[arg-type]
    return caught.value


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("take the lift to the third floor", '"lift" is nothing that the robot can see or do'),
        ("fahr mit dem Aufzug hoch", '"Aufzug" kann der Roboter weder sehen noch tun'),
        ("go to the toilet", 'there is no room "toilet"'),
        ("fahr zur Toilette", 'es gibt keinen Raum "Toilette"'),
        ("climb onto the zorgblat", '"zorgblat" is not understood'),
        ("fahr hinter den Zorgblatt", '"Zorgblatt" ist nicht verstanden'),
    ],
)
def test_what_is_not_understood_is_named_in_the_language_of_the_speaker(text, problem) -> None:
    error = error_of(text)
    assert error.problem == problem
    assert error.text[error.position :][: error.length] in problem
    assert "^" in str(error).splitlines()[2]


def test_the_rooms_that_there_are_are_told() -> None:
    with pytest.raises(CommandError, match="the rooms here are: Kitchen, Lab"):
        parse("go to the toilet", rooms=("Kitchen", "Lab"))
    with pytest.raises(CommandError, match='no room "cellar"; there are: Kitchen'):
        parse('go to room "cellar"', rooms=("Kitchen",))


def test_the_place_is_that_of_the_text_as_given() -> None:
    error = error_of("  ＴＨＥ \u200b  ﬁrebird")
    assert error.text[error.position :] == "ﬁrebird"
    caret = str(error).splitlines()[2]
    assert caret.index("^") == 2 + len("  ") + 2 * len("THE") + len(" \u200b  ")


LETTERS = st.text("abcdefghijklmnopqrstuvwxyz", max_size=8)


@given(LETTERS, LETTERS)
def test_a_word_closer_to_left_is_never_answered_with_right(word: str, other: str) -> None:
    known = ("left", "right", "around", other)
    if nearest_word(word, known) == "right":
        assert nearest_word(word, ("left",)) is None
    if nearest_word(word, known) == "left":
        assert nearest_word(word, ("right",)) is None


@pytest.mark.parametrize(
    ("character", "name"),
    [
        ("\u0435", "U+0435 CYRILLIC SMALL LETTER IE"),
        ("\u0391", "U+0391 GREEK CAPITAL LETTER ALPHA"),
        ("ı", "U+0131 LATIN SMALL LETTER DOTLESS I"),
        ("\x00", "U+0000 is a control character"),
        ("\x1b", "U+001B is a control character"),
        ("\x0b", "U+000B is a control character"),
        ("\x85", "U+0085 is a control character"),
        ("\u202e", "U+202E RIGHT-TO-LEFT OVERRIDE"),
        ("\u2066", "U+2066 LEFT-TO-RIGHT ISOLATE"),
        ("\ud800", "U+D800 is a surrogate"),
        ("😀", "U+1F600 GRINNING FACE"),
        ("\U000e0041", "U+E0041 TAG LATIN CAPITAL LETTER A"),
        ("\u0378", "U+0378 is not used"),
        ("½", "U+00BD VULGAR FRACTION ONE HALF"),
    ],
)
def test_foreign_and_unseen_characters_are_named_and_placed(character: str, name: str) -> None:
    error = error_of(f"turn l{character}ft")
    assert name in error.summary
    assert error.position == 6
    str(error).encode("utf-8")


@pytest.mark.parametrize("text", ["", " ", "\n\t", "\u200b\ufeff", "\u3000"])
def test_an_empty_command_is_answered_with_an_example(text: str) -> None:
    error = error_of(text)
    assert error.problem == "the command is empty"
    assert "go through the second door on the right" in str(error)


@pytest.mark.parametrize("text", [None, 3, b"turn left", ["turn left"], float("nan")])
def test_a_command_that_is_no_text_is_refused(text: object) -> None:
    assert "a command is a text (str), not" in str(error_of(text))


@pytest.mark.parametrize(
    "unit", ["a", "turn left, ", "\u202e", "e\u0308", "😀", "\ud800", "ﷺ", "\x00"]
)
def test_a_megabyte_is_refused_by_its_length_alone(unit: str) -> None:
    text = unit * (1_000_000 // len(unit))
    error = error_of(text)
    assert (
        error.summary
        == f"the command has {len(text)} characters; at most {MAX_CHARACTERS} are read"
    )
    assert error.text == ""


def test_too_many_words_are_refused() -> None:
    assert str(error_of("go " * (MAX_WORDS + 1))).startswith(
        f"the command has {MAX_WORDS + 1} words and signs; at most {MAX_WORDS}"
    )


def test_long_texts_are_shown_around_the_fault_only() -> None:
    text = "xyzzy " + "turn left and jump, " * 6 + " left" * 100
    lines = str(error_of(text)).splitlines()
    assert max(len(line) for line in lines[1:]) < 120


def test_errors_survive_pickling() -> None:
    error = error_of("take the lift")
    copy = pickle.loads(pickle.dumps(error))
    assert str(copy) == str(error)


def understood_or_refused(text: str) -> None:
    try:
        command = parse(text)
    except CommandError as error:
        message = str(error)
    else:
        message = str(command)
        assert read(message) == command
    assert message
    assert len(message) < MAX_CHARACTERS
    message.encode("utf-8")


@given(st.text(st.characters(), max_size=60))
@example("\u0130")
@example("ß" * 30)
@example("\u0301turn left")
def test_any_text_is_understood_or_refused(text: str) -> None:
    understood_or_refused(text)


PHRASES = (*english().phrases.values(), *(w for each in english().ordinals for w in each))
WORDS = {word for phrase in PHRASES for word in re.findall(r"[\w-]+", re.sub("{.*?}", "", phrase))}
KNOWN = (*sorted(WORDS), ",", ".", ";")


@settings(max_examples=300)
@given(st.lists(st.sampled_from(KNOWN), max_size=14))
def test_any_order_of_known_words_is_understood_or_refused(words: list[str]) -> None:
    understood_or_refused(" ".join(words))


@given(commands, st.characters(), st.data())
def test_a_changed_character_is_understood_or_refused(
    command: Command, character: str, data: st.DataObject
) -> None:
    text = str(command)
    at = data.draw(st.integers(0, len(text) - 1))
    understood_or_refused(text[:at] + character + text[at + 1 :])
