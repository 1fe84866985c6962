"""Words out of order and telegrams: what a third author's commands showed."""

from __future__ import annotations

import pytest

from semnav_env.language import CommandError, read, readings

WAIT_THEN_TURN = (
    "go down the hallway until the first corner, wait for 5 seconds and turn left at the first "
    "corner"
)
THIRD_ON_THE_LEFT = (
    "go down the hallway past the second door on the left and go through the first door on the left"
)
OUT_AND_RIGHT = "leave the room, turn right and go through the second door on the left"
TWICE = "turn left at the first intersection and turn right at the first intersection"
STOP_AT_DOOR = "go to the second door on the right and stop"
IN_OR_STOP = "if you see the first door, go through the first door, otherwise stop"


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        ("before you turn left at the corner, wait there for five seconds", WAIT_THEN_TURN),
        ("before you turn left at the corner wait there for five seconds", WAIT_THEN_TURN),
        ("go to the end, but before that leave the room", "leave the room and go to the end"),
        ("out right second door left", OUT_AND_RIGHT),
        ("raus rechts zweite Tür links", OUT_AND_RIGHT),
        ("first intersection left next one right", TWICE),
        ("ignore the first two doors on the left and take the third", THIRD_ON_THE_LEFT),
        ("go to the second door on the right and stop in front of the door", STOP_AT_DOOR),
        ("if the first door is open, go in; if it is closed, stop", IN_OR_STOP),
        ("don't go into the second room, just stop outside it", "go to the second door and stop"),
        ("geh zur dritten Tür links, aber geh nicht hinein", "go to the third door on the left"),
    ],
)  # fmt: skip
def test_clauses_are_done_in_the_order_that_is_meant(text: str, meant: str) -> None:
    assert readings(text) == (read(meant),)


@pytest.mark.parametrize("door", ["kitchen door", "Küchentür"])
def test_a_room_is_known_by_its_door(door: str) -> None:
    closed = {"kitchen door": "if the {} is closed, stop", "Küchentür": "falls die {} zu ist, halt"}
    rooms = ("kitchen", "küche")
    first, condition, *_ = read(closed[door].format(door), rooms=rooms).clauses
    assert str(first).startswith("go to") or "in front of" in str(first)
    assert str(condition) == "if you do not see the first door"


def test_what_would_be_done_before_is_never_dropped() -> None:
    with pytest.raises(CommandError, match="is not understood"):
        read("turn right at the corner after you've left the room")


@pytest.mark.parametrize("text", ["Stell dich nein, da geht's rechts.", "go in, not left"])
def test_no_correction_fails_in_another_way_than_by_a_refusal(text: str) -> None:
    try:
        readings(text)
    except CommandError:
        return
