"""What can mean several things is never decided: all of them are named."""

import pickle

import pytest
from hypothesis import given
from hypothesis import strategies as st

from semnav_env.language import (
    AmbiguousCommandError,
    Command,
    CommandError,
    read,
    readings,
)
from semnav_env.language.languages import languages
from semnav_env.language.stops import is_stop
from tests.support.command_strategies import commands

AMBIGUOUS = {
    "en": (
        "go back",
        "turn 90 degrees",
        "turn left at the second door",
        "go past the first door and go through the second door",
        "go back, then turn 90 degrees",
        "take the second door, left",
    ),
    "de": (
        "geh zurück",
        "dreh dich um 90 Grad",
        "nimm die zweite Tür, links",
        "bieg an der zweiten Tür links ab",
        "geh an der ersten Tür vorbei und dann durch die zweite Tür",
    ),
}
TEXTS = [(code, text) for code, texts in AMBIGUOUS.items() for text in texts]


def error_of(text: str, code: str = "en") -> AmbiguousCommandError:
    with pytest.raises(AmbiguousCommandError) as caught:
        read(text, code)
    return caught.value


@pytest.mark.parametrize(("code", "text"), TEXTS)
def test_every_reading_can_be_said_so_that_it_is_the_only_one(code: str, text: str) -> None:
    error = error_of(text, code)
    assert len(error.readings) >= 2
    assert error.readings == readings(text, code)
    for reading in error.readings:
        assert read(reading.say(code), code) == reading


@pytest.mark.parametrize(("code", "text"), TEXTS)
def test_what_tells_the_readings_apart_is_said(code: str, text: str) -> None:
    error = error_of(text, code)
    assert len(set(error.differences)) == len(error.readings)
    for difference, reading in zip(error.differences, error.readings, strict=True):
        assert f'{difference}"' in str(error)
        assert len(read(difference, code).clauses) <= len(reading.clauses)


def test_the_clauses_that_all_readings_share_are_left_out() -> None:
    error = error_of("leave the room, turn left, turn 90 degrees, turn around and stop")
    left, right = "turn left by 90 degrees", "turn right by 90 degrees"
    assert [each.split(", ")[-1].split(" and ")[-1] for each in error.differences] == [left, right]
    assert all("around" not in each for each in error.differences)


def test_a_bare_side_is_a_turn_unless_it_can_be_that_of_a_door() -> None:
    turns = "left, right, left, right, left, right, left, right"
    assert str(read(turns)).count("turn") == 8
    assert str(read("take the second door and left")) == "go through the second door and turn left"
    assert len(readings("take the second door on the right, left")) == 1
    assert len(readings("take the second door, left")) == 2


def test_from_there_counting_begins_anew() -> None:
    anew = "go past the first door and from there go through the second door"
    assert len(readings(anew)) == 1
    assert read(anew) in readings("go past the first door and go through the second door")


@pytest.mark.parametrize("code", sorted(languages()))
def test_canonical_words_are_never_ambiguous(code: str) -> None:
    @given(commands)
    def check(command: Command) -> None:
        assert readings(command.say(code), code) == (command,)

    check()


@given(st.lists(st.sampled_from(("go back", "turn 45 degrees", "stop")), min_size=1))
def test_any_heap_of_ambiguous_clauses_is_answered(clauses: list[str]) -> None:
    text, ways = ", ".join(clauses), 2 ** sum(clause != "stop" for clause in clauses)
    if clauses[0] == "stop" and not is_stop(text):
        assert "stop" in {str(each.clauses[0]) for each in readings(text)}
    elif ways <= 16 and len(clauses) + clauses.count("go back") <= 8:
        assert len(readings(text)) == ways
    else:
        with pytest.raises(CommandError, match=r"at most 8|1 to 8 clauses|in \d+ ways"):
            readings(text)


def test_going_in_needs_a_door_that_was_spoken_of() -> None:
    for text in ("go in", "turn left and go in", "go past the first door and go in"):
        with pytest.raises(CommandError, match="into what"):
            read(text)


def test_the_error_survives_pickling() -> None:
    error = error_of("go back")
    copy = pickle.loads(pickle.dumps(error))
    assert (str(copy), copy.readings) == (str(error), error.readings)


@pytest.mark.parametrize(
    "text",
    [
        "don't turn left",
        "do not stop",
        "never go through the first door",
        "go through the first door on the left on the right",
        "go through the left door on the right",
        "turn left or right",
        "either stop or turn left",
        "go through every door",
    ],
)
def test_negation_contradiction_choice_and_condition_are_refused(text: str) -> None:
    with pytest.raises(CommandError):
        read(text)


def test_a_question_about_a_condition_names_whole_commands() -> None:
    text = "Go to the meeting room. If its door is open, enter, and if not, wait there."
    with pytest.raises(AmbiguousCommandError) as error:
        read(text, rooms=("meeting room",))
    assert error.value.differences == tuple(str(each) for each in error.value.readings)
