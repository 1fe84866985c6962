"""A call to stop is heard in every language, whatever else is said."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from semnav_env.language import Command, CommandError, Stop, parse
from semnav_env.language.corpora.meanings import key_of
from semnav_env.language.stops import begins_or_ends_with_stop, is_stop

STOP = Command((Stop(),))
URGENT = ("emergency stop", "whoa", "stop stop", "Notstopp", "Not-Halt", "halt stopp", "e-stop")


@pytest.mark.parametrize(
    "text",
    [
        *("stop", "Stop!", "stop stop stop", "STOP, STOP!", "no, stop", "okay stop now", "whoa"),
        *("halt", "freeze", "don't move", "don’t move", "that's enough", "please stop right now"),
        *("watch out", "emergency stop", "Notstopp", "Nothalt!", "hör auf", "das reicht"),
        *("nein, stopp", "sofort anhalten", "bleib stehen", "Halt, stopp!", "Achtung!"),
    ],
)
def test_a_call_alone_is_a_stop_in_any_forced_language(text: str) -> None:
    assert is_stop(text)
    assert parse(text) == parse(text, "en") == parse(text, "de") == STOP


@given(st.text(max_size=40), st.sampled_from(URGENT), st.booleans())
def test_an_urgent_call_at_either_end_is_a_stop_whatever_else_is_said(
    other: str, call: str, first: bool
) -> None:
    assert parse(f"{call}. {other}" if first else f"{other}. {call}") == STOP


@pytest.mark.parametrize(
    "text",
    [
        *("go to the kitchen, forget it", "turn right, cancel that", "left, no, stop"),
        *("through the second door, never mind", "fahr ins Labor, nein, halt", "links, vergiss es"),
    ],
)
def test_what_is_taken_back_at_the_end_is_a_stop(text: str) -> None:
    assert is_stop(text)
    assert parse(text, rooms=("kitchen", "Labor")) == STOP


@pytest.mark.parametrize("text", ["never mind that, turn left", "turn left, no, right"])
def test_what_is_taken_back_before_the_end_is_none(text: str) -> None:
    assert not is_stop(text)


@pytest.mark.parametrize(
    "text",
    [
        "stop! there is somebody in the way",
        "stop, not that one",
        "Halt! Da liegt was auf dem Boden",
        "take the elevator. Stop!",
    ],
)
def test_a_call_beside_what_is_not_understood_is_a_stop(text: str) -> None:
    assert begins_or_ends_with_stop(text)
    assert parse(text) == STOP


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        ("stop, then turn left", "stop and turn left"),
        ("go through the first door, stop", "go through the first door and stop"),
        ("stop at the second door on the left", "go to the second door on the left and stop"),
    ],
)
def test_a_stop_that_is_part_of_a_route_stays_part_of_it(text: str, meant: str) -> None:
    assert key_of(parse(text)) == key_of(parse(meant))


@pytest.mark.parametrize(
    "text", ["do not stop", "stop at the elevator", "go to the elevator, stop", ""]
)
def test_what_forbids_a_stop_or_needs_more_is_none(text: str) -> None:
    assert not is_stop(text)
    with pytest.raises(CommandError):
        parse(text)
