"""What an error says, and that nothing else ever comes out."""

import pickle
import re

import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

from semnav_env.language import Command, CommandError, read
from semnav_env.language.languages import english
from semnav_env.language.normalise import MAX_CHARACTERS, MAX_WORDS
from semnav_env.language.suggest import nearest
from tests.support.command_strategies import commands, without_rooms


def error_of(text: object) -> CommandError:
    with pytest.raises(CommandError) as caught:
        read(text)  # type: ignore[arg-type]
    return caught.value


def test_the_caret_stands_under_the_word() -> None:
    error = error_of("go down the hallway and hug the bumblebee")
    assert "^" in str(error).splitlines()[2]
    assert error.text[error.position : error.position + error.length].endswith("bumblebee")


def test_what_was_understood_is_said_in_the_first_line() -> None:
    error = error_of("turn left and climb the mast")
    assert 'understood: "turn left"' in error.summary
    assert "is not understood" in error.summary


def test_the_place_is_that_of_the_text_as_given() -> None:
    error = error_of("  ＴＵＲＮ \u200b  ﬁrebird")
    assert error.text[error.position :] == "ﬁrebird"
    caret = str(error).splitlines()[2]
    assert caret.index("^") == 2 + len("  ") + 2 * len("TURN") + len(" \u200b  ")


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        ("go throught the door", "through"),
        ("go trough the door", "through"),
        ("turn rigth", "right"),
        ("turn letf", "left"),
        ("trun left", "turn"),
        ("go down the hallwya", "hallway"),
        ("go down the corrider", "corridor"),
        ("turn left at the intersecton", "intersection"),
        ("go to the secnd door", "second"),
        ("folow the hallway", "follow"),
    ],
)
def test_slips_are_given_back_as_suggestions_not_as_commands(text: str, meant: str) -> None:
    assert error_of(text).suggestion == meant


@pytest.mark.parametrize(
    "text", ["turn blue", "turn lift-right", "go to the 21st door", "go xyzzy"]
)
def test_words_like_no_other_get_no_suggestion(text: str) -> None:
    assert error_of(text).suggestion is None


LETTERS = st.text("abcdefghijklmnopqrstuvwxyz", max_size=8)


@given(LETTERS, LETTERS)
def test_a_word_closer_to_left_is_never_answered_with_right(word: str, other: str) -> None:
    known = ("left", "right", "around", other)
    if nearest(word, known) == "right":
        assert nearest(word, ("left",)) is None
    if nearest(word, known) == "left":
        assert nearest(word, ("right",)) is None


@pytest.mark.parametrize("word", ["don't", "don’t", "do not", "never", "not"])
def test_negations_are_refused_as_such(word: str) -> None:
    assert "negations are not understood" in str(error_of(f"{word} turn left"))


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


def test_the_ninth_clause_is_pointed_at() -> None:
    error = error_of(", ".join(["turn left"] * 8 + ["turn right", "stop"]))
    assert error.problem == "the command has 10 clauses; at most 8 are carried out"
    assert error.text[error.position :] == "turn right, stop"
    assert error.length == len("turn right")


def test_long_texts_are_shown_around_the_fault_only() -> None:
    text = "turn left, " * 6 + "x" * 1000 + " left" * 100
    lines = str(error_of(text)).splitlines()
    assert max(len(line) for line in lines[1:]) < 120
    assert lines[2].count("^") == 24
    assert lines[1][lines[2].index("^")] == "x"


def test_errors_survive_pickling() -> None:
    error = error_of("turn lfet")
    copy = pickle.loads(pickle.dumps(error))
    assert str(copy) == str(error)
    assert copy.expected == error.expected


def understood_or_refused(text: str) -> None:
    try:
        command = read(text)
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


@given(without_rooms, st.data())
def test_one_lost_letter_never_turns_left_into_right(command: Command, data: st.DataObject) -> None:
    text = str(command)
    at = data.draw(st.integers(0, len(text) - 1))
    assume(text[at].isalpha())  # a lost digit makes another number
    try:
        slipped = read(text[:at] + text[at + 1 :])
    except CommandError:
        return
    assert slipped == command or slipped == read("stop") == Command(command.clauses[:1])
